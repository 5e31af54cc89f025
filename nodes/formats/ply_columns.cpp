// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/ply_columns.hpp"

#include <stdexcept>

namespace posevote::formats {
namespace {

std::optional<std::size_t> find_number(const PlyElement& element, const std::string& name) {
  const auto at = element.find(name);
  return at && !element.properties[*at].count_type ? at : std::nullopt;
}

/// All of them, or nothing.
template <std::size_t kCount>
std::optional<std::array<std::size_t, kCount>> find_all(
    const PlyElement& element, const std::array<std::string, kCount>& names) {
  std::array<std::size_t, kCount> found{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto at = find_number(element, names[i]);
    if (!at) return std::nullopt;
    found[i] = *at;
  }
  return found;
}

void find_colors(const PlyElement& vertex, PlyColumns& columns) {
  const std::array<std::string, 3> names{"red", "green", "blue"};
  columns.color = find_all(vertex, names);
  if (!columns.color)
    columns.color = find_all<3>(vertex, {"diffuse_red", "diffuse_green", "diffuse_blue"});
  if (!columns.color) {
    for (const std::string& name : names)
      if (find_number(vertex, name))
        columns.color_doubt =
            "the header's vertex has " + name + ", but not all of red, green and blue";
    return;
  }
  const PlyType type = vertex.properties[(*columns.color)[0]].type;
  if (type == PlyType::kUint8) columns.brightest = 255;
  if (type == PlyType::kUint16) columns.brightest = 65535;
}

}  // namespace

PlyColumns find_columns(const PlyElement& vertex) {
  PlyColumns columns;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string axis(1, "xyz"[i]);
    const auto point = find_number(vertex, axis);
    if (!point)
      throw std::runtime_error("the header's vertex has no property " + axis +
                               ", expected x, y and z");
    columns.point[i] = *point;
  }
  columns.normal = find_all<3>(vertex, {"nx", "ny", "nz"});
  find_colors(vertex, columns);
  constexpr const char* kPlaces[][2] = {{"texture_u", "texture_v"}, {"u", "v"}, {"s", "t"}};
  for (const auto& names : kPlaces)
    if (!columns.place) columns.place = find_all<2>(vertex, {names[0], names[1]});
  return columns;
}

PlyFaceColumns find_face_columns(const PlyElement& face) {
  PlyFaceColumns columns;
  const auto indices = face.find("vertex_indices");
  columns.corners = indices ? *indices : face.find("vertex_index").value_or(SIZE_MAX);
  if (columns.corners < face.properties.size() && !face.properties[columns.corners].count_type)
    throw std::runtime_error("the header's face has vertex indices that are not a list");
  const auto places = face.find("texcoord");
  if (places && face.properties[*places].count_type) columns.places = *places;
  columns.image = find_number(face, "texnumber").value_or(SIZE_MAX);
  return columns;
}

}  // namespace posevote::formats

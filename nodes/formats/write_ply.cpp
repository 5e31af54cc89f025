// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/write_ply.hpp"

#include <bit>
#include <cstring>
#include <stdexcept>
#include <string>

#include "graph/write_file.hpp"

namespace posevote::formats {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "values are written as they lie");

template <class T>
void put(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void check_counts(const fs::path& file, const Mesh& mesh, std::size_t colours,
                  const FaceTexture& texture) {
  const Eigen::Index points = mesh.points.rows();
  const auto refuse = [&](const std::string& what, Eigen::Index count) {
    throw std::invalid_argument(file.string() + ": " + std::to_string(count) + " " + what +
                                " for " + std::to_string(points) + " points");
  };
  if (mesh.normals.rows() != 0 && mesh.normals.rows() != points)
    refuse("normals", mesh.normals.rows());
  if (colours != 0 && static_cast<Eigen::Index>(colours) != points)
    refuse("colours", static_cast<Eigen::Index>(colours));
  if (!texture.image.empty() && texture.places.rows() != mesh.faces.rows())
    refuse("faces with a texture", texture.places.rows());
  if (mesh.faces.size() != 0 && static_cast<Eigen::Index>(mesh.faces.maxCoeff()) >= points)
    refuse("as the highest index of a face", mesh.faces.maxCoeff());
}

std::string header(const Mesh& mesh, bool colours, const std::string& image) {
  std::string text = std::string("ply\nformat binary_little_endian 1.0\n") +
                     (image.empty() ? "" : "comment TextureFile " + image + "\n") +
                     "element vertex " + std::to_string(mesh.points.rows()) +
                     "\nproperty float x\nproperty float y\nproperty float z\n";
  if (mesh.normals.rows() != 0) text += "property float nx\nproperty float ny\nproperty float nz\n";
  if (colours) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (mesh.faces.rows() != 0)
    text += "element face " + std::to_string(mesh.faces.rows()) +
            "\nproperty list uchar uint vertex_indices\n";
  if (!image.empty()) text += "property list uchar float texcoord\n";
  return text + "end_header\n";
}

std::string body(const Mesh& mesh, double units_per_metre, const std::vector<Rgb>& colours,
                 const FaceTexture& texture) {
  std::string bytes;
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      put(bytes, static_cast<float>(mesh.points(i, axis) * units_per_metre));
    if (mesh.normals.rows() != 0)
      for (int axis = 0; axis < 3; ++axis) put(bytes, mesh.normals(i, axis));
    if (!colours.empty()) put(bytes, colours[static_cast<std::size_t>(i)]);
  }
  for (Eigen::Index face = 0; face < mesh.faces.rows(); ++face) {
    put(bytes, std::uint8_t{3});
    for (int corner = 0; corner < 3; ++corner) put(bytes, mesh.faces(face, corner));
    if (texture.image.empty()) continue;
    put(bytes, std::uint8_t{6});
    for (int i = 0; i < 6; ++i) put(bytes, texture.places(face, i));
  }
  return bytes;
}

}  // namespace

void write_ply(const fs::path& file, const Mesh& mesh, double units_per_metre,
               const std::vector<Rgb>& colours, const FaceTexture& texture) {
  check_counts(file, mesh, colours.size(), texture);
  const std::string bytes =
      header(mesh, !colours.empty(), texture.image) + body(mesh, units_per_metre, colours, texture);
  graph::write_file(file, bytes);
}

}  // namespace posevote::formats

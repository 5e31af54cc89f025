// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/formats/paint_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "nodes/formats/color_image.hpp"
#include "nodes/formats/material_library.hpp"

namespace posevote::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kUnknown = std::numeric_limits<std::uint32_t>::max();

/// What `read` gives of a file; complaints name it.
template <class Read>
auto named(const fs::path& file, const Read& read) {
  try {
    return read(file);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.filename().string() + ": " + error.what());
  }
}

ColorImage one_pixel(const Triple& color) {
  ColorImage image{1, 1, {}};
  for (const double value : color)
    image.values.push_back(
        static_cast<std::uint8_t>(value > 0 ? std::lround(255 * std::min(value, 1.0)) : 0));
  return image;
}

/// One image for each of the paint's materials.
std::vector<ColorImage> read_images(const Paint& paint, const fs::path& folder) {
  std::map<std::string, Material> known;
  for (const std::string& library : paint.libraries)
    known.merge(named(folder / library, read_materials));
  std::vector<ColorImage> images;
  for (const std::string& name : paint.materials) {
    const auto material = known.find(name);
    if (!paint.libraries.empty() && !name.empty() && material == known.end())
      throw std::runtime_error("no library says what material '" + name + "' is");
    const std::string file = paint.libraries.empty()   ? name
                             : material == known.end() ? std::string()
                                                       : material->second.image;
    images.push_back(
        file.empty() ? one_pixel(material == known.end() ? Triple{1, 1, 1} : material->second.color)
                     : named(folder / file, read_color_image));
  }
  return images;
}

/// Gives each point its place, and each other place of it a point of its own.
class Places {
 public:
  Places(RawMesh& mesh, Seams seams) : mesh_(mesh), seams_(seams) {}

  void assign() {
    image_of_.assign(mesh_.points.size(), kUnknown);
    place_of_.resize(mesh_.points.size());
    const Paint& paint = mesh_.paint;
    for (std::size_t f = 0; f < mesh_.faces.size(); ++f)
      for (std::size_t k = 0; k < 3; ++k)
        mesh_.faces[f][k] = point_at(mesh_.faces[f][k], paint.material_of[f], paint.corners[f][k]);
    Texture& texture = mesh_.texture;
    texture.places.setZero(std::ssize(image_of_), 2);
    for (std::size_t i = 0; i < image_of_.size(); ++i) {
      if (place_of_[i] < paint.places.size())
        for (std::size_t axis = 0; axis < 2; ++axis)
          texture.places(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis)) =
              static_cast<float>(paint.places[place_of_[i]][axis]);
      if (image_of_[i] == kUnknown) image_of_[i] = 0;  // of no face
    }
    texture.image_of = std::move(image_of_);
  }

 private:
  std::uint32_t point_at(std::uint32_t point, std::uint32_t image, std::uint32_t place) {
    if (image_of_[point] == kUnknown) {
      image_of_[point] = image;
      place_of_[point] = place;
    }
    if (seams_ == Seams::kJoin || (image_of_[point] == image && place_of_[point] == place))
      return point;
    const auto [copy, is_new] = copies_.try_emplace(std::tuple(point, image, place),
                                                    static_cast<std::uint32_t>(image_of_.size()));
    if (is_new) {
      mesh_.points.push_back(mesh_.points[point]);
      if (!mesh_.normals.empty()) mesh_.normals.push_back(mesh_.normals[point]);
      if (!mesh_.colors.empty()) mesh_.colors.push_back(mesh_.colors[point]);
      image_of_.push_back(image);
      place_of_.push_back(place);
    }
    return copy->second;
  }

  RawMesh& mesh_;
  Seams seams_;
  std::vector<std::uint32_t> image_of_, place_of_;  ///< per point
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, std::uint32_t> copies_;
};

}  // namespace

void paint_mesh(RawMesh& mesh, const fs::path& folder, Seams seams) {
  if (mesh.paint.materials.empty() || mesh.faces.empty()) return;
  mesh.texture.images = read_images(mesh.paint, folder);
  Places(mesh, seams).assign();
}

}  // namespace posevote::formats

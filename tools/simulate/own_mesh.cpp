// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/own_mesh.hpp"

#include <stdexcept>

#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/units.hpp"
#include "nodes/geometry/extent.hpp"
#include "nodes/geometry/winding.hpp"
#include "pipelines/library.hpp"

namespace posevote {
namespace {

constexpr double kLeast = 0.002, kMost = 5;  ///< what the simulation of bodies is good for [m]
constexpr double kLeastInMillimetres = 10;   ///< as load_models

Mesh scaled(const std::string& file, const std::string& unit) {
  const Mesh mesh = formats::read_mesh(file, 1);
  if (mesh.faces.rows() == 0)
    throw std::runtime_error("has no faces, and bare points cannot be simulated: expected a mesh");
  const double size = geometry::model_diagonal(mesh.points);
  const std::string is =
      unit == "auto" ? formats::likely_unit(size, kLeastInMillimetres).unit : unit;
  const double diagonal = size * formats::metres_per(is);
  if (diagonal < kLeast || diagonal > kMost)
    throw std::runtime_error("its diagonal is " + formats::in_metres(diagonal) + ", read as " + is +
                             ", expected 0.002 to 5 m: is that its unit?");
  return formats::read_mesh(file, formats::metres_per(is));
}

}  // namespace

Mesh read_own_mesh(const std::string& file, const std::string& unit) {
  try {
    Mesh mesh = scaled(file, unit);
    mesh.normals.resize(0, 3);
    mesh.faces = geometry::wind_outward(mesh.points, mesh.faces);
    return mesh;
  } catch (const std::runtime_error& error) {
    throw std::invalid_argument(file + ": " + error.what());
  }
}

ShapeSymmetry find_symmetry(const Mesh& mesh, const std::string& name) {
  ModelFile file{name, 1, name, {}, std::make_shared<const Mesh>(mesh)};
  const auto library = train(load_configuration("default", {"load_models.unit=m"}), {file});
  const Symmetries& found = library->models.front()->symmetries;
  ShapeSymmetry symmetry;
  symmetry.center = found.fixed_point.cast<double>();
  for (const Eigen::Vector3f& axis : found.axes) symmetry.axes.push_back(axis.cast<double>());
  for (std::size_t i = 1; i < found.turns.size(); ++i)
    symmetry.turns.push_back(found.turns[i].cast<double>().normalized().toRotationMatrix());
  return symmetry;
}

}  // namespace posevote

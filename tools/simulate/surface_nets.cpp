// SPDX-License-Identifier: BSD-3-Clause
#include "tools/simulate/surface_nets.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "graph/parallel.hpp"

namespace posevote {
namespace {

using Index3 = std::array<int, 3>;

/// Values of the field at the corners of cubic cells.
struct Grid {
  int side = 0;  ///< corners along one edge
  double extent = 0, cell = 0;
  std::vector<double> values;

  std::size_t at(const Index3& i) const {
    return (static_cast<std::size_t>(i[2]) * static_cast<std::size_t>(side) +
            static_cast<std::size_t>(i[1])) *
               static_cast<std::size_t>(side) +
           static_cast<std::size_t>(i[0]);
  }
  Eigen::Vector3d position(const Index3& i) const {
    return Eigen::Vector3d(i[0], i[1], i[2]) * cell - Eigen::Vector3d::Constant(extent);
  }
  bool inside(const Index3& i) const { return values[at(i)] < 0; }
};

template <class Visit>
void for_each_index(const Grid& grid, int first, int last, const Visit& visit) {
  for (int z = first; z < last; ++z)
    for (int y = first; y < grid.side - 1; ++y)
      for (int x = first; x < grid.side - 1; ++x) visit(Index3{x, y, z});
}

Grid sample(const Field& field, double extent, double cell) {
  Grid grid{static_cast<int>(std::ceil(2 * extent / cell)) + 1, extent, cell, {}};
  const auto side = static_cast<std::size_t>(grid.side);
  grid.values.resize(side * side * side);
  graph::parallel_for(side, 1, [&](std::size_t z) {
    for (int y = 0; y < grid.side; ++y)
      for (int x = 0; x < grid.side; ++x) {
        const Index3 i{x, y, static_cast<int>(z)};
        grid.values[grid.at(i)] = field(grid.position(i));
      }
  });
  return grid;
}

Index3 corner(const Index3& cell, int k) {
  return {cell[0] + (k & 1), cell[1] + ((k >> 1) & 1), cell[2] + ((k >> 2) & 1)};
}

/// Mean of the zero crossings on a cell's edges; false where there is none.
bool mean_crossing(const Grid& grid, const Index3& cell, Eigen::Vector3d& mean) {
  int crossings = 0;
  mean.setZero();
  for (int a = 0; a < 8; ++a)
    for (int axis = 0; axis < 3; ++axis) {
      const int b = a | (1 << axis);
      if (b == a) continue;
      const double from = grid.values[grid.at(corner(cell, a))];
      const double to = grid.values[grid.at(corner(cell, b))];
      if ((from < 0) == (to < 0)) continue;
      const double part = from / (from - to);
      mean += (1 - part) * grid.position(corner(cell, a)) + part * grid.position(corner(cell, b));
      ++crossings;
    }
  if (crossings > 0) mean /= crossings;
  return crossings > 0;
}

/// Two Newton steps along the gradient, none longer than half a cell.
Eigen::Vector3d onto_surface(const Field& field, double cell, Eigen::Vector3d point) {
  const double h = 0.05 * cell;
  for (int step = 0; step < 2; ++step) {
    Eigen::Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d offset = h * Eigen::Vector3d::Unit(axis);
      gradient[axis] = (field(point + offset) - field(point - offset)) / (2 * h);
    }
    Eigen::Vector3d move = -field(point) / std::max(gradient.squaredNorm(), 1e-12) * gradient;
    if (move.norm() > 0.5 * cell) move *= 0.5 * cell / move.norm();
    point += move;
  }
  return point;
}

/// The two triangles across each edge of the grid that the surface crosses.
FaceMatrix connect(const Grid& grid, const std::vector<std::uint32_t>& vertex_of) {
  std::vector<std::array<std::uint32_t, 3>> faces;
  for_each_index(grid, 1, grid.side - 1, [&](const Index3& i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Index3 end = i;
      ++end[axis];
      if (grid.inside(i) == grid.inside(end)) continue;
      Index3 cells[4] = {i, i, i, i};  // around the edge, counter-clockwise seen from its end
      --cells[0][(axis + 1) % 3], --cells[0][(axis + 2) % 3];
      --cells[1][(axis + 2) % 3];
      --cells[3][(axis + 1) % 3];
      std::uint32_t v[4];
      for (int k = 0; k < 4; ++k) v[k] = vertex_of[grid.at(cells[grid.inside(i) ? k : 3 - k])];
      faces.push_back({v[0], v[1], v[2]});
      faces.push_back({v[0], v[2], v[3]});
    }
  });
  FaceMatrix matrix(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t k = 0; k < faces.size(); ++k)
    matrix.row(static_cast<Eigen::Index>(k)) << faces[k][0], faces[k][1], faces[k][2];
  return matrix;
}

}  // namespace

Mesh surface_nets(const Field& field, double extent, double cell) {
  const Grid grid = sample(field, extent, cell);
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::uint32_t> vertex_of(grid.values.size());
  for_each_index(grid, 0, grid.side - 1, [&](const Index3& i) {
    Eigen::Vector3d mean;
    if (!mean_crossing(grid, i, mean)) return;
    vertex_of[grid.at(i)] = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(mean);
  });
  Mesh mesh;
  mesh.points.resize(static_cast<Eigen::Index>(vertices.size()), 3);
  graph::parallel_for(vertices.size(), 256, [&](std::size_t k) {
    mesh.points.row(static_cast<Eigen::Index>(k)) =
        onto_surface(field, cell, vertices[k]).cast<float>();
  });
  mesh.faces = connect(grid, vertex_of);
  return mesh;
}

}  // namespace posevote

// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/geometry/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "nodes/geometry/normals.hpp"
#include "nodes/geometry/weld.hpp"

namespace posevote::geometry {
namespace {

/// One side of a face, as an undirected edge.
struct Side {
  std::uint64_t edge;  ///< smaller vertex in the high half, larger one in the low half
  std::uint32_t face;
  bool ascending;  ///< the face runs from the smaller vertex to the larger one
};

/// Faces across an edge; `agree`: they run along it in opposite directions, as they should.
struct Link {
  std::uint32_t face;
  bool agree;
};

/// Connected faces, and what turning them takes.
struct Component {
  std::vector<std::uint32_t> faces;
  Eigen::Array3d low, high;  ///< bounding box
  double area = 0;           ///< twice
  double volume = 0;         ///< six times, signed
  bool closed = true;        ///< each edge has two faces
};

/// Without faces that have two corners in one place, and without copies. Their corners are welded
/// in `welded`.
FaceMatrix proper_faces(const PointMatrix& points, const FaceMatrix& faces, FaceMatrix& welded) {
  const std::vector<std::uint32_t> first = weld(points);
  std::vector<std::pair<std::array<std::uint32_t, 3>, Eigen::Index>> keyed;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    std::array<std::uint32_t, 3> key{first[faces(f, 0)], first[faces(f, 1)], first[faces(f, 2)]};
    std::sort(key.begin(), key.end());
    if (key[0] != key[1] && key[1] != key[2]) keyed.emplace_back(key, f);
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<Eigen::Index> kept;
  for (std::size_t i = 0; i < keyed.size(); ++i)
    if (i == 0 || keyed[i].first != keyed[i - 1].first) kept.push_back(keyed[i].second);
  std::sort(kept.begin(), kept.end());
  FaceMatrix proper = faces(kept, Eigen::all);
  welded = proper.unaryExpr([&first](std::uint32_t corner) { return first[corner]; });
  return proper;
}

std::vector<Side> sorted_sides(const FaceMatrix& faces) {
  std::vector<Side> sides;
  sides.reserve(static_cast<std::size_t>(faces.size()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint64_t a = faces(f, corner);
      const std::uint64_t b = faces(f, (corner + 1) % 3);
      sides.push_back(
          {(std::min(a, b) << 32) | std::max(a, b), static_cast<std::uint32_t>(f), a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.face < b.face;
  });
  return sides;
}

/// `open` receives the edges of one face alone.
std::vector<std::vector<Link>> link_faces(const FaceMatrix& faces, std::vector<Edge>& open) {
  const std::vector<Side> sides = sorted_sides(faces);
  std::vector<std::vector<Link>> links(static_cast<std::size_t>(faces.rows()));
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin + 1;
    while (end < sides.size() && sides[end].edge == sides[begin].edge) ++end;
    if (end - begin == 2) {
      const Side& a = sides[begin];
      const Side& b = sides[begin + 1];
      const bool agree = a.ascending != b.ascending;
      links[a.face].push_back({b.face, agree});
      links[b.face].push_back({a.face, agree});
    }
    if (end - begin == 1) {
      const std::uint64_t edge = sides[begin].edge;
      open.push_back({static_cast<std::uint32_t>(edge >> 32), static_cast<std::uint32_t>(edge)});
    }
    begin = end;
  }
  return links;
}

void turn(FaceMatrix& faces, std::uint32_t face) { std::swap(faces(face, 1), faces(face, 2)); }

Eigen::Vector3d corner_of(const PointMatrix& points, const FaceMatrix& faces, std::uint32_t face,
                          int corner) {
  return points.row(faces(face, corner)).transpose().cast<double>();
}

double twice_area(const PointMatrix& points, const FaceMatrix& faces, std::uint32_t face) {
  const Eigen::Vector3d a = corner_of(points, faces, face, 0);
  return (corner_of(points, faces, face, 1) - a)
      .cross(corner_of(points, faces, face, 2) - a)
      .norm();
}

/// Makes the faces around `first` agree with each other and with most of their own area.
std::vector<std::uint32_t> agree_around(std::uint32_t first, const PointMatrix& points,
                                        const std::vector<std::vector<Link>>& links,
                                        std::vector<char>& seen, FaceMatrix& faces) {
  std::vector<std::uint32_t> members{first};
  std::vector<bool> turned{false};
  double balance = 0;  // area as in the file less the area that was turned
  seen[first] = 1;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const double area = twice_area(points, faces, members[i]);
    balance += turned[i] ? -area : area;
    for (const Link& link : links[members[i]]) {
      if (seen[link.face]) continue;
      seen[link.face] = 1;
      members.push_back(link.face);
      turned.push_back(turned[i] == link.agree);
    }
  }
  for (std::size_t i = 0; i < members.size(); ++i)
    if (turned[i] == (balance >= 0)) turn(faces, members[i]);
  return members;
}

Component measure(const PointMatrix& points, const FaceMatrix& faces,
                  std::vector<std::uint32_t> members) {
  Component component;
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  component.low = component.high = corner_of(points, faces, members.front(), 0).array();
  for (const std::uint32_t f : members)
    for (int corner = 0; corner < 3; ++corner) {
      const Eigen::Vector3d point = corner_of(points, faces, f, corner);
      centroid += point / (3.0 * static_cast<double>(members.size()));
      component.low = component.low.min(point.array());
      component.high = component.high.max(point.array());
    }
  for (const std::uint32_t f : members) {
    component.area += twice_area(points, faces, f);
    const Eigen::Vector3d a = corner_of(points, faces, f, 0) - centroid;
    const Eigen::Vector3d b = corner_of(points, faces, f, 1) - centroid;
    const Eigen::Vector3d c = corner_of(points, faces, f, 2) - centroid;
    component.volume += a.dot(b.cross(c));
  }
  component.faces = std::move(members);
  return component;
}

double size_of(const Component& component) {
  return (component.high - component.low).matrix().squaredNorm();
}

/// Its volume is noise.
bool is_flat(const Component& component) {
  return std::abs(component.volume) < 1e-4 * std::pow(component.area, 1.5);
}

bool is_turned(const Component& component, const Component& largest) {
  const bool inside = &component != &largest && (component.low >= largest.low).all() &&
                      (component.high <= largest.high).all();
  const Component& deciding = inside || is_flat(component) ? largest : component;
  return !is_flat(deciding) && deciding.volume < 0;
}

/// The connected components of faces, turned to agree within each.
std::vector<Component> find_components(const PointMatrix& points, const FaceMatrix& welded,
                                       WoundFaces& wound) {
  const std::vector<std::vector<Link>> links = link_faces(welded, wound.open_edges);
  FaceMatrix& faces = wound.faces;
  std::vector<char> seen(links.size(), 0);
  std::vector<Component> components;
  for (std::uint32_t first = 0; first < links.size(); ++first) {
    if (seen[first]) continue;
    components.push_back(measure(points, faces, agree_around(first, points, links, seen, faces)));
    Component& component = components.back();
    component.closed = std::all_of(component.faces.begin(), component.faces.end(),
                                   [&](std::uint32_t f) { return links[f].size() == 3; });
  }
  return components;
}

}  // namespace

WoundFaces wind_parts(const PointMatrix& points, const FaceMatrix& faces) {
  check_faces(points, faces);
  FaceMatrix welded;
  WoundFaces wound{proper_faces(points, faces, welded), {}, {}};
  if (wound.faces.rows() == 0) return wound;
  std::vector<Component> components = find_components(points, welded, wound);
  const Component& largest = *std::max_element(
      components.begin(), components.end(),
      [](const Component& a, const Component& b) { return size_of(a) < size_of(b); });
  std::vector<bool> turned;
  for (const Component& component : components) turned.push_back(is_turned(component, largest));
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (turned[i])
      for (const std::uint32_t f : components[i].faces) turn(wound.faces, f);
    wound.parts.push_back({std::move(components[i].faces), components[i].closed});
  }
  return wound;
}

FaceMatrix wind_outward(const PointMatrix& points, const FaceMatrix& faces) {
  return wind_parts(points, faces).faces;
}

}  // namespace posevote::geometry

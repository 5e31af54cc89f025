// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace posevote {
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

FaceMatrix without_degenerate(const FaceMatrix& faces) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < faces.rows(); ++f)
    if (faces(f, 0) != faces(f, 1) && faces(f, 1) != faces(f, 2) && faces(f, 2) != faces(f, 0))
      kept.push_back(f);
  return faces(kept, Eigen::all);
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

std::vector<std::vector<Link>> link_faces(const FaceMatrix& faces) {
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
    begin = end;
  }
  return links;
}

/// Connected faces and which of them must be turned to agree with the first.
struct Component {
  std::vector<std::uint32_t> faces;
  std::vector<bool> turned;
};

std::vector<Component> walk(const FaceMatrix& faces, bool& agreed) {
  const std::vector<std::vector<Link>> links = link_faces(faces);
  std::vector<char> seen(links.size(), 0);
  std::vector<Component> components;
  for (std::uint32_t first = 0; first < links.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = 1;
    Component component{{first}, {false}};
    for (std::size_t i = 0; i < component.faces.size(); ++i)
      for (const Link& link : links[component.faces[i]]) {
        if (seen[link.face]) continue;
        seen[link.face] = 1;
        component.faces.push_back(link.face);
        component.turned.push_back(link.agree ? component.turned[i] : !component.turned[i]);
        agreed = agreed && link.agree;
      }
    components.push_back(std::move(component));
  }
  return components;
}

/// Six times the signed volume between some faces and their centroid.
double signed_volume(const PointMatrix& points, const FaceMatrix& faces,
                     const std::vector<std::uint32_t>& some) {
  Eigen::RowVector3d centroid = Eigen::RowVector3d::Zero();
  for (const std::uint32_t f : some)
    for (int corner = 0; corner < 3; ++corner)
      centroid += points.row(faces(f, corner)).cast<double>();
  centroid /= 3.0 * static_cast<double>(some.size());
  double volume = 0;
  for (const std::uint32_t f : some) {
    const Eigen::RowVector3d a = points.row(faces(f, 0)).cast<double>() - centroid;
    const Eigen::RowVector3d b = points.row(faces(f, 1)).cast<double>() - centroid;
    const Eigen::RowVector3d c = points.row(faces(f, 2)).cast<double>() - centroid;
    volume += a.dot(b.cross(c));
  }
  return volume;
}

}  // namespace

FaceMatrix wind_outward(const PointMatrix& points, const FaceMatrix& faces) {
  FaceMatrix wound = without_degenerate(faces);
  if (wound.rows() == 0) return wound;
  bool agreed = true;
  std::vector<Component> components = walk(wound, agreed);
  for (const Component& component : components)
    for (std::size_t i = 0; i < component.faces.size(); ++i)
      if (component.turned[i])
        std::swap(wound(component.faces[i], 1), wound(component.faces[i], 2));
  if (agreed) {  // one piece, as far as turning goes
    for (std::size_t i = 1; i < components.size(); ++i)
      components[0].faces.insert(components[0].faces.end(), components[i].faces.begin(),
                                 components[i].faces.end());
    components.resize(1);
  }
  for (const Component& component : components) {
    if (signed_volume(points, wound, component.faces) >= 0) continue;
    for (const std::uint32_t f : component.faces) std::swap(wound(f, 1), wound(f, 2));
  }
  return wound;
}

}  // namespace posevote

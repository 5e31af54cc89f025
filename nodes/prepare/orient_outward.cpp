// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/prepare/orient_outward.hpp"

#include <queue>
#include <tuple>

namespace posevote {
namespace {

/// How parallel, then the smaller indices: the order does not depend on anything else.
struct Step {
  float parallel;
  std::uint32_t to;
  std::uint32_t from;

  bool operator<(const Step& other) const {
    return std::tuple(parallel, other.to, other.from) < std::tuple(other.parallel, to, from);
  }
};

class Traversal {
 public:
  Traversal(const PointMatrix& points, const PointGrid& grid, float radius, PointMatrix& normals)
      : points_(points),
        grid_(grid),
        radius_(radius),
        normals_(normals),
        part_(static_cast<std::size_t>(points.rows()), -1),
        visited_(part_.size(), 0) {
    for (std::size_t i = 0; i < visited_.size(); ++i)
      visited_[i] = normals.row(static_cast<Eigen::Index>(i)).isZero() ? 1 : 0;
  }

  void run() {
    int parts = 0;
    for (std::uint32_t i = 0; i < part_.size(); ++i) {
      if (visited_[i] || part_[i] >= 0) continue;
      spread(start_of_part(i, parts++));
    }
  }

 private:
  Eigen::RowVector3f at(std::uint32_t i) const { return points_.row(i); }

  /// Collects the connected part around `first` and turns its farthest point's normal outward.
  std::uint32_t start_of_part(std::uint32_t first, int number) {
    std::vector<std::uint32_t> members{first};
    part_[first] = number;
    for (std::size_t i = 0; i < members.size(); ++i)
      grid_.for_each_within(at(members[i]), radius_, [&](std::uint32_t next, float) {
        if (visited_[next] || part_[next] >= 0) return;
        part_[next] = number;
        members.push_back(next);
      });
    Eigen::RowVector3d centroid = Eigen::RowVector3d::Zero();
    for (const std::uint32_t member : members) centroid += at(member).cast<double>();
    centroid /= static_cast<double>(members.size());
    std::uint32_t farthest = first;
    double distance = -1;
    for (const std::uint32_t member : members) {
      const double squared = (at(member).cast<double>() - centroid).squaredNorm();
      if (squared <= distance) continue;
      distance = squared;
      farthest = member;
    }
    if (normals_.row(farthest).cast<double>().dot(at(farthest).cast<double>() - centroid) < 0)
      normals_.row(farthest) *= -1.0F;
    return farthest;
  }

  void spread(std::uint32_t start) {
    std::priority_queue<Step> steps;
    steps.push({1, start, start});
    while (!steps.empty()) {
      const Step step = steps.top();
      steps.pop();
      if (visited_[step.to]) continue;
      visited_[step.to] = 1;
      if (normals_.row(step.to).dot(normals_.row(step.from)) < 0) normals_.row(step.to) *= -1.0F;
      grid_.for_each_within(at(step.to), radius_, [&](std::uint32_t next, float) {
        if (visited_[next]) return;
        steps.push({std::abs(normals_.row(next).dot(normals_.row(step.to))), next, step.to});
      });
    }
  }

  const PointMatrix& points_;
  const PointGrid& grid_;
  const float radius_;
  PointMatrix& normals_;
  std::vector<int> part_;
  std::vector<char> visited_;
};

}  // namespace

void orient_outward(const PointMatrix& points, const PointGrid& grid, float radius,
                    PointMatrix& normals) {
  Traversal(points, grid, radius, normals).run();
}

}  // namespace posevote

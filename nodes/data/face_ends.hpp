// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

namespace posevote {

/// Where a face of a model ends (geometry/edge_pairs.hpp).
struct FaceEnd {
  Eigen::Index row = 0;                                 ///< of a point at its rim
  Eigen::Vector3f place = Eigen::Vector3f::Zero();      ///< of the end [m]
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< along the face; unit length
};

/// The ends of a model's faces, found by whoever asks first, for all scans. A copy knows none: its
/// model may be changed. Safe to ask from many threads.
class KnownFaceEnds {
 public:
  KnownFaceEnds() = default;
  KnownFaceEnds(const KnownFaceEnds&) {}
  KnownFaceEnds& operator=(const KnownFaceEnds&) {
    known_.clear();
    return *this;
  }

  /// `find`() is asked once for a resolution [m] and number; what it gives stays where it is.
  template <class Find>
  const std::vector<FaceEnd>& get(float resolution, int most, const Find& find) const {
    const std::scoped_lock lock(mutex_);
    const std::pair key(resolution, most);
    const auto known = known_.find(key);
    return known != known_.end() ? known->second : known_.emplace(key, find()).first->second;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::map<std::pair<float, int>, std::vector<FaceEnd>> known_;
};

}  // namespace posevote

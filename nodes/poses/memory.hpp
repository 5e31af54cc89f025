// SPDX-License-Identifier: BSD-3-Clause
// What was computed of an object's poses, as long as it holds. A pose is judged and refined by the
// scan around it, so until something is taken out of the scan there, to ask again is to get the same
// answer. Most of a scan stays as it is when an instance is found, and most poses are asked for in
// every round. What is remembered changes no result.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "nodes/poses/measure_fit.hpp"
#include "nodes/poses/patches.hpp"
#include "nodes/poses/scan_state.hpp"

namespace posevote::poses {

/// A pose, and what is asked of it.
struct Question {
  Eigen::Isometry3d T_scene_model;
  std::int64_t how = 0;
  double reach = 1;

  bool operator==(const Question& other) const {
    return how == other.how && reach == other.reach &&
           T_scene_model.matrix() == other.T_scene_model.matrix();
  }
};

struct QuestionHash {
  std::size_t operator()(const Question& question) const;
};

/// An answer, and the part of the scan that it depends on.
template <class Value>
struct Answer {
  Value value;
  Eigen::AlignedBox3d centers;  ///< of balls [m]
  double radius = 0;            ///< of each [m]
};

/// Answers of one kind. Safe to ask from many threads.
template <class Value>
class Answers {
 public:
  /// `answer`() gives an Answer; asked where none is remembered that still holds.
  template <class Compute>
  Value get(const ScanState& scan, const Question& question, const Compute& answer) {
    {
      const std::scoped_lock lock(mutex_);
      const auto known = known_.find(question);
      if (known != known_.end() && holds(scan, known->second)) return known->second.answer.value;
    }
    Known fresh{answer(), scan.takes};
    const std::scoped_lock lock(mutex_);
    return known_.insert_or_assign(question, std::move(fresh)).first->second.answer.value;
  }

 private:
  struct Known {
    Answer<Value> answer;
    int takes = 0;  ///< ScanState::takes then
  };

  static bool holds(const ScanState& scan, const Known& known) {
    return !scan.changed_since(known.takes, known.answer.centers, known.answer.radius);
  }

  std::mutex mutex_;
  std::unordered_map<Question, Known, QuestionHash> known_;
};

/// Of one object.
struct Memory {
  Answers<Fit> fits;
  Answers<Shared> residuals;
  Answers<Eigen::Isometry3d> refined;
  Answers<std::size_t> explained;
};

}  // namespace posevote::poses

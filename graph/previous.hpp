// SPDX-License-Identifier: BSD-3-Clause
// What a node may know of the frame before: a node that takes a Previous<T> is wired to a stream of
// T as any other, but reads what that stream held in the frame before. So a node early in the way
// may know what was answered at its end, where a T would make a cycle.
//
//   Out look_again(const Cloud& scan, const Previous<Detections>& answer, const Params&)
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "graph/value.hpp"

namespace posevote::graph {

/// The value of the last frame that had one; null in the first, and where none before had.
template <class T>
struct Previous {
  std::shared_ptr<const T> value;
};

/// How the names of such types begin; no other does.
inline const std::string kPrevious = "previous ";

/// Whether an input of that type reads the frame before.
inline bool is_previous(const StreamType& type) { return type.name.starts_with(kPrevious); }

/// Whether it reads a stream of the other type.
inline bool is_previous_of(const StreamType& type, const StreamType& stream) {
  return type.name == kPrevious + stream.name;
}

template <class T>
struct StreamTraits<Previous<T>> {
  static StreamType type() {
    return {typeid(Previous<T>), false, kPrevious + StreamTraits<T>::type().name};
  }
  static Previous<T> unwrap(const Value& value) { return {StreamTraits<T>::share(value)}; }
  static Value wrap(Previous<T>&& previous) { return std::move(previous.value); }
};

}  // namespace posevote::graph

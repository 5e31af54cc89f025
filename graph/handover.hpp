// SPDX-License-Identifier: BSD-3-Clause
// Hands what a stream held in one frame to the next (graph/previous.hpp). The value may be there
// before the next frame has entered, or long after; what a frame gets depends on the frames alone.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "graph/awaited.hpp"

namespace posevote::graph::detail {

/// Of one stream; `Message` is a pointer to a frame.
template <class Message>
class Handover {
 public:
  /// A frame that may go on, with what was handed to it.
  struct Handed {
    Message to;
    Value value;
  };

  /// The stream's value in a frame, null where it failed: then the value before it stands. Returns
  /// who waited for that.
  std::vector<Handed> give(std::size_t sequence, Value value) {
    const std::lock_guard lock(mutex_);
    given_[sequence] = std::move(value);
    std::vector<Handed> handed;
    for (auto next = given_.find(known_); next != given_.end(); next = given_.find(known_)) {
      if (next->second) last_ = std::move(next->second);
      given_.erase(next);
      ready_[++known_] = last_;
      if (auto one = match(known_)) handed.push_back(std::move(*one));
    }
    return handed;
  }

  /// A frame enters, the first with nothing to wait for. Returns it if it may go on already.
  std::optional<Handed> enter(std::size_t sequence, const Message& message) {
    const std::lock_guard lock(mutex_);
    if (sequence == 0) return Handed{message, nullptr};
    entered_.emplace(sequence, message);
    return match(sequence);
  }

 private:
  std::optional<Handed> match(std::size_t sequence) {
    const auto value = ready_.find(sequence);
    const auto message = entered_.find(sequence);
    if (value == ready_.end() || message == entered_.end()) return std::nullopt;
    Handed handed{std::move(message->second), std::move(value->second)};
    ready_.erase(value);
    entered_.erase(message);
    return handed;
  }

  std::mutex mutex_;
  std::size_t known_ = 0;                   ///< of so many frames in a row the value is known
  Value last_;                              ///< of the last of them that had one
  std::map<std::size_t, Value> given_;      ///< of frames behind one that is not known
  std::map<std::size_t, Value> ready_;      ///< for frames that have not entered
  std::map<std::size_t, Message> entered_;  ///< frames that wait
};

/// Of all streams of a plan that are handed on. `go_on(node, message)` is called for each node that
/// may read now what the frame before left, which stands in the frame's `previous`.
template <class Message>
class Handovers {
 public:
  explicit Handovers(const Plan& plan) : plan_(plan) {
    for (std::size_t i = 0; i < plan.streams.size(); ++i)
      if (std::vector<std::size_t> followers = followers_of(plan, i); !followers.empty())
        streams_.push_back({i, std::move(followers), std::make_unique<Handover<Message>>()});
  }

  template <class GoOn>
  void enter(const Message& message, const GoOn& go_on) {
    for (const Stream& stream : streams_)
      if (auto handed = stream.handover->enter(message->sequence, message))
        let_go_on(stream, std::move(*handed), go_on);
  }

  /// Node i is done with a frame.
  template <class GoOn>
  void hand_on(std::size_t i, const Message& from, const GoOn& go_on) {
    for (const Stream& stream : streams_)
      if (plan_.streams[stream.number].producer == static_cast<int>(i))
        for (auto& handed : stream.handover->give(from->sequence, from->values[stream.number]))
          let_go_on(stream, std::move(handed), go_on);
  }

 private:
  struct Stream {
    std::size_t number = 0;
    std::vector<std::size_t> followers;
    std::unique_ptr<Handover<Message>> handover;
  };

  template <class GoOn>
  void let_go_on(const Stream& stream, typename Handover<Message>::Handed handed,
                 const GoOn& go_on) {
    handed.to->previous[stream.number] = std::move(handed.value);
    for (const std::size_t follower : stream.followers) go_on(follower, handed.to);
  }

  const Plan& plan_;
  std::vector<Stream> streams_;
};

}  // namespace posevote::graph::detail

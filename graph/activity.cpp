// SPDX-License-Identifier: BSD-3-Clause
#include "graph/activity.hpp"

namespace posevote::graph {

using Clock = std::chrono::steady_clock;

Activity::Call::Call(Activity* activity, const std::string& node, const std::string& frame)
    : activity_(activity) {
  if (!activity_) return;
  work_.node = node;
  work_.frame = frame;
  begin_ = Clock::now();
  const std::lock_guard lock(activity_->mutex_);
  place_ = activity_->running_.insert(activity_->running_.end(), this);
}

Activity::Call::~Call() {
  if (!activity_) return;
  const std::lock_guard lock(activity_->mutex_);
  activity_->running_.erase(place_);
}

void Activity::Call::begin_objects(std::size_t count) {
  if (!activity_) return;
  const std::lock_guard lock(activity_->mutex_);
  work_.objects = count;
}

void Activity::Call::end_object() {
  if (!activity_) return;
  const std::lock_guard lock(activity_->mutex_);
  ++work_.done;
}

std::optional<Activity::Work> Activity::longest() const {
  const std::lock_guard lock(mutex_);
  if (running_.empty()) return std::nullopt;
  Work work = running_.front()->work_;
  work.seconds = std::chrono::duration<double>(Clock::now() - running_.front()->begin_).count();
  return work;
}

}  // namespace posevote::graph

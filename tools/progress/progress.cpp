// SPDX-License-Identifier: BSD-3-Clause
#include "tools/progress/progress.hpp"

#include <algorithm>
#include <utility>

#include "tools/progress/console.hpp"
#include "tools/text.hpp"

namespace posevote {
namespace {

constexpr std::chrono::milliseconds kBetweenDrawings(100);
constexpr double kLongestSilence = 60;  ///< [s]
constexpr double kLongCall = 2;         ///< [s]

/// "; match_features at rs12 for 3 s, 7 of 21 objects"
std::string work_text(const graph::Activity::Work& work) {
  std::string text = "; " + work.node;
  if (!work.frame.empty()) text += " at " + work.frame;
  text += " for " + duration_text(work.seconds);
  if (work.objects > 1)
    text += ", " + std::to_string(work.done) + " of " + std::to_string(work.objects) + " objects";
  return text;
}

std::string count_text(const Task& task, const TaskState& state) {
  std::string text =
      "[" + std::to_string(state.done) + "/" + std::to_string(task.total) + "] " + task.what;
  if (state.done == 0 || state.seconds <= state.waiting)
    return text + ", " + duration_text(state.seconds);
  const double rate = static_cast<double>(state.done) / (state.seconds - state.waiting);
  text = "[" + std::to_string(state.done) + "/" + std::to_string(task.total) + "] " +
         format(rate < 10 ? "%.2g " : "%.0f ", rate) + task.what + "/s";
  if (state.done < task.total)
    text += ", " +
            duration_text(std::max(
                0.0, static_cast<double>(task.total - state.done) / rate - state.waiting)) +
            " left";
  return text;
}

}  // namespace

std::string to_text(const Task& task, const TaskState& state) {
  if (task.interrupted && *task.interrupted)
    return "[" + std::to_string(state.done) + "/" + std::to_string(task.total) +
           "] ending what is begun; Ctrl-C again ends at once";
  std::string text =
      task.total > 0 ? count_text(task, state) : task.what + ", " + duration_text(state.seconds);
  if (!state.note.empty()) text += ", " + state.note;
  if (state.work && state.work->seconds >= kLongCall) text += work_text(*state.work);
  return text;
}

Progress::Progress(Task task) : task_(std::move(task)) {
  if (!task_.shown) return;
  thread_ = std::thread([this] {
    std::unique_lock lock(mutex_);
    show(lock);
  });
}

Progress::~Progress() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_one();
  thread_.join();
  console::draw("");
}

void Progress::advance(std::size_t count) {
  const std::lock_guard lock(mutex_);
  done_ += count;
  advanced_ = seconds();
}

void Progress::note(std::string text) {
  const std::lock_guard lock(mutex_);
  note_ = std::move(text);
}

double Progress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

TaskState Progress::state() const {
  const double now = seconds();
  return {done_, now, note_,
          task_.activity ? task_.activity->longest() : std::optional<graph::Activity::Work>(),
          now - advanced_};
}

void Progress::show(std::unique_lock<std::mutex>& lock) {
  double patience = task_.patience;
  while (!ended_.wait_for(lock, kBetweenDrawings, [this] { return end_; })) {
    const TaskState now = state();
    if (console::is_live()) {
      console::draw(to_text(task_, now));
    } else if (std::min(console::silence(), now.seconds) >= patience) {
      console::complain(to_text(task_, now));
      patience = std::min(2 * patience, kLongestSilence);
    }
  }
}

}  // namespace posevote

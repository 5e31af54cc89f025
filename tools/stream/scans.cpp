// SPDX-License-Identifier: BSD-3-Clause
#include "tools/stream/scans.hpp"

#include <algorithm>
#include <cmath>

#include "tools/text.hpp"

namespace posevote::stream {

using Clock = std::chrono::steady_clock;

std::optional<SceneEntry> Scans::next() {
  std::optional<TakenScan> scan = take();
  if (!scan) return std::nullopt;
  const std::lock_guard lock(mutex_);
  since_[scan->entry.number] = scan->since;
  return std::move(scan->entry);
}

void Scans::answered(std::size_t number) {
  const std::lock_guard lock(mutex_);
  const auto since = since_.find(number);
  latencies_.push_back(std::chrono::duration<double>(Clock::now() - since->second).count());
  since_.erase(since);
}

double Scans::latency(double share) const {
  if (latencies_.empty()) return 0;
  std::vector<double> sorted = latencies_;
  const auto last = static_cast<double>(sorted.size()) - 1;
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(
                                       std::clamp(std::ceil(share * (last + 1)) - 1, 0.0, last));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

std::string Scans::text() const {
  if (latencies_.size() < 2) return "";
  std::string text = format("latency %.3g s median, %.3g s 95 %%, %.3g s 99 %%", latency(0.5),
                            latency(0.95), latency(0.99));
  if (most_behind_ > 0) text += "; " + std::to_string(most_behind_) + " behind at most";
  if (left_out_ > 0) text += "; " + std::to_string(left_out_) + " left out";
  return text;
}

nlohmann::ordered_json Scans::json() const {
  return {{"latency_s", {{"median", latency(0.5)}, {"p95", latency(0.95)}, {"p99", latency(0.99)}}},
          {"behind", most_behind_},
          {"left_out", left_out_}};
}

std::optional<TakenScan> ListedScans::take() {
  if (taken_ == scans_.size()) return std::nullopt;
  return TakenScan{scans_[taken_++], Clock::now()};
}

}  // namespace posevote::stream

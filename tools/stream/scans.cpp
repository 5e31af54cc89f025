// SPDX-License-Identifier: BSD-3-Clause
#include "tools/stream/scans.hpp"

#include "tools/quantiles.hpp"
#include "tools/text.hpp"

namespace posevote::stream {

using Clock = std::chrono::steady_clock;

void Scans::answered(Clock::time_point since) {
  latencies_.push_back(std::chrono::duration<double>(Clock::now() - since).count());
}

std::string Scans::text() const {
  if (latencies_.size() < 2) return "";
  std::string text = "latency " + latency_text(latencies_);
  if (most_behind_ > 0) text += "; " + std::to_string(most_behind_) + " behind at most";
  if (left_out_ > 0) text += "; " + std::to_string(left_out_) + " left out";
  return text;
}

nlohmann::ordered_json Scans::json() const {
  return {{"latency_s",
           {{"median", quantile(latencies_, 0.5)},
            {"p95", quantile(latencies_, 0.95)},
            {"p99", quantile(latencies_, 0.99)}}},
          {"behind", most_behind_},
          {"left_out", left_out_}};
}

std::optional<TakenScan> ListedScans::next() {
  if (taken_ == scans_.size()) return std::nullopt;
  return TakenScan{scans_[taken_++], Clock::now()};
}

}  // namespace posevote::stream

// SPDX-License-Identifier: BSD-3-Clause
// The scans of a run, one after the other, and how long each took from when it was there until it
// was answered.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "pipelines/inputs.hpp"

namespace posevote::stream {

/// A scan, and since when it has been there.
struct TakenScan {
  SceneEntry entry;
  std::chrono::steady_clock::time_point since;
};

class Scans {
 public:
  virtual ~Scans() = default;

  /// The next; nothing when no more will come. Waits for it.
  virtual std::optional<TakenScan> next() = 0;
  /// How many there are; 0 where nobody knows.
  virtual std::size_t count() const { return 0; }
  /// To be called for each that next() gave, with its `since`, by one thread at a time; next() may run
  /// on another meanwhile.
  void answered(std::chrono::steady_clock::time_point since);

  const std::vector<double>& latencies() const { return latencies_; }  ///< [s]
  /// "latency 0.12 s median, 0.18 s 95 %, 0.24 s 99 %; 3 behind at most, 5 left out"; "" of a single
  /// scan.
  std::string text() const;
  nlohmann::ordered_json json() const;

 protected:
  std::size_t most_behind_ = 0;  ///< that waited beside the one that was taken
  std::size_t left_out_ = 0;

 private:
  std::vector<double> latencies_;
};

/// Those that are there when the run begins; each has waited for nobody before it is taken.
class ListedScans : public Scans {
 public:
  explicit ListedScans(std::vector<SceneEntry> scans) : scans_(std::move(scans)) {}
  std::optional<TakenScan> next() override;
  std::size_t count() const override { return scans_.size(); }

 private:
  std::vector<SceneEntry> scans_;
  std::size_t taken_ = 0;
};

}  // namespace posevote::stream

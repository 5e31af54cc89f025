// SPDX-License-Identifier: BSD-3-Clause
// One scan as the page holds it: some of its points, from where to look at them, and votes in it.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tools/report/pack.hpp"
#include "tools/report/shown_run.hpp"

namespace posevote::page {

/// Whose votes to show, and what the run's nodes need to cast them again.
struct VotesWanted {
  int obj_id = 0;
  graph::Constants constants;
};

/// Adds to `json` how to draw the scan and returns its bytes in elements named after `id`. Of a scan
/// that is gone or cannot be read, `json` says so, and nothing is thrown. `points`: at most; with
/// votes half of them are votes.
std::string show_scan(const ScanName& scan, const ShownRun& inputs, const VotesWanted* votes,
                      std::size_t points, const std::string& id, nlohmann::ordered_json& json);

/// What is packed in the element of that name.
nlohmann::ordered_json to_json(const Packed& packed, const std::string& element);

}  // namespace posevote::page

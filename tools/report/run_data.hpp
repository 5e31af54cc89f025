// SPDX-License-Identifier: BSD-3-Clause
// A run as the page's viewer (tools/report/page/) takes it: what was found as JSON, and the scans,
// models and votes as packed bytes, each in an element of its own that is decoded when it is shown.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/report/run_results.hpp"
#include "tools/report/shown_run.hpp"

namespace posevote::page {

/// What the page is to show of a run.
struct RunView {
  std::size_t points = 0;          ///< of each scan, at most; none where 0
  std::size_t faces = 4000;        ///< of each model, at most
  std::string votes;               ///< name or obj_id of an object; empty: none
  std::vector<std::string> scans;  ///< only those of these names; empty: all
  bool explain = false;            ///< say of each object why it was found or not
};

/// Frames of a run, answered or failed, that `view` takes in.
std::size_t count_scans(const RunResults& run, const RunView& view);

/// Markup that the viewer fills, of the run in `folder`. `id`: unique on the page. Throws
/// std::invalid_argument where votes or explanations are asked for of an object that there is not,
/// or the models are gone.
std::string run_markup(const std::filesystem::path& folder, const RunResults& run, ShownRun& inputs,
                       const RunView& view, const std::string& id);

/// JSON that can stand in a <script>: ASCII, and nothing in it that could end the element.
std::string script_json(const nlohmann::ordered_json& json);

/// What there is to say of one object in one scan, in sentences, for the details of its card.
std::vector<std::string> sentences(const ReportedObject& object);

}  // namespace posevote::page

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <stdexcept>

#include "nodes/formats/results_json.hpp"
#include "tools/manifest/manifest.hpp"

namespace posevote {
namespace {

using Texts = std::map<std::string, std::string>;

/// Collects sentences.
class Comparison {
 public:
  void compare(const std::string& what, const std::string& before, const std::string& now) {
    if (before != now) sentences_.push_back(what + " was " + shown(before) + ", now " + shown(now));
  }

  /// What has a name in either.
  void compare_all(const std::string& kind, const Texts& before, const Texts& now) {
    std::set<std::string> names;
    for (const Texts* texts : {&before, &now})
      for (const auto& [name, text] : *texts) names.insert(name);
    for (const std::string& name : names) {
      const auto was = before.find(name), is = now.find(name);
      if (was == before.end())
        sentences_.push_back(kind + name + " was not there");
      else if (is == now.end())
        sentences_.push_back(kind + name + " is not there any more");
      else
        compare(kind + name, was->second, is->second);
    }
  }

  std::vector<std::string> take() { return std::move(sentences_); }
  bool is_empty() const { return sentences_.empty(); }

 private:
  static std::string shown(const std::string& text) { return text.empty() ? "empty" : text; }

  std::vector<std::string> sentences_;
};

std::string program(const Manifest& run) {
  return run.version + " (" + run.code.substr(0, 12) + ")";
}

/// By number and name. `hashed`: with what the files hold, which is not known of a library's.
Texts models(const Manifest& run, bool hashed) {
  Texts texts;
  for (const SoughtModel& model : run.models)
    texts[std::to_string(model.obj_id) + " (" + model.name + ")"] =
        hashed ? "content " + model.hash.substr(0, 12) : "";
  return texts;
}

/// The first few.
std::string some(const std::vector<std::string>& sentences) {
  constexpr std::size_t kShown = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, sentences.size()); ++i)
    text += (i > 0 ? "; " : "") + sentences[i];
  const std::size_t more = sentences.size() - std::min(kShown, sentences.size());
  return more == 0 ? text : text + "; and " + std::to_string(more) + " more";
}

}  // namespace

std::vector<std::string> differences(const Manifest& before, const Manifest& now) {
  Comparison comparison;
  comparison.compare("the program", program(before), program(now));
  comparison.compare("--seed", std::to_string(before.seed), std::to_string(now.seed));
  comparison.compare("--split", before.split, now.split);
  comparison.compare_all("the wiring of the node ", before.wiring, now.wiring);
  comparison.compare_all("the parameter ", before.parameters, now.parameters);
  const bool hashed = before.library.empty() && now.library.empty();
  comparison.compare_all("the model ", models(before, hashed), models(now, hashed));
  // By another program or with other parameters the same models are another library.
  if (comparison.is_empty())
    comparison.compare("what the models were made to", before.library_hash, now.library_hash);
  return comparison.take();
}

void take_up(const std::filesystem::path& out, Manifest& now) {
  const std::string file = (out / "run.json").string();
  const std::string unknown = ": what the run to resume was is not known; choose another --out";
  std::optional<Manifest> before;
  try {
    before = read_manifest(out);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(error.what() + unknown);
  }
  if (!before) {
    for (const char* answers : kAnswerFiles)
      if (!formats::read_frames(out / answers, "frame").items.empty())
        throw std::invalid_argument(file + ": is not there" + unknown);
    return;
  }
  const std::vector<std::string> all = differences(*before, now);
  if (!all.empty())
    throw std::invalid_argument(file + ": the run to resume is another: " + some(all) +
                                "; choose another --out");
  now.starts.insert(now.starts.begin(), before->starts.begin(), before->starts.end());
}

}  // namespace posevote

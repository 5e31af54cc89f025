// SPDX-License-Identifier: BSD-3-Clause
#include "tools/experiment/test_set.hpp"

#include <map>
#include <stdexcept>

#include "pipelines/installed.hpp"
#include "tools/simulate/simulate.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;

/// A few images of each replica: some thirty instances tell what a term is for.
const std::map<std::string, std::size_t> kEvery = {
    {"demo", 1}, {"uwa", 6}, {"queens", 10}, {"icbin", 30}, {"icmi", 40}};

/// The replica of a config's scenes; it is made where it is not there yet, without images that
/// nobody will look at.
fs::path find_replica(const std::string& config, std::size_t every, const fs::path& out,
                      bool colors) {
  const fs::path dataset =
      out / "replicas" / (config + (colors ? "_colors" : "") + "_every_" + std::to_string(every));
  const std::string file = (shared_folder() / "configs" / (config + "_scenes.yaml")).string();
  if (!fs::exists(file))
    throw std::invalid_argument("--sets " + config + ": expected a config with scenes to " +
                                "simulate, or CONFIG=DIR for a real set");
  if (fs::exists(dataset)) return dataset;
  Spec spec = read_spec(file);
  spec.colors |= colors;
  simulate_set(spec, dataset, every);
  return dataset;
}

}  // namespace

TestSet find_set(const std::string& text, std::size_t every, bool quick, const fs::path& out,
                 bool colors) {
  const std::size_t equals = text.find('=');
  if (equals != std::string::npos) {
    const fs::path dataset = text.substr(equals + 1);
    const std::string config = text.substr(0, equals);
    const std::string name = dataset.filename().empty() ? config : dataset.filename().string();
    return {name, config, dataset, std::max<std::size_t>(1, every)};
  }
  const auto known = kEvery.find(text);
  if (every == 0) every = (known == kEvery.end() ? 1 : known->second) * (quick ? 4 : 1);
  return {text, text, find_replica(text, every, out, colors), 1};  // holds what is to be seen
}

}  // namespace posevote

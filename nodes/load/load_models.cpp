// SPDX-License-Identifier: BSD-3-Clause
// Loads the models of a run, in metres, each in its own frame, in the order given: point clouds or
// meshes, in any format of nodes/formats/read_*.cpp. Files are read in parallel. Warns of a model
// whose size says that its unit is another. Fails with the names of all models that could not be
// read.
//
//   load_models: {in: model_files, out: model_meshes, unit: mm}
#include <algorithm>
#include <exception>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/data/files.hpp"
#include "nodes/formats/read_scan.hpp"
#include "nodes/formats/units.hpp"
#include "nodes/geometry/extent.hpp"

namespace posevote::load {
namespace {

struct Params {
  std::string unit = "m";
};

/// From the file, or from memory.
Mesh read_model(const ModelFile& file, double metres, const formats::Warn& warn = {}) {
  if (!file.mesh) return formats::read_mesh(file.path, metres, warn);
  Mesh model = *file.mesh;
  model.points = (model.points.cast<double>() * metres).cast<float>();
  return model;
}

Mesh load_model(const ModelFile& file, const graph::FrameContext& context,
                const std::string& unit) {
  const auto warn = [&](const std::string& what) {
    context.warn(file.path.string() + ": " + what);
  };
  Mesh model = read_model(file, formats::metres_per(unit), warn);
  const double diagonal = geometry::model_diagonal(model.points);  // one without fails here, named
  const std::string odd = formats::odd_model_size(diagonal, unit);
  if (!odd.empty()) warn(odd);
  return model;
}

/// The unit in which the largest of the files is an object of likely size.
std::string likely_unit(const ModelFiles& files, const graph::FrameContext& context) {
  constexpr double kLeastInMillimetres = 10;  // the largest things in m, the smallest in mm
  std::vector<double> sizes(files.size());
  graph::parallel_for(files.size(), 1, [&](std::size_t i) {
    try {
      sizes[i] = geometry::model_diagonal(read_model(files[i], 1).points);
    } catch (const std::exception&) {  // is told below, with the others
    }
  });
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  const formats::LikelyUnit likely = formats::likely_unit(largest, kLeastInMillimetres);
  if (!likely.doubt.empty())
    context.warn("the largest model: " + likely.doubt + "; say --model-unit (load_models.unit)");
  return likely.unit;
}

PerObject<Mesh> load_models(const ModelFiles& files, const graph::FrameContext& context,
                            const Params& params) {
  if (files.empty()) throw std::runtime_error("there are no models to load");
  const std::string unit = params.unit == "auto" ? likely_unit(files, context) : params.unit;
  PerObject<Mesh> models;
  models.slots.resize(files.size());
  std::vector<std::string> problems(files.size());
  graph::parallel_for(files.size(), 1, [&](std::size_t i) {
    try {
      models.slots[i] = std::make_shared<const Mesh>(load_model(files[i], context, unit));
    } catch (const std::exception& error) {
      problems[i] = error.what();
    }
  });
  std::string all;
  std::vector<graph::ObjectFailure> failed;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    if (problems[i].empty()) continue;
    all += (all.empty() ? "" : "; ") + files[i].path.string() + ": " + problems[i];
    failed.push_back({i, problems[i]});
  }
  if (!failed.empty()) throw graph::ObjectErrors(failed, all);
  return models;
}

const auto registered =
    graph::register_node("load_models", load_models, "Loads all models, as meshes or raw clouds.")
        .input("model_files")
        .output("model_meshes")
        .param("unit", &Params::unit, "",
               "Unit of length in model files; auto: m or mm, by their size.",
               graph::one_of(formats::units_or_auto()));

}  // namespace
}  // namespace posevote::load

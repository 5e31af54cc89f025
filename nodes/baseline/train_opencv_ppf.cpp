// SPDX-License-Identifier: BSD-3-Clause
// Point-pair features of every model (Drost, Ulrich, Navab, Ilic, CVPR 2010; OpenCV's code): all
// pairs of the model's points in a hash table by distance and angles.
//
// Fed by the library alone, so it runs once, not per scan. Quadratic in the points and, because
// OpenCV walks a whole bucket at each insertion, in the pairs that are alike: smooth bodies train
// slowly. Some 70 bytes a pair. Fails where a model is flat along an axis or gives more than 3000
// points. Exists only where OpenCV was found at build time (libopencv-contrib-dev).
//
//   train_opencv_ppf: {in: library, out: ppf_models}
#include <stdexcept>
#include <string>

#include "graph/parallel.hpp"
#include "graph/registry.hpp"
#include "nodes/adapters/opencv_ppf_detector.hpp"
#include "nodes/data/ppf_model.hpp"

namespace posevote::baseline {
namespace {

std::shared_ptr<const PpfModel> train(const std::shared_ptr<const Model>& model,
                                      const adapters::PpfTraining& params) {
  if (model->cloud.normals.rows() != model->cloud.points.rows())
    throw std::runtime_error("model " + model->name + " has points without normals");
  try {
    return std::make_shared<const PpfModel>(
        PpfModel{model, std::make_shared<const adapters::PpfDetector>(model->cloud, params)});
  } catch (const std::exception& error) {
    throw std::runtime_error("model " + model->name + ": " + error.what());
  }
}

PerObject<PpfModel> train_opencv_ppf(const ModelLibrary& library,
                                     const adapters::PpfTraining& params) {
  PerObject<PpfModel> trained;
  trained.slots.resize(library.models.size());
  graph::parallel_for(trained.size(), 1,
                      [&](std::size_t i) { trained.slots[i] = train(library.models[i], params); });
  return trained;
}

const auto registered =
    graph::register_node("train_opencv_ppf", train_opencv_ppf,
                         "Rival: hash tables of the models' point pairs (OpenCV).")
        .input("library")
        .output("ppf_models")
        .param("sampling", &adapters::PpfTraining::sampling, "x diagonal",
               "Spacing of the model's points.", graph::in_range(0.02, 0.5))
        .param("distance", &adapters::PpfTraining::distance, "x diagonal",
               "Step of a pair's distance.", graph::in_range(0.01, 0.5))
        .param("angles", &adapters::PpfTraining::angles, "",
               "Steps of a pair's angles in a full turn.", graph::in_range(4, 120));

}  // namespace
}  // namespace posevote::baseline

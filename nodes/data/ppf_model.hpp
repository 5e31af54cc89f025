// SPDX-License-Identifier: BSD-3-Clause
// An object as OpenCV's point-pair features know it.
#pragma once

#include <memory>

#include "nodes/data/model.hpp"

namespace posevote {

namespace adapters {
class PpfDetector;
}

struct PpfModel {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const adapters::PpfDetector> detector;
};

}  // namespace posevote

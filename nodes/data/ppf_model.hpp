// SPDX-License-Identifier: BSD-3-Clause
// An object as OpenCV's point-pair features know it.
#pragma once

#include <memory>

#include "nodes/data/model.hpp"

namespace posevote {

class PpfDetector;  // nodes/baseline/opencv_ppf_detector.hpp

struct PpfModel {
  std::shared_ptr<const Model> model;
  std::shared_ptr<const PpfDetector> detector;
};

}  // namespace posevote

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "nodes/data/features.hpp"

namespace posevote::descriptors {

/// The features of several scales, each described at one, in ascending order of resolution, one below
/// the other; they share the descriptors. Scales without a feature make no octave. Throws
/// std::runtime_error where descriptors differ in length.
FeatureSet stack_octaves(const std::vector<std::shared_ptr<const FeatureSet>>& features,
                         const std::vector<Scale>& scales);

}  // namespace posevote::descriptors

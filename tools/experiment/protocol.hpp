// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace posevote {

/// How a data set is judged, and what the paper and others reached on the real one.
struct Protocol {
  std::string name;
  std::string rule;        ///< of evaluate
  std::size_t quick_step;  ///< --quick takes every so manieth image
  const char* paper;       ///< "": there is no real one
};

/// `name` is that of an experiment on images.
const Protocol& find_protocol(const std::string& name);

}  // namespace posevote

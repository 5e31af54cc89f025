// SPDX-License-Identifier: BSD-3-Clause
// The objects of a run: those it looked for, found or not, those it could not use, and others that
// its results or the truth name.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nodes/data/cloud.hpp"
#include "tools/manifest/manifest.hpp"

namespace posevote::page {

class ModelList {
 public:
  ModelList(const std::vector<SoughtModel>& sought, const std::vector<LeftOutModel>& left_out);

  /// By obj_id, or by name where that is 0; a new one is added.
  int number_of(int obj_id, const std::string& name);
  /// Of a name, or an obj_id written out. Throws std::invalid_argument that lists the names.
  int obj_id_of(const std::string& name_or_id) const;

  /// Packs the surfaces, of at most `faces` each: one element a model. `id`: unique on the page.
  std::string show(const std::map<int, Mesh>& surfaces, std::size_t faces, const std::string& id);
  nlohmann::ordered_json to_json() const { return models_; }

 private:
  nlohmann::ordered_json models_ = nlohmann::ordered_json::array();
};

/// An element that holds packed bytes.
std::string blob(const std::string& id, const std::string& bytes);

}  // namespace posevote::page

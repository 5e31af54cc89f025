// SPDX-License-Identifier: BSD-3-Clause
// Data sets as they are published. A layout is a reader, a reader is a file: read_bop.cpp,
// read_sixd.cpp, read_uwa.cpp. `run --dataset` and `evaluate` see a set through the same reader.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "nodes/data/files.hpp"
#include "tools/evaluate/ground_truth.hpp"

namespace posevote {

struct DatasetReader {
  const char* layout;
  const char* expected;  ///< the files that make the layout
  bool (*recognises)(const std::filesystem::path& dataset, const std::string& split);
  std::vector<SceneFile> (*scenes)(const std::filesystem::path& dataset, const std::string& split);
  std::vector<std::filesystem::path> (*models)(const std::filesystem::path& dataset);
  /// Poses and images; objects without their points, which read_ground_truth adds.
  GroundTruth (*truth)(const std::filesystem::path& dataset, const std::string& split);
};

extern const DatasetReader kBopReader, kSixdReader, kUwaReader;

/// The reader of a folder's layout. Throws std::runtime_error where no layout fits.
const DatasetReader& find_reader(const std::filesystem::path& dataset, const std::string& split);

/// What the readers share.
namespace dataset {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what);
/// The number that a name of digits says, or -1.
int number_of(const std::string& digits);
/// entry[name], which must be a whole number of at least `least`. Throws std::invalid_argument.
int whole(const nlohmann::json& entry, const std::string& name, int least = 0);
nlohmann::json read_json(const std::filesystem::path& file);
/// The entries of a folder, sorted by path; none where there is no such folder.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);
/// obj_id of each model file, as `run` gives them. Throws std::runtime_error.
std::map<int, std::filesystem::path> number_models(const std::vector<std::filesystem::path>& files);
/// An object that is known by its points alone.
void measure_object(TrueObject& object);

}  // namespace dataset
}  // namespace posevote

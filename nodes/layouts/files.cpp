// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/files.hpp"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <utility>

#include "graph/schema.hpp"

namespace posevote::layouts {

namespace fs = std::filesystem;

void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

int number_of(const std::string& digits) {
  if (digits.empty() ||
      !std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; }))
    return -1;
  const std::size_t first = digits.find_first_not_of('0');
  return first == std::string::npos ? 0
                                    : graph::Scalar<int>::parse(digits.substr(first)).value_or(-1);
}

nlohmann::json read_json(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) fail(file, "cannot be read: no such file?");
  nlohmann::json root = nlohmann::json::parse(stream, nullptr, false);
  if (!root.is_object()) fail(file, "is no JSON object");
  return root;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> paths;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  return paths;
}

std::map<int, fs::path> number_models(std::vector<fs::path> files) {
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return std::pair(a.stem().string(), a.string()) < std::pair(b.stem().string(), b.string());
  });
  std::map<int, fs::path> models;
  int order = 0;
  for (const fs::path& file : files) {
    ++order;
    const std::string stem = file.stem().string();
    const int named = stem.starts_with("obj_") ? number_of(stem.substr(4)) : -1;
    const auto [first, is_new] = models.emplace(named >= 0 ? named : order, file);
    if (!is_new)
      fail(file,
           "has obj_id " + std::to_string(first->first) + ", as has " + first->second.string());
  }
  return models;
}

int whole(const nlohmann::json& entry, const std::string& name, int least) {
  const nlohmann::json& value = entry.at(name);
  if (!value.is_number_integer() || value.get<std::int64_t>() < least ||
      value.get<std::int64_t>() > std::numeric_limits<int>::max())
    throw std::invalid_argument(name + " is " + value.dump() + ", expected a whole number from " +
                                std::to_string(least) + " up");
  return value.get<int>();
}

std::vector<double> numbers(const nlohmann::json& list, std::size_t count,
                            const std::string& name) {
  auto values = list.get<std::vector<double>>();
  if (values.size() != count)
    throw std::invalid_argument(name + " has " + std::to_string(values.size()) +
                                " numbers, expected " + std::to_string(count));
  return values;
}

Eigen::Vector3d metres(const nlohmann::json& list, const std::string& name) {
  const std::vector<double> v = numbers(list, 3, name);
  return Eigen::Vector3d(v[0], v[1], v[2]) * kMetresPerUnit;
}

}  // namespace posevote::layouts

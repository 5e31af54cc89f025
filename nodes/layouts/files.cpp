// SPDX-License-Identifier: BSD-3-Clause
#include "nodes/layouts/files.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

#include "graph/schema.hpp"
#include "nodes/formats/json_text.hpp"

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
  nlohmann::json root = formats::read_json<nlohmann::json>(file);
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

namespace {

/// Numbers of one width, so that they compare by value.
std::string padded(const std::string& text) {
  constexpr std::size_t kWidth = 20;
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
    if (end == at) {
      out += text[at++];
      continue;
    }
    const std::size_t first = std::min(text.find_first_not_of('0', at), end);
    out.append(kWidth - std::min(kWidth, end - first), '0').append(text, first, end - first);
    at = end;
  }
  return out;
}

}  // namespace

bool in_natural_order(const std::string& a, const std::string& b) {
  return std::pair(padded(a), a) < std::pair(padded(b), b);
}

std::map<int, fs::path> number_models(std::vector<fs::path> files) {
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    const std::string left = a.stem().string(), right = b.stem().string();
    return left == right ? in_natural_order(a.string(), b.string()) : in_natural_order(left, right);
  });
  files.erase(std::unique(files.begin(), files.end()), files.end());
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
    throw std::invalid_argument(name + " is " + formats::shown(value) +
                                ", expected a whole number from " + std::to_string(least) + " up");
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

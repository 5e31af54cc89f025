// SPDX-License-Identifier: BSD-3-Clause
// SIXD Challenge 2017, the forerunner of BOP: models/obj_NN.ply, models/models_info.yml,
// SPLIT/NN/{depth/NNNN.png, info.yml, gt.yml}. It knows neither symmetries nor visible fractions.
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include "graph/schema.hpp"
#include "nodes/layouts/image_folders.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kDeepest = 8;  // gt.yml: image, instance, field, number

json to_json(const YAML::Node& node, int depth) {
  if (depth > kDeepest) throw std::runtime_error("is nested too deeply");
  if (node.IsMap()) {
    json map = json::object();
    for (const auto& item : node)
      if (!map.emplace(item.first.Scalar(), to_json(item.second, depth + 1)).second)
        throw std::runtime_error("gives " + item.first.Scalar() + " twice");
    return map;
  }
  if (node.IsSequence()) {
    json list = json::array();
    for (const YAML::Node& item : node) list.push_back(to_json(item, depth + 1));
    return list;
  }
  if (!node.IsScalar()) return {};
  if (const auto whole = graph::Scalar<int>::parse(node.Scalar())) return *whole;
  if (const auto real = graph::Scalar<double>::parse(node.Scalar())) return *real;
  return node.Scalar();
}

json read_yaml(const fs::path& file) {
  if (!fs::is_regular_file(file)) fail(file, "cannot be read: no such file?");
  try {
    json root = to_json(YAML::LoadFile(file.string()), 0);
    if (!root.is_object()) fail(file, "is no YAML map");
    return root;
  } catch (const YAML::Exception& error) {
    const bool is_deep = dynamic_cast<const YAML::DeepRecursion*>(&error) != nullptr;
    fail(file, is_deep ? "is nested too deep" : error.what());  // its own text is "bad file"
  } catch (const std::runtime_error& error) {
    fail(file, error.what());
  }
}

constexpr ImageFolders kNames{"gt.yml", "info.yml", nullptr, "models_info.yml", read_yaml};

const auto registered = register_layout(
    layout_of(kNames, "SIXD 2017", "models/models_info.yml, SPLIT/NN/{depth, info.yml, gt.yml}"));

const auto scene = register_recording(scene_of(kNames, "SIXD 2017 scene"));

}  // namespace
}  // namespace posevote::layouts

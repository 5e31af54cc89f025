// SPDX-License-Identifier: BSD-3-Clause
#include "tools/manifest/manifest.hpp"

#include <stdexcept>

#include "graph/write_file.hpp"
#include "nodes/formats/json_text.hpp"
#include "nodes/formats/results_json.hpp"
#include "nodes/library/content_hash.hpp"

namespace posevote {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kFile = "run.json";
constexpr const char* kSum = "checksum";

Json to_json(const SoughtModel& model) {
  return {
      {"obj_id", model.obj_id}, {"model", model.name}, {"file", model.file}, {"hash", model.hash}};
}

SoughtModel to_model(const Json& json) {
  return {json.at("obj_id").get<int>(), json.at("model").get<std::string>(),
          json.at("file").get<std::string>(), json.at("hash").get<std::string>()};
}

Json to_json(const SceneEntry& scan) {
  return {{"frame", scan.number},
          {"name", scan.name},
          {"file", scan.file.path.string()},
          {"scene_id", scan.file.scene_id},
          {"im_id", scan.file.im_id},
          {"camera", formats::camera_json(scan.file.camera)},
          {"color", scan.file.color.string()}};
}

SceneEntry to_scan(const Json& json) {
  SceneFile file{json.at("file").get<std::string>(), json.at("scene_id").get<int>(),
                 json.at("im_id").get<int>(), formats::camera_of(json.at("camera"))};
  file.color = json.value("color", "");  // which older runs did not keep
  return {json.at("frame").get<std::size_t>(), json.at("name").get<std::string>(), file};
}

Json to_json(const RunStart& start) {
  return {{"command", start.command},  {"folder", start.folder}, {"host", start.host},
          {"process", start.process},  {"time", start.time},     {"shard", start.shard},
          {"answered", start.answered}};
}

RunStart to_start(const Json& json) {
  return {json.at("command").get<std::vector<std::string>>(),
          json.at("folder").get<std::string>(),
          json.at("host").get<std::string>(),
          json.at("process").get<int>(),
          json.at("time").get<double>(),
          json.at("shard").get<std::string>(),
          json.at("answered").get<std::size_t>()};
}

template <class T>
Json list_of(const std::vector<T>& items) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(to_json(item));
  return list;
}

template <class T>
std::vector<T> read_list(const Json& list, T (*read)(const Json&)) {
  std::vector<T> items;
  for (const Json& item : list) items.push_back(read(item));
  return items;
}

Json to_json(const Manifest& run) {
  return {{"version", run.version},
          {"code", run.code},
          {"seed", run.seed},
          {"dataset", run.dataset},
          {"split", run.split},
          {"library", run.library},
          {"cache", run.cache},
          {"library_hash", run.library_hash},
          {"models", list_of(run.models)},
          {"wiring", run.wiring},
          {"parameters", run.parameters},
          {"starts", list_of(run.starts)},
          {"scans", list_of(run.scans)}};
}

Manifest to_manifest(const Json& json) {
  using Texts = std::map<std::string, std::string>;
  const auto text = [&json](const char* key) { return json.at(key).get<std::string>(); };
  Manifest run;
  run.version = text("version");
  run.code = text("code");
  run.seed = json.at("seed").get<std::uint64_t>();
  run.dataset = text("dataset");
  run.split = text("split");
  run.library = text("library");
  run.cache = text("cache");
  run.library_hash = text("library_hash");
  run.models = read_list(json.at("models"), to_model);
  run.wiring = json.at("wiring").get<Texts>();
  run.parameters = json.at("parameters").get<Texts>();
  run.starts = read_list(json.at("starts"), to_start);
  run.scans = read_list(json.at("scans"), to_scan);
  return run;
}

std::string checksum_of(const Json& json) { return library::checksum(formats::line(json)); }

}  // namespace

void write_manifest(const fs::path& out, const Manifest& manifest) {
  // As it will be read: bytes that are no UTF-8 are mended on the way.
  auto json = Json::parse(formats::line(to_json(manifest)));
  json[kSum] = checksum_of(json);
  graph::write_durably(out / kFile, json.dump(1) + "\n");
}

std::optional<Manifest> read_manifest(const fs::path& out) {
  const fs::path file = out / kFile;
  std::error_code none;
  if (!fs::exists(file, none)) return std::nullopt;
  auto json = formats::read_json<Json>(file);
  try {
    const auto sum = json.at(kSum).get<std::string>();
    json.erase(kSum);
    if (sum != checksum_of(json)) throw std::runtime_error("its checksum is wrong");
    return to_manifest(json);
  } catch (const Json::exception& error) {
    throw std::runtime_error(file.string() +
                             ": is not what a run wrote: " + formats::reason_of(error));
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(file.string() + ": is damaged: " + error.what());
  }
}

}  // namespace posevote

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/model_list.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <stdexcept>

#include "nodes/geometry/extent.hpp"
#include "tools/report/html.hpp"
#include "tools/report/pack.hpp"
#include "tools/report/shown_scan.hpp"

namespace posevote::page {

using Json = nlohmann::ordered_json;

ModelList::ModelList(const std::vector<SoughtModel>& sought,
                     const std::vector<LeftOutModel>& left_out) {
  for (const SoughtModel& model : sought) number_of(model.obj_id, model.name);
  for (const LeftOutModel& model : left_out)
    models_[std::size_t(number_of(model.obj_id, model.name))]["left_out"] = model.why;
}

int ModelList::number_of(int obj_id, const std::string& name) {
  for (std::size_t i = 0; i < models_.size(); ++i)
    if (obj_id != 0 ? models_[i]["obj_id"].get<int>() == obj_id
                    : models_[i]["name"].get<std::string>() == name)
      return static_cast<int>(i);
  models_.push_back(
      {{"obj_id", obj_id}, {"name", name.empty() ? fmt::format("object {}", obj_id) : name}});
  return static_cast<int>(models_.size()) - 1;
}

int ModelList::obj_id_of(const std::string& name_or_id) const {
  std::string known;
  for (const Json& model : models_) {
    const int obj_id = model["obj_id"].get<int>();
    const auto name = model["name"].get<std::string>();
    if (name == name_or_id || std::to_string(obj_id) == name_or_id) return obj_id;
    known += (known.empty() ? "" : ", ") + name;
  }
  throw std::invalid_argument("--votes " + name_or_id + ": the run has no such object, expected " +
                              (known.empty() ? "one of a run that knows its models" : known));
}

std::string ModelList::show(const std::map<int, Mesh>& surfaces, std::size_t faces,
                            const std::string& id) {
  constexpr std::size_t kMostFaces = 100'000;  // of all
  const std::size_t most = std::min(faces, kMostFaces / std::max<std::size_t>(1, models_.size()));
  std::string blobs;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    const auto found = surfaces.find(models_[i]["obj_id"].get<int>());
    if (found == surfaces.end() || found->second.points.rows() == 0) continue;
    const Mesh simple = simplify(found->second, most);
    const std::string element = fmt::format("{}-model{}", id, i);
    const Packed packed = pack_mesh(simple.points, simple.faces);
    models_[i]["surface"] = page::to_json(packed, element);
    models_[i]["surface"]["true_points"] = found->second.points.rows();
    models_[i]["surface"]["true_faces"] = found->second.faces.rows();
    models_[i]["diagonal"] = geometry::model_diagonal(found->second.points);
    blobs += blob(element, packed.bytes);
  }
  return blobs;
}

std::string blob(const std::string& id, const std::string& bytes) {
  return fmt::format("<script type=\"text/plain\" id=\"{}\">{}</script>\n", id,
                     html::base64(bytes));
}

}  // namespace posevote::page

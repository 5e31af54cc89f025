// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/shown_scan.hpp"

#include <algorithm>
#include <stdexcept>

#include "nodes/color/srgb.hpp"
#include "nodes/pictures/painter.hpp"
#include "tools/report/model_list.hpp"
#include "tools/report/votes.hpp"

namespace posevote::page {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::Vector3f& vector) { return {vector.x(), vector.y(), vector.z()}; }

/// The box that holds all but a fiftieth of the points at either end of each axis.
Eigen::AlignedBox3f usual_box(const PointMatrix& points) {
  Eigen::Vector3f low, high;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    std::vector<float> values(points.col(axis).begin(), points.col(axis).end());
    std::sort(values.begin(), values.end());
    const std::size_t out = values.size() / 50;
    low(axis) = values[out];
    high(axis) = values[values.size() - 1 - out];
  }
  return {low, high};
}

/// From where to look: the sensor's side, upright as in the pictures.
Json view_of(const PointMatrix& points, const Eigen::Vector3f& eye, const Eigen::Matrix3f& axes) {
  const Eigen::AlignedBox3f box = usual_box(points);
  return {{"eye", to_json(eye)},
          {"forward", to_json(Eigen::Vector3f(axes.row(2)))},
          {"up", to_json(Eigen::Vector3f(-axes.row(1)))},
          {"center", to_json(box.center())},
          {"size", to_json(box.sizes())}};
}

/// A byte for each of the points' own colours: three bits of red, three of green, two of blue.
std::vector<std::uint8_t> color_bytes(const Scan& scan, const Thinned& thinned) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint32_t row : thinned.rows) {
    const auto share = [&](Eigen::Index k) { return color::byte_of(scan.colors(row, k)); };
    bytes.push_back(
        static_cast<std::uint8_t>((share(0) & 0xE0) | (share(1) & 0xE0) >> 3 | share(2) >> 6));
  }
  return bytes;
}

std::string show_points(const Scan& scan, std::size_t most, const std::string& id, Json& json) {
  const Thinned thinned = thin(scan.points, most);
  if (thinned.rows.empty()) throw std::runtime_error("the scan holds no point");
  PointMatrix points(std::ssize(thinned.rows), 3);
  for (std::size_t i = 0; i < thinned.rows.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = scan.points.row(thinned.rows[i]);
  const Eigen::Matrix3f axes =
      pictures::perspective_of({points, PointMatrix(0, 3), scan.view}, PointMatrix(0, 3), 100).axes;
  const Eigen::Vector3f light =
      axes.transpose() * Eigen::Vector3f(-0.4F, -0.6F, -1.0F).normalized();
  const bool in_colors = scan.colors.rows() > 0;
  const Packed packed =
      pack_points(points, in_colors ? color_bytes(scan, thinned) : shade(scan, thinned, light));
  json["scan"] = to_json(packed, id);
  if (in_colors) json["scan"]["in_colors"] = true;
  json["scan"]["true_points"] = scan.points.rows();
  json["scan"]["spacing"] = thinned.spacing;
  json["view"] = view_of(points, scan.view.origin, axes);
  return blob(id, packed.bytes);
}

std::string show_votes(const SceneFile& scene, const ShownRun& inputs, const VotesWanted& votes,
                       std::size_t most, const std::string& id, Json& json) {
  const pictures::DenseVotes shown =
      votes_of(inputs.configuration(), votes.constants, scene, votes.obj_id, most);
  const Packed packed = pack_points(shown.centers, shown.heat);
  json["votes"] = to_json(packed, id);
  json["votes"]["true_points"] = shown.count;
  json["votes"]["largest"] = shown.largest;
  json["votes"]["obj_id"] = votes.obj_id;
  return blob(id, packed.bytes);
}

}  // namespace

Json to_json(const Packed& packed, const std::string& element) {
  return {{"element", element},
          {"points", packed.points},
          {"faces", packed.faces},
          {"corner", to_json(packed.corner)},
          {"step", packed.step}};
}

std::string show_scan(const ScanName& scan, const ShownRun& inputs, const VotesWanted* votes,
                      std::size_t points, const std::string& id, Json& json) {
  if (points == 0) {
    json["note"] = "The page has no room for this scan; --size takes more.";
    return "";
  }
  std::string blobs;
  try {
    blobs = show_points(inputs.load(scan), votes ? points / 2 : points, id, json);
  } catch (const std::exception& error) {
    json["note"] = std::string("Not shown: ") + error.what();
    return "";
  }
  if (votes) try {
      blobs += show_votes(inputs.locate(scan), inputs, *votes, points / 2, id + "-votes", json);
    } catch (const std::exception& error) {
      json["note"] = std::string("No votes: ") + error.what();
    }
  return blobs;
}

}  // namespace posevote::page

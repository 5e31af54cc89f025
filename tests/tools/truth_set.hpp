// SPDX-License-Identifier: BSD-3-Clause
// A small data set with true poses, and results that are held against it.
#pragma once

#include <catch2/catch.hpp>

#include "nodes/formats/write_ply.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tools/evaluate/evaluate.hpp"

namespace posevote::test {

inline constexpr const char* kHeader = "scene_id,im_id,obj_id,score,R,t,time\n";
inline const std::string kIdentity = "1 0 0 0 1 0 0 0 1";
inline const std::string kFlip = "-1 0 0 0 -1 0 0 0 1";  // 180 deg about z

/// Two objects of one shape, a bar of 200 x 40 x 20 mm with its centre at (10, 0, 0); object 2 is
/// declared symmetric by 180 deg about the z axis through its centre. Image 3 of scene 1 holds two
/// instances of object 1 at (0, 0, 1000) and (300, 0, 1000) mm and one of object 2 at (0, 200,
/// 1000).
class TruthSet : public TemporaryFolder {
 public:
  TruthSet() {
    Mesh bar;
    bar.points.resize(8, 3);
    for (int i = 0; i < 8; ++i)
      bar.points.row(i) << (i & 1 ? 110.F : -90.F), (i & 2 ? 20.F : -20.F), (i & 4 ? 10.F : -10.F);
    std::filesystem::create_directories(*this / "models");
    formats::write_ply(*this / "models/obj_000001.ply", bar);
    formats::write_ply(*this / "models/obj_000002.ply", bar);
    const std::string box =
        R"("diameter": 205, "min_x": -90, "min_y": -20, "min_z": -10, "size_x": 200, "size_y": 40, "size_z": 20)";
    write("models/models_info.json",
          "{\"1\": {" + box + "}, \"2\": {" + box +
              R"(, "symmetries_discrete": [[-1,0,0,20, 0,-1,0,0, 0,0,1,0, 0,0,0,1]]}})");
    write("test/000001/scene_gt.json", R"({"3": [)" + entry(1, "0, 0, 1000") + "," +
                                           entry(1, "300, 0, 1000") + "," +
                                           entry(2, "0, 200, 1000") + "]}");
  }
  static std::string entry(int obj_id, const std::string& t) {
    return R"({"cam_R_m2c": [1,0,0,0,1,0,0,0,1], "cam_t_m2c": [)" + t + R"(], "obj_id": )" +
           std::to_string(obj_id) + "}";
  }
  Evaluation evaluate(const std::string& rows) const {
    EvaluateOptions options;
    options.rules = "pose,add";
    return evaluate(rows, options);
  }
  Evaluation evaluate(const std::string& rows, EvaluateOptions options) const {
    options.results = write("results.csv", kHeader + rows);
    return posevote::evaluate(layouts::read_ground_truth(path(), "test"),
                              read_results_csv(options.results), options);
  }
};

inline std::string row(int obj_id, double score, const std::string& r, const std::string& t) {
  return "1,3," + std::to_string(obj_id) + "," + std::to_string(score) + "," + r + "," + t +
         ",0.5\n";
}

inline void check(const RuleResult& result, int instances, int detections, int correct) {
  const Counts& counts = result.counts;
  CHECK(counts.instances == instances);
  CHECK(counts.detections == detections);
  CHECK(counts.correct == correct);
}

}  // namespace posevote::test

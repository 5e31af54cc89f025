// SPDX-License-Identifier: BSD-3-Clause
// `posevote run --resume`: whatever differs from the run that is there is refused by name; what it
// has answered stays.
#include <functional>

#include "tests/pipelines/run_world.hpp"
#include "tools/manifest/manifest.hpp"

namespace posevote::resume_test {

using namespace posevote::test;
using Catch::Contains;

namespace {

/// Options of every run here: quick, and with models that are prepared once.
std::string options_of_all() {
  return " --quiet --set write_picture.every=0 --set write_overlay.every=0 --cache " +
         (world().folder / "cache/posevote").string();
}

/// A data set with a run on its first of three images.
struct BegunRun {
  TemporaryFolder folder;
  fs::path set = folder / "set", out = folder / "out", images = set / "test/000001";
  std::string config = "demo", options;

  /// A copy of one that was run once for all.
  BegunRun() {
    static const TemporaryFolder begun;
    if (!fs::exists(begun / "out")) {
      fs::copy(world().folder / "data", begun / "set", fs::copy_options::recursive);
      fs::remove_all(begun / "set/scans");
      name_an_image(begun);
      const CommandResult first = run_in(begun, "--shard 1/3");
      INFO(first.output);
      REQUIRE(first.status == 0);
    }
    fs::copy(begun.path(), folder.path(), fs::copy_options::recursive);
  }

  /// That the model's colours are in; it is not there.
  static void name_an_image(const TemporaryFolder& place) {
    const std::string model = "set/models/obj_000001.ply";
    std::string ply = read_text(place / model);
    place.write(model, ply.insert(ply.find("element"), "comment TextureFile paint.png\n"));
  }

  CommandResult run_in(const TemporaryFolder& place, const std::string& more) const {
    const fs::path data = place.path() == folder.path() ? set : place / "set";
    return run_posevote(place, "run " + config + " --dataset " + data.string() + " --out " +
                                   (place / "out").string() + options_of_all() + " " + options +
                                   " " + more);
  }
  CommandResult run(const std::string& more) const { return run_in(folder, more); }

  std::string text(const std::string& file) const { return read_text(folder / file); }
  void replace(const std::string& file, const std::string& from, const std::string& to) const {
    std::string all = text(file);
    REQUIRE(all.find(from) != std::string::npos);
    folder.write(file, all.replace(all.find(from), from.size(), to));
  }
  void change_manifest(const std::function<void(Manifest&)>& change) const {
    Manifest manifest = read_manifest(out).value();
    change(manifest);
    write_manifest(out, manifest);
  }
  void use_pipeline(const std::string& from, const std::string& to) {
    std::string wiring = read_text(fs::path(POSEVOTE_SOURCE_DIR) / "pipelines/recognize.yaml");
    REQUIRE(wiring.find(from) != std::string::npos);
    folder.write("mine.yaml", wiring.replace(wiring.find(from), from.size(), to));
    std::string demo = read_text(fs::path(POSEVOTE_SOURCE_DIR) / "configs/demo.yaml");
    demo.replace(demo.find("pipeline: recognize"), 19, "pipeline: mine");
    config = folder.write("config.yaml", demo);
  }
};

struct Change {
  const char* what;
  std::function<void(BegunRun&)> make;
  const char* named;
};

const std::vector<Change>& changes() {
  static const std::vector<Change> all{
      {"a scan's content",
       [](BegunRun& run) {
         run.folder.write("set/test/000001/depth/000000.png",
                          run.text("set/test/000001/depth/000001.png"));
       },
       "000000.png holds something else now"},
      {"a scan's colours",
       [](BegunRun& run) { run.folder.write("set/test/000001/rgb/000000.png", "colours"); },
       "000000.png holds something else now"},
      {"a scan's camera",
       [](BegunRun& run) {
         run.replace("set/test/000001/scene_camera.json", "\"cam_K\":[", "\"cam_K\":[1");
       },
       "the camera of "},
      {"a scene in front of the others",
       [](BegunRun& run) {
         fs::copy(run.images, run.set / "test/000000", fs::copy_options::recursive);
       },
       "scene_id 1, im_id 0, now it is scene_id 0, im_id 0"},
      {"a scan that is gone", [](BegunRun& run) { fs::remove(run.images / "depth/000000.png"); },
       "was \"000000.png\", now it is \"000001.png\""},
      {"a model's content",
       [](BegunRun& run) {
         run.folder.write("set/models/obj_000001.ply", run.text("set/models/obj_000002.ply"));
       },
       "the model 1 (obj_000001) was content "},
      {"a model's colours",
       [](BegunRun& run) { run.folder.write("set/models/paint.png", "colours"); },
       "the model 1 (obj_000001) was content "},
      {"a model more",
       [](BegunRun& run) {
         fs::copy(run.set / "models/obj_000001.ply", run.set / "models/obj_000009.ply");
       },
       "the model 9 (obj_000009) was not there"},
      {"a model less", [](BegunRun& run) { fs::remove(run.set / "models/obj_000002.ply"); },
       "the model 2 (obj_000002) is not there any more"},
      {"a model's symmetries",
       [](BegunRun& run) {
         run.replace("set/models/models_info.json", "\"diameter\"",
                     "\"symmetries_continuous\": [{\"axis\": [0, 0, 1], \"offset\": [0, 0, 0]}], "
                     "\"diameter\"");
       },
       "the model 1 (obj_000001) was content "},
      {"a parameter of scans",
       [](BegunRun& run) { run.options = "--set segment_objects.nms=0.31"; },
       "the parameter segment_objects.nms was "},
      {"a parameter of models", [](BegunRun& run) { run.options = "--set load_models.unit=cm"; },
       "the parameter load_models.unit was mm, now cm"},
      {"the scans' unit", [](BegunRun& run) { run.options = "--scene-unit m"; },
       "the parameter load_scene.unit was mm, now m"},
      {"a node of another type",
       [](BegunRun& run) { run.options = "--set describe_models.node=describe_fpfh"; },
       "the wiring of the node describe_models was "},
      {"the wiring, with the same parameters",
       [](BegunRun& run) {
         run.use_pipeline("estimate_normals:    {in: [scan,",
                          "estimate_normals:    {in: [raw_scan,");
       },
       "the wiring of the node estimate_normals was estimate_normals(scan, scale) -> "
       "oriented_scan, "
       "now estimate_normals(raw_scan, scale)"},
      {"a node less",
       [](BegunRun& run) {
         run.use_pipeline("  write_correspondences: {in: [correspondences, scene_features]}\n", "");
       },
       "the wiring of the node write_correspondences is not there any more"},
      {"the seed", [](BegunRun& run) { run.options = "--seed 9"; }, "--seed was 0, now 9"},
      {"the split",
       [](BegunRun& run) {
         fs::copy(run.set / "test", run.set / "val", fs::copy_options::recursive);
         run.options = "--split val";
       },
       "--split was test, now val"},
      {"another data set",
       [](BegunRun& run) {
         fs::copy(run.set, run.folder / "other", fs::copy_options::recursive);
         run.folder.write("other/test/000001/depth/000000.png",
                          run.text("set/test/000001/depth/000002.png"));
         run.set = run.folder / "other";
       },
       "other/test/000001/depth/000000.png holds something else now"},
      {"the program",
       [](BegunRun& run) {
         run.change_manifest([](Manifest& old) { old.code = "0123456789abcdef"; });
       },
       "the program was "},
      {"the program's version",
       [](BegunRun& run) { run.change_manifest([](Manifest& old) { old.version = "0.0.1"; }); },
       "the program was 0.0.1 ("},
      {"what models are made to",
       [](BegunRun& run) { run.change_manifest([](Manifest& old) { old.library_hash = "0"; }); },
       "what the models were made to was 0, now "},
      {"a manifest that is gone", [](BegunRun& run) { fs::remove(run.out / "run.json"); },
       "run.json: is not there"},
      {"a manifest that is torn", [](BegunRun& run) { fs::resize_file(run.out / "run.json", 700); },
       "run.json: is no JSON"},
      {"a manifest with a flipped bit",
       [](BegunRun& run) { run.replace("out/run.json", "\"seed\": 0", "\"seed\": 1"); },
       "run.json: is damaged: its checksum is wrong"}};
  return all;
}

/// results.csv without its times.
std::string rows_of(const fs::path& out) {
  return std::regex_replace(read_text(out / "results.csv"), std::regex(",[^,\n]*\n"), "\n");
}

const std::string& whole_rows() {
  static const std::string rows = [] {
    const BegunRun whole;
    REQUIRE(whole.run("--overwrite").status == 0);
    return rows_of(whole.out);
  }();
  return rows;
}

}  // namespace

TEST_CASE("whatever has changed since is refused by name, and nothing is touched", "[resume]") {
  CHECK(changes().size() >= 20);
  for (const Change& change : changes()) {
    BegunRun run;
    change.make(run);
    const std::string before = read_text(run.out / "results.json");
    const CommandResult resumed = run.run("--resume");
    INFO(change.what << "\n" << resumed.output);
    CHECK(resumed.status == 2);
    CHECK_THAT(resumed.output, Contains(change.named) && Contains("choose another --out"));
    CHECK(read_text(run.out / "results.json") == before);
  }
}

TEST_CASE("effective.yaml may be lost or torn; new scans may come behind the others", "[resume]") {
  const std::string whole = [] {
    BegunRun run;
    return read_text(run.out / "effective.yaml");
  }();
  const auto resume = [&](const std::function<void(const BegunRun&)>& change) {
    const BegunRun run;
    change(run);
    const CommandResult resumed = run.run("--resume");
    INFO(resumed.output);
    CHECK(resumed.status == 0);
    CHECK(read_text(run.out / "effective.yaml") == whole);
    return rows_of(run.out);
  };
  CHECK(resume([](const BegunRun& run) { fs::remove(run.out / "effective.yaml"); }) ==
        whole_rows());
  CHECK(resume([](const BegunRun& run) { fs::resize_file(run.out / "effective.yaml", 20); }) ==
        whole_rows());
  const std::string more = resume([](const BegunRun& run) {
    fs::copy(run.images, run.set / "test/000002", fs::copy_options::recursive);
  });
  CHECK(more.starts_with(whole_rows()));
  CHECK(more.size() > whole_rows().size() + 100);
}

TEST_CASE("a retried frame's rows stand where its scan stands", "[resume]") {
  const BegunRun run;
  const std::string image = run.text("set/test/000001/depth/000001.png");
  run.folder.write("set/test/000001/depth/000001.png", "broken");
  CHECK(run.run("--resume").status == 1);
  CHECK(read_json(run.out / "failures.json").size() == 1);
  run.folder.write("set/test/000001/depth/000001.png", image);
  const CommandResult retried = run.run("--resume");
  INFO(retried.output);
  CHECK(retried.status == 0);
  CHECK(rows_of(run.out) == whole_rows());
  CHECK(read_json(run.out / "failures.json").empty());
}

TEST_CASE("a damaged record is done again, and said", "[resume]") {
  const BegunRun run;
  REQUIRE(run.run("--resume").status == 0);
  run.replace("out/results.json", "{\"frame\":1,\"name\":\"000001_000001\"",
              "{\"frame\":1,\"name\":\"000001_000003\"");
  const CommandResult resumed = run.run("--resume");
  INFO(resumed.output);
  CHECK(resumed.status == 0);
  CHECK_THAT(resumed.output, Contains("1 damaged records") && Contains("1 frames answered"));
  CHECK(rows_of(run.out) == whole_rows());
}

}  // namespace posevote::resume_test

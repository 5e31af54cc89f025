// SPDX-License-Identifier: BSD-3-Clause
// One bad model among good ones: named, left out, and on demand the end of it.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "tests/support/command.hpp"
#include "tests/support/shapes.hpp"

namespace posevote::bad_models_test {

using namespace posevote::test;
using Catch::Matchers::Contains;

namespace {

void write_obj(const std::filesystem::path& file, const Mesh& mesh) {
  std::ofstream out(file);
  for (Eigen::Index i = 0; i < mesh.points.rows(); ++i) out << "v " << mesh.points.row(i) << "\n";
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    out << "f " << mesh.faces.row(f).array() + 1 << "\n";
}

/// Two boxes, one on the other, in mm, as CAD has them; a scan of three of its sides; and models
/// that nobody can use.
struct World {
  TemporaryFolder folder;
  std::string good, bad;

  World() {
    const Mesh body = joined(box({0, 0, 0}, 100), box({30, 0, 75}, 50));
    write_obj(folder / "good.obj", body);
    good = (folder / "good.obj").string();
    bad = " " + folder.write("text.ply", "Dear sir or madam\n");
    bad += " " + folder.write("empty.stl", "solid nothing\nendsolid nothing\n");
    bad += " " + folder.write("line.obj", "v 0 0 0\nv 90 0 0\nv 40 0 0\nf 1 2 3\n");
    write_obj(folder / "crumb.obj", box({0, 0, 0}, 0.2F));
    bad += " " + (folder / "crumb.obj").string();
    std::ofstream scan(folder / "scan.obj");
    for (int i = 0; i < 100; ++i)
      for (int j = 0; j < 100; ++j)
        scan << "v " << i - 50 << " " << j - 50 << " 550\nv " << -50 << " " << j - 50 << " "
             << 550 + i << "\nv " << j - 50 << " 50 " << 550 + i << "\n";
  }
  std::string scans() const { return " --scenes " + (folder / "scan.obj").string(); }
};

}  // namespace

TEST_CASE("a bad model is named and left out", "[run]") {
  const World w;
  const std::string library = (w.folder / "some.library").string();
  const std::string models = " --models " + w.good + w.bad;
  const CommandResult trained = run_posevote(w.folder, "train uwa --out " + library + models);
  INFO(trained.output);
  CHECK(trained.status == 1);
  CHECK_THAT(trained.output, Contains("good: obj_id") && Contains("text.ply: load_models: ") &&
                                 Contains("empty.stl: load_models: ") &&
                                 Contains("line.obj: sample_surface: its 1 faces have no area") &&
                                 Contains("crumb.obj: assemble_library: none of"));
  for (const std::string& from : {models, models, " --library " + library}) {
    const std::filesystem::path out = w.folder / "out";
    std::filesystem::remove_all(out);
    const CommandResult run =
        run_posevote(w.folder, "run uwa --out " + out.string() + from + w.scans());
    INFO(run.output);
    CHECK(run.status == 1);
    CHECK_THAT(run.output, Contains("1 frames answered, 0 failed") && Contains("crumb") &&
                               Contains("text.ply"));
    const nlohmann::json results = read_json(out / "results.json");
    REQUIRE(results["models_left_out"].size() == 4);
    CHECK_THAT(results["models_left_out"][0]["why"].get<std::string>(), Contains("load_models"));
    CHECK(results["frames"].size() == 1);
    CHECK(run_posevote(w.folder, "report " + out.string()).status == 0);
    CHECK_THAT(read_text(out / "report.html"), Contains("Models left out") && Contains("crumb"));
  }
}

TEST_CASE("a bad model stops a run that is to stop, and so do bad models alone", "[run]") {
  const World w;
  const std::string library = (w.folder / "some.library").string();
  const std::string out = " --out " + (w.folder / "out").string();
  const std::string models = " --models " + w.good + w.bad;
  // The cache knows the library without them, which is not what is wanted.
  CHECK(run_posevote(w.folder, "run uwa" + out + models + w.scans()).status == 1);
  for (const std::string& command :
       {"train uwa --out " + library + models, "run uwa" + out + "2" + models + w.scans()}) {
    const CommandResult result = run_posevote(w.folder, command + " --on-error stop");
    INFO(result.output);
    CHECK(result.status == (command[0] == 'r' ? 2 : 1));
    CHECK_THAT(result.output, Contains("load_models: ") && Contains("text.ply"));
  }
  // Alone the crumb would set the scale, and be a model like others.
  const CommandResult none = run_posevote(w.folder, "run uwa --set derive_scale.finest=0.0005" +
                                                        out + "3 --models" + w.bad + w.scans());
  CHECK(none.status == 2);
  CHECK_THAT(none.output, Contains("no model can be used") && Contains("crumb.obj") &&
                              Contains("line.obj") && Contains("text.ply"));
  CHECK_FALSE(std::filesystem::exists(library));
}

}  // namespace posevote::bad_models_test

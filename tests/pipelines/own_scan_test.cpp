// SPDX-License-Identifier: BSD-3-Clause
// From a clean clone to the picture of one's own scan: the four commands that lead the README, as
// they stand there.
#include "nodes/formats/read_scan.hpp"
#include "tests/pipelines/run_world.hpp"

namespace posevote::own_scan_test {

using namespace posevote::test;

namespace {

const fs::path kSource = POSEVOTE_SOURCE_DIR;

/// The first lines of code below "On your own scans", without their comments.
std::vector<std::string> four_commands() {
  std::istringstream readme(read_text(kSource / "README.md"));
  std::vector<std::string> commands;
  bool below = false;
  for (std::string line; std::getline(readme, line);) {
    below = below || line == "## On your own scans";
    const bool code = below && line.starts_with("    ");
    if (!code && !commands.empty()) break;
    if (code) commands.push_back(line.substr(4, line.find(" #") - 4));
  }
  return commands;
}

void write_stl(const fs::path& file, const Mesh& mesh) {
  std::ofstream out(file);
  out << "solid part\n";
  for (Eigen::Index i = 0; i < mesh.faces.rows(); ++i) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (int corner = 0; corner < 3; ++corner)
      out << "vertex " << mesh.points.row(mesh.faces(i, corner)) << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid part\n";
}

}  // namespace

TEST_CASE("four commands lead from a clean clone to the picture of one's own scan", "[docs]") {
  const std::vector<std::string> commands = four_commands();
  REQUIRE(commands.size() == 4);
  for (const std::string& script : {commands[0], commands[1]}) {
    const fs::path file = kSource / script.substr(0, script.find(' '));
    INFO(file);
    CHECK((fs::status(file).permissions() & fs::perms::owner_exec) != fs::perms::none);
  }
  const TemporaryFolder folder;
  write_stl(folder / "part.stl", formats::read_mesh(world().models / "obj_000001.ply", 1));
  fs::copy(world().scans / "000001.ply", folder / "scan.ply");
  for (const std::string& line : {commands[2], commands[3]}) {
    REQUIRE(line.starts_with("build/posevote "));
    const std::string command = "cd '" + folder.path().string() + "' && '" POSEVOTE_BINARY "'" +
                                line.substr(line.find(' ')) + " > log 2>&1";
    const int status = std::system(command.c_str());
    INFO(read_text(folder / "log"));
    CHECK(status == 0);
  }
  CHECK(read_text(folder / "out/detections.csv").find("part") != std::string::npos);
  CHECK(read_text(folder / "out/report.html").size() > 100000);
}

}  // namespace posevote::own_scan_test

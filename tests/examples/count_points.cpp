// SPDX-License-Identifier: BSD-3-Clause
// Example of a command: `posevote count FILE...` prints how many points and faces files hold.
// Copied to tools/options/count_points.cpp it is a subcommand of the program.
#include <cstdio>
#include <stdexcept>

#include "nodes/formats/read_scan.hpp"
#include "tools/command_line.hpp"

namespace posevote::examples {
namespace {

struct CountCommand {
  std::vector<std::string> files;
};

void count(const std::string& file) {
  try {
    const Mesh mesh = formats::read_mesh(file, 1);
    std::printf("%s: %td points, %td faces\n", file.c_str(), mesh.points.rows(), mesh.faces.rows());
  } catch (const std::runtime_error& error) {  // it does not name the file
    throw std::runtime_error(file + ": " + error.what());
  }
}

const auto registered = register_command<CountCommand>(
    "count", "Print how many points and faces files hold",
    [](CLI::App& app, CountCommand& command) {
      app.add_option("files", command.files, "Scans or models")->required()->type_name("FILE");
    },
    [](const CountCommand& command) {
      for (const std::string& file : command.files) count(file);
      return 0;
    });

}  // namespace
}  // namespace posevote::examples

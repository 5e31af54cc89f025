// SPDX-License-Identifier: BSD-3-Clause
// Recordings of the TUM RGB-D benchmark (Sturm et al., IROS 2012): depth.txt lists "timestamp
// depth/FILE.png" line by line. A depth is 1/5000 m. The camera is that of camera.json beside
// depth.txt; without it the one that the benchmark's tools take for its own registered images.
#include <algorithm>
#include <stdexcept>

#include "nodes/formats/file_bytes.hpp"
#include "nodes/formats/text_scanner.hpp"
#include "nodes/layouts/camera_file.hpp"
#include "nodes/layouts/files.hpp"
#include "nodes/layouts/recording.hpp"

namespace posevote::layouts {
namespace {

namespace fs = std::filesystem;

constexpr double kMillimetresPerUnit = 0.2;
constexpr Camera kBenchmarks{525.0, 525.0, 319.5, 239.5, kMillimetresPerUnit};

struct Entry {
  double time = 0;  ///< [s]
  fs::path file;
};

std::vector<Entry> read_entries(const fs::path& list) {
  const formats::FileBytes bytes = formats::read_file(list);
  formats::TextScanner in(bytes.view(), '#');
  std::vector<Entry> entries;
  while (in.next_line()) {
    const double time = in.number();
    const std::string name(in.word());
    if (name.empty() || !in.line_done()) in.fail("expected a timestamp and a file");
    entries.push_back({time, list.parent_path() / name});
  }
  if (entries.empty()) throw std::runtime_error("lists no depth image");
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.time < b.time; });
  return entries;
}

std::vector<SceneFile> frames(const fs::path& folder) {
  Camera camera = find_camera(folder).value_or(kBenchmarks);
  if (camera.depth_scale == 0) camera.depth_scale = kMillimetresPerUnit;
  const fs::path list = folder / "depth.txt";
  std::vector<SceneFile> files;
  try {
    for (const Entry& entry : read_entries(list)) files.push_back({entry.file, 0, 0, camera});
  } catch (const std::runtime_error& error) {
    fail(list, error.what());
  }
  return files;
}

const auto registered = register_recording(
    {"TUM RGB-D", "depth.txt with lines 'timestamp depth/FILE.png'",
     [](const fs::path& folder) { return fs::exists(folder / "depth.txt"); }, frames});

}  // namespace
}  // namespace posevote::layouts

// SPDX-License-Identifier: BSD-3-Clause
// Recordings of the TUM RGB-D benchmark (Sturm et al., IROS 2012): depth.txt lists "timestamp
// depth/FILE.png" line by line, and rgb.txt, where there is one, the colour images, which are taken at
// other times: to each depth image belongs the nearest within 20 ms, as in the benchmark's own
// tools. A depth is 1/5000 m. The camera is that of camera.json beside
// depth.txt; without it the one that the benchmark's tools take for its own registered images.
#include <algorithm>
#include <cmath>
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
  if (entries.empty()) throw std::runtime_error("lists no image");
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.time < b.time; });
  return entries;
}

/// None where the list or an image of that time is missing. `colors`: ascending.
fs::path color_at(double time, const std::vector<Entry>& colors) {
  constexpr double kApart = 0.02;  // [s]
  const auto after = std::partition_point(colors.begin(), colors.end(),
                                          [time](const Entry& e) { return e.time < time; });
  const Entry* best = nullptr;
  const auto consider = [&](const Entry& entry) {
    if (std::abs(entry.time - time) <= (best ? std::abs(best->time - time) : kApart)) best = &entry;
  };
  if (after != colors.begin()) consider(*(after - 1));
  if (after != colors.end()) consider(*after);
  return best ? best->file : fs::path();
}

/// Of a list that may be missing.
std::vector<Entry> read_colors(const fs::path& list) {
  if (!fs::exists(list)) return {};
  try {
    return read_entries(list);
  } catch (const std::runtime_error& error) {
    fail(list, error.what());
  }
}

std::vector<SceneFile> frames(const fs::path& folder) {
  Camera camera = find_camera(folder).value_or(kBenchmarks);
  if (camera.depth_scale == 0) camera.depth_scale = kMillimetresPerUnit;
  const fs::path list = folder / "depth.txt";
  const std::vector<Entry> colors = read_colors(folder / "rgb.txt");
  std::vector<SceneFile> files;
  try {
    for (const Entry& entry : read_entries(list))
      files.push_back({entry.file, 0, 0, camera, {}, {}, color_at(entry.time, colors)});
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

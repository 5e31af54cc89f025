// SPDX-License-Identifier: BSD-3-Clause
// A long stream with broken frames: each good one is answered, each broken one named, and memory
// does not grow. Two thousand frames: build/tests/test_pipelines "[.long-stream]"
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>
#include <thread>

#include "tests/support/small_images.hpp"

namespace posevote::stream_test {

using namespace posevote::test;

namespace {

namespace fs = std::filesystem;

/// A recording of so many frames, another scene after 50, every 20th of them broken in one of five ways. Returns those.
std::set<std::string> record(const SmallImages& images, const fs::path& recording, int frames) {
  fs::create_directories(recording / "depth");
  const auto cameras = read_json(images.scene / "scene_camera.json");
  const auto& k = cameras["0"]["cam_K"];
  std::ofstream(recording / "camera.json")
      << nlohmann::json{{"fx", k[0]},
                        {"fy", k[4]},
                        {"cx", k[2]},
                        {"cy", k[5]},
                        {"depth_scale", cameras["0"]["depth_scale"]}};
  const auto image = [&](int i) {
    return images.scene / "depth" / ("00000" + std::to_string(i / 50 % 3) + ".png");
  };
  const std::string whole = read_text(image(0));
  std::string changed = whole;
  changed[whole.size() / 2] = static_cast<char>(changed[whole.size() / 2] ^ 0x55);
  const std::string broken[] = {"", "no image", whole.substr(0, whole.size() / 2),
                                whole.substr(0, 20), changed};
  std::set<std::string> names;
  for (int i = 0; i < frames; ++i) {
    const std::string name = std::to_string(100000 + i) + ".png";
    const fs::path file = recording / "depth" / name;
    if (i % 20 != 7) {
      fs::create_hard_link(image(i), file);
    } else {
      std::ofstream(file, std::ios::binary) << broken[i / 20 % 5];
      names.insert(name);
    }
  }
  return names;
}

/// Of a process, now [kB].
long resident(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  return 0;
}

struct Ended {
  int status = -1;
  std::vector<long> memory;  ///< [kB], every 50 ms
};

Ended run_watched(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  const pid_t process = ::fork();
  if (process == 0) {
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  Ended ended;
  int status = 0;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    ended.memory.push_back(resident(process));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  ended.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return ended;
}

/// The highest of a part of the run.
long peak(const std::vector<long>& memory, double from, double to) {
  const auto at = [&](double share) {
    return memory.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(memory.size()));
  };
  return *std::max_element(at(from), at(to));
}

void run_stream(int frames, bool is_flat) {
  const SmallImages images;
  const fs::path recording = images.folder / "recording", out = images.folder / "out";
  const std::set<std::string> broken = record(images, recording, frames);
  const std::string models = (images.folder / "data/models").string();
  const std::string cache = (images.folder / "cache").string();
  const Ended ended =
      run_watched({POSEVOTE_BINARY, "run", "stream", "--models", models, "--scenes",
                   recording.string(), "--out", out.string(), "--cache", cache, "--quiet"});
  CHECK(ended.status == 1);
  const auto answered = read_json(out / "results.json")["frames"];
  CHECK(answered.size() == static_cast<std::size_t>(frames) - broken.size());
  std::set<std::string> failed;
  for (const auto& failure : read_json(out / "failures.json")) {
    failed.insert(fs::path(failure["file"].get<std::string>()).filename().string());
    CHECK_FALSE(failure["what"].get<std::string>().empty());
  }
  CHECK(failed == broken);
  if (!is_flat) return;
  const long early = peak(ended.memory, 0.25, 0.5), late = peak(ended.memory, 0.75, 1);
  INFO("resident in the second quarter at most " << early << " kB, in the last " << late << " kB");
  CHECK(static_cast<double>(late) < 1.05 * static_cast<double>(early));
}

}  // namespace

TEST_CASE("a stream's answers are the same at any number of threads and tokens", "[stream]") {
  const SmallImages images;
  const fs::path recording = images.folder / "recording";
  record(images, recording, 12);
  std::string first;
  for (const std::string how :
       {"--threads 1 --tokens 1", "--threads 1 --tokens 8", "--threads 4 --tokens 8"}) {
    const std::string out = (images.folder / "out").string();
    const CommandResult run = run_posevote(
        images.folder, "run stream --models " + (images.folder / "data/models").string() +
                           " --scenes " + recording.string() + " --overwrite --out " + out + " " +
                           how);
    INFO(how << "\n" << run.output);
    CHECK(run.status == 1);
    if (first.empty()) first = answers(out);
    CHECK(std::count(first.begin(), first.end(), '\n') > 11);
    CHECK(answers(out) == first);
  }
}

TEST_CASE("each good frame of a stream is answered, each broken one named", "[stream]") {
  run_stream(100, false);
}

TEST_CASE("two thousand frames in the same memory", "[.long-stream]") { run_stream(2000, true); }

}  // namespace posevote::stream_test

// SPDX-License-Identifier: BSD-3-Clause
#include "pipelines/training_lock.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>
#include <vector>

#include "tests/support/temporary_folder.hpp"

namespace posevote::training_lock_test {

using posevote::test::TemporaryFolder;

TEST_CASE("one makes a library at a time, and who waited for it knows", "[pipelines]") {
  const TemporaryFolder folder;
  const std::filesystem::path library = folder / "cache/key.library";
  std::atomic<int> inside = 0, most = 0, waited = 0;
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 6; ++i)
      threads.emplace_back([&] {
        const TrainingLock lock(library, nullptr);
        waited += lock.waited();
        most = std::max(most.load(), ++inside);
        std::this_thread::sleep_for(std::chrono::milliseconds(30));
        --inside;
      });
  }
  CHECK(most == 1);
  CHECK(waited >= 4);  // who opens the file as its last holder leaves need not
  CHECK(std::filesystem::is_empty(folder / "cache"));
}

TEST_CASE("where nothing can be written nobody waits for a library", "[pipelines]") {
  const TemporaryFolder folder;
  const std::string no_folder = folder.write("file", "");
  const TrainingLock one(no_folder + "/key.library", nullptr);
  const TrainingLock other(no_folder + "/key.library", nullptr);
  CHECK_FALSE(other.waited());
}

TEST_CASE("who waits for a library may have enough of it", "[pipelines]") {
  const TemporaryFolder folder;
  const std::filesystem::path library = folder / "key.library";
  const TrainingLock other(library, nullptr);
  std::atomic<bool> cancelled = false;
  const graph::Activity activity(&cancelled);
  std::jthread user([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    cancelled = true;
  });
  CHECK_THROWS_AS(TrainingLock(library, &activity), graph::Cancelled);
}

}  // namespace posevote::training_lock_test

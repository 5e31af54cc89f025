// SPDX-License-Identifier: BSD-3-Clause
// Whatever happened to a file on its way: a reader takes it as a valid one or refuses it in words,
// and asks for no more memory than the file's size justifies.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <random>

#include "tests/fuzz/reader.hpp"

namespace posevote::damage_test {

using namespace posevote::test;

namespace {

/// Of each sample; `POSEVOTE_DAMAGES=100000 build/tests/test_fuzz` is a campaign.
int changes_per_sample() {
  const char* asked = std::getenv("POSEVOTE_DAMAGES");
  return asked ? std::atoi(asked) : 600;
}

/// Lets the process grow by some 64 MB only, while it is there. The address sanitizer's own reservations rule it out.
class MemoryLimit {
 public:
  MemoryLimit() {
    ::getrlimit(RLIMIT_AS, &before_);
#ifndef __SANITIZE_ADDRESS__
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit = before_;
    limit.rlim_cur = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) + (64U << 20U);
    ::setrlimit(RLIMIT_AS, &limit);
#endif
  }
  ~MemoryLimit() { ::setrlimit(RLIMIT_AS, &before_); }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

/// One to four changes: a byte, a bit, a piece left out or doubled, a number made large.
std::string damaged(std::string bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t n) { return n == 0 ? 0 : random() % n; };
  for (std::size_t changes = 1 + below(4); changes > 0 && !bytes.empty(); --changes) {
    const std::size_t at = below(bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes.erase(at, 1 + below(8));
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(12)));
        break;
      case 4:
        bytes.replace(at, 1, "4294967295");
        break;
      default:
        bytes.replace(at, std::min<std::size_t>(4, bytes.size() - at), "\xff\xff\xff\xff");
    }
  }
  return bytes;
}

/// Whether the reader takes them, with 64 MB at most for each; a fault shows the file.
bool takes_little(const Reader& reader, std::string_view bytes) {
  const MemoryLimit limit;
  try {
    return takes(reader, bytes);
  } catch (const std::exception& fault) {
    std::ofstream("fault." + reader.name, std::ios::binary) << bytes;
    throw std::logic_error(reader.name + ": " + fault.what() + ", of fault." + reader.name);
  }
}

/// Calls use(reader, sample) for all of them.
template <class Use>
void for_each_sample(const Use& use) {
  for (const Reader& reader : readers())
    for (const Sample& sample : reader.samples) {
      INFO(reader.name << ", " << sample.name);
      use(reader, sample);
    }
}

}  // namespace

TEST_CASE("Damage: every sample is whole to begin with", "[damage]") {
  for_each_sample(
      [](const Reader& reader, const Sample& sample) { CHECK_NOTHROW(reader.read(sample.bytes)); });
}

TEST_CASE("Damage: files cut off at every byte", "[damage]") {
  for_each_sample([](const Reader& reader, const Sample& sample) {
    // A text may lack its last line end, and what a cut within its last number left is a number.
    const std::size_t last_line = sample.bytes.rfind('\n', sample.bytes.size() - 2);
    const std::size_t one_line = sample.bytes.size() - 1;
    for (std::size_t size = 0; size < sample.bytes.size(); ++size) {
      INFO("cut to " << size);
      const bool taken = takes_little(reader, std::string_view(sample.bytes).substr(0, size));
      if (sample.ends_known && size < std::min(last_line, one_line)) CHECK_FALSE(taken);
    }
  });
}

TEST_CASE("Damage: bytes changed at random", "[damage]") {
  std::mt19937 random(20170917);
  for_each_sample([&](const Reader& reader, const Sample& sample) {
    int taken = 0;
    for (int i = 0; i < changes_per_sample(); ++i)
      taken += takes_little(reader, damaged(sample.bytes, random));
    CHECK(taken < changes_per_sample());
  });
}

TEST_CASE("Damage: random bytes behind a good beginning", "[damage]") {
  std::mt19937 random(7);
  for_each_sample([&](const Reader& reader, const Sample& sample) {
    for (std::size_t i = 0; i < 100; ++i) {
      std::string bytes = sample.bytes.substr(0, sample.bytes.size() * i / 100);
      while (bytes.size() < sample.bytes.size()) bytes += static_cast<char>(random() % 256U);
      takes_little(reader, bytes);
    }
  });
}

}  // namespace posevote::damage_test

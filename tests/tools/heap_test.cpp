// SPDX-License-Identifier: BSD-3-Clause
#include "tools/heap.hpp"

#include <oneapi/tbb/task_arena.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <thread>

namespace posevote::heap_test {
namespace {

constexpr std::size_t kPage = 4096, kSize = 12 << 20, kPages = kSize / kPage;

/// Whether the system gives pages before they are touched (Linux 5.14), and malloc() is its own.
bool can_be_asked() {
#ifdef __SANITIZE_ADDRESS__
  return false;
#else
  void* place = mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const bool can = madvise(place, kSize, MADV_POPULATE_WRITE) == 0;
  munmap(place, kSize);
  return can;
#endif
}

long faults() {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt;
}

/// How often a thread is interrupted that fills new memory.
long faults_of_filling() {
  const long before = faults();
  void* block = std::malloc(kSize);
  volatile char* bytes = static_cast<char*>(block);
  for (std::size_t page = 0; page < kPages; ++page) bytes[page * kPage] = 1;
  const long after = faults();
  std::free(block);
  return after - before;
}

/// In a thread of its own, which has a heap of its own.
template <class Work>
void in_thread(const Work& work) {
  std::thread([&] { oneapi::tbb::task_arena(1).execute(work); }).join();
}

}  // namespace

TEST_CASE("frames find the memory that they take", "[run]") {
  if (!can_be_asked()) {
    WARN("skipped: this system or build gives memory only when it is touched");
    return;
  }
  keep_heap();
  long without = 0, with = 0;
  in_thread([&] { without = faults_of_filling(); });
  in_thread([&] {
    const ReadyHeap heap;
    with = faults_of_filling();
  });
  if (without < static_cast<long>(kPages) / 2) {
    WARN("skipped: this system gives many pages at a touch");
    return;
  }
  CHECK(with < without / 10);
}

}  // namespace posevote::heap_test

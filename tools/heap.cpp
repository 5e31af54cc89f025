// SPDX-License-Identifier: BSD-3-Clause
#include "tools/heap.hpp"

#include <malloc.h>
#include <oneapi/tbb/task_arena.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <vector>

namespace posevote {
namespace {

// Small enough to come from the thread's own heap, of which several fit one that is not main()'s.
constexpr std::size_t kBlock = 16 << 20;
// Of main()'s thread and of each other: what an image of 640 x 480 takes on two threads.
constexpr int kBlocks = 6, kWorkerBlocks = 3;
// Of all workers: of many threads each works on a smaller part of an image.
constexpr int kMostWorkerBlocks = 24;

/// Asks the system for the pages of a block; one that does not know how gives them when touched.
void touch(void* block) {
  const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  std::size_t size = kBlock;
  std::align(page, 0, block, size);
  madvise(block, size / page * page, MADV_POPULATE_WRITE);
}

/// Of this thread's heap, once.
void ready_heap(int blocks) {
  thread_local bool is_ready = false;
  if (is_ready) return;
  is_ready = true;
  struct Free {
    void operator()(void* block) const { std::free(block); }
  };
  std::vector<std::unique_ptr<void, Free>> taken;  // one behind the other, so all at once
  for (int i = 0; i < blocks; ++i)
    if (taken.emplace_back(std::malloc(kBlock))) touch(taken.back().get());
}

}  // namespace

void keep_heap() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

ReadyHeap::ReadyHeap() { observe(true); }

ReadyHeap::~ReadyHeap() { observe(false); }

void ReadyHeap::on_scheduler_entry(bool is_worker) {
  const int workers = std::max(1, oneapi::tbb::this_task_arena::max_concurrency() - 1);
  ready_heap(is_worker ? std::clamp(kMostWorkerBlocks / workers, 1, kWorkerBlocks) : kBlocks);
}

}  // namespace posevote

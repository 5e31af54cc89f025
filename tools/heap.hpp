// SPDX-License-Identifier: BSD-3-Clause
// What the C library does with the memory that frames take and free again.
#pragma once

#include <oneapi/tbb/task_scheduler_observer.h>

namespace posevote {

/// What one frame frees the next one takes. Otherwise the C library gives large blocks back to the
/// system, which clears them again page by page: a tenth of the time that the densities of half a
/// million votes take, a hundredth of a whole RGB-D frame's.
void keep_heap();

/// While one lives, each thread of this arena has the memory that an image takes before its first
/// task. A page that is touched for the first time interrupts the program, which takes ten
/// microseconds in a virtual machine and half a microsecond where many are asked for at once: some
/// 8 % of the time of a run's first five images (tools/experiment/README.md, Speed).
class ReadyHeap : public oneapi::tbb::task_scheduler_observer {
 public:
  ReadyHeap();
  ~ReadyHeap() override;

  void on_scheduler_entry(bool is_worker) override;
};

}  // namespace posevote

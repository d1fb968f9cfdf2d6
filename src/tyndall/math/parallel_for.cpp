// SPDX-License-Identifier: Apache-2.0
#include "tyndall/math/parallel_for.h"

#include <tbb/parallel_for.h>

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define TYNDALL_THREAD_SANITIZER
#endif
#elif defined(__SANITIZE_THREAD__)
#define TYNDALL_THREAD_SANITIZER
#endif

#ifdef TYNDALL_THREAD_SANITIZER
extern "C" void __tsan_acquire(void* address);
extern "C" void __tsan_release(void* address);
#endif

namespace tyndall {
namespace {

// What happens before give() happens before what follows take() on another thread. oneTBB
// sees to that; this tells ThreadSanitizer, which cannot look into oneTBB.
class HandOver {
 public:
#ifdef TYNDALL_THREAD_SANITIZER
  void give() { __tsan_release(this); }
  void take() { __tsan_acquire(this); }
#else
  void give() {}
  void take() {}
#endif
};

}  // namespace

void parallel_for(size_t count, const std::function<void(size_t)>& body) {
  HandOver begin, end;
  begin.give();
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    begin.take();
    body(i);
    end.give();
  });
  end.take();
}

}  // namespace tyndall

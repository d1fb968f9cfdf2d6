// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace tyndall {
namespace {

constexpr uintptr_t huge_page = uintptr_t{1} << 21;
// MADV_COLLAPSE of Linux 6.1, which the headers of older systems do not name.
constexpr int collapse_now = 25;

}  // namespace

void prefer_huge_pages(void* begin, size_t size) {
  const uintptr_t start = reinterpret_cast<uintptr_t>(begin);
  const uintptr_t first = (start + huge_page - 1) & ~(huge_page - 1);
  const uintptr_t last = (start + size) & ~(huge_page - 1);
  if (first >= last) return;
  void* const pages = static_cast<std::byte*>(begin) + (first - start);
  // Both may fail and then leave things as they were.
  if (::madvise(pages, last - first, MADV_HUGEPAGE) != 0) return;
  static_cast<void>(::madvise(pages, last - first, collapse_now));
}

}  // namespace tyndall

// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/sparse_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <new>

namespace tyndall {

SparseMemory::SparseMemory(size_t size) : size_(size) {
  void* mapped = ::mmap(nullptr, size, PROT_READ | PROT_WRITE,
                        MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  data_ = static_cast<std::byte*>(mapped);
}

SparseMemory::~SparseMemory() { ::munmap(data_, size_); }

void SparseMemory::release(size_t begin, size_t end) {
  const size_t page = static_cast<size_t>(::sysconf(_SC_PAGESIZE));
  const size_t first = (begin + page - 1) / page * page, last = end / page * page;
  if (first < last) ::madvise(data_ + first, last - first, MADV_DONTNEED);
}

}  // namespace tyndall

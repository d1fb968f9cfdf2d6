// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tyndall {

/// Bytes that need memory only where they were written, page by page; the others are zero.
class SparseMemory {
 public:
  /// Throws std::bad_alloc.
  explicit SparseMemory(size_t size);
  ~SparseMemory();
  SparseMemory(const SparseMemory&) = delete;
  SparseMemory& operator=(const SparseMemory&) = delete;

  std::byte* data() { return data_; }
  size_t size() const { return size_; }
  /// Gives back the pages that lie wholly in [begin, end): they are zero again.
  void release(size_t begin, size_t end);

 private:
  std::byte* data_;
  size_t size_;
};

}  // namespace tyndall

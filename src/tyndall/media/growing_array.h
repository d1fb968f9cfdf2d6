// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace tyndall {

/// An array of numbers that grows without being copied where the system can move its pages
/// (realloc of large blocks under Linux): never twice its size in memory, as a std::vector
/// is while it grows.
template <typename T>
class GrowingArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  const T* data() const { return data_.get(); }
  T* data() { return data_.get(); }
  size_t size() const { return size_; }

  /// Throws std::bad_alloc.
  void append(std::span<const T> more) {
    if (size_ + more.size() > capacity_) grow(size_ + more.size() + size_ / 8);
    std::copy(more.begin(), more.end(), data_.get() + size_);
    size_ += more.size();
  }
  /// Gives back what append() took in advance.
  void shrink_to_fit() {
    if (size_ > 0) grow(size_);
  }

 private:
  struct Free {
    void operator()(T* p) const { std::free(p); }
  };

  void grow(size_t capacity) {
    void* moved = std::realloc(data_.get(), capacity * sizeof(T));
    if (!moved) throw std::bad_alloc();
    static_cast<void>(data_.release());
    data_.reset(static_cast<T*>(moved));
    capacity_ = capacity;
  }

  std::unique_ptr<T[], Free> data_;
  size_t size_ = 0, capacity_ = 0;
};

}  // namespace tyndall

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tyndall {

/// A chunk in the format of Blosc 1, unpacked one of its blocks at a time: neither the
/// packed nor the unpacked chunk is ever in memory as a whole. Damage is a
/// std::runtime_error.
class BloscChunk {
 public:
  /// Reads the bytes of the packed chunk that begin at an offset; throws if there are none.
  using ReadAt = std::function<void(uint64_t offset, std::span<std::byte> to)>;

  BloscChunk() = default;
  BloscChunk(ReadAt read_at, uint64_t packed_size);

  /// Of the unpacked chunk, in bytes.
  size_t size() const { return size_; }
  /// How much of it has not been read yet.
  size_t left() const { return size_ - done_; }
  /// The next bytes, at most as many as are left.
  void read(std::span<std::byte> to);

 private:
  size_t block_count() const { return (size_ + block_size_ - 1) / block_size_; }
  void read_starts();
  void unpack_block(size_t block);

  ReadAt read_at_;
  uint64_t packed_size_ = 0;
  size_t size_ = 0, block_size_ = 0, done_ = 0;
  std::vector<std::byte> header_;
  std::vector<uint32_t> starts_, ends_;  // of the packed blocks; empty: they are not packed
  std::vector<std::byte> packed_, block_;
};

}  // namespace tyndall

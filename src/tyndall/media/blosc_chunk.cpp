// SPDX-License-Identifier: Apache-2.0
//
// A chunk is a header, the offset of each block, and the blocks. A block by itself is
// unpacked as a chunk of one block.
#include "tyndall/media/blosc_chunk.h"

#include <blosc.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace tyndall {
namespace {

constexpr size_t offset_size = sizeof(uint32_t);
// Where the header has its numbers.
constexpr size_t flags_at = 2, size_at = 4, block_size_at = 8, packed_size_at = 12;

[[noreturn]] void fail_damaged_chunk() { throw std::runtime_error("a grid is damaged"); }

uint32_t number_at(std::span<const std::byte> bytes, size_t at) {
  uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

void set_number(std::span<std::byte> bytes, size_t at, uint32_t value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

}  // namespace

BloscChunk::BloscChunk(ReadAt read_at, uint64_t packed_size)
    : read_at_(std::move(read_at)),
      packed_size_(packed_size),
      header_(BLOSC_MIN_HEADER_LENGTH) {
  if (packed_size < header_.size()) fail_damaged_chunk();
  read_at_(0, header_);
  size_ = number_at(header_, size_at);
  block_size_ = number_at(header_, block_size_at);
  if (number_at(header_, packed_size_at) != packed_size || size_ == 0 || block_size_ == 0 ||
      block_size_ > size_)
    fail_damaged_chunk();
  const bool is_packed = !(static_cast<unsigned>(header_[flags_at]) & BLOSC_MEMCPYED);
  if (is_packed)
    read_starts();
  else if (packed_size_ != header_.size() + size_)
    fail_damaged_chunk();
}

// Blocks lie in any order, but without gaps: each ends where another begins.
void BloscChunk::read_starts() {
  const size_t begin = header_.size() + block_count() * offset_size;
  if (begin > packed_size_) fail_damaged_chunk();
  starts_.resize(block_count());
  read_at_(header_.size(), std::as_writable_bytes(std::span(starts_)));
  std::vector<uint32_t> sorted = starts_;
  std::sort(sorted.begin(), sorted.end());
  sorted.push_back(static_cast<uint32_t>(packed_size_));
  if (sorted.front() < begin || *(sorted.end() - 2) > packed_size_) fail_damaged_chunk();
  for (const uint32_t start : starts_)
    ends_.push_back(*std::upper_bound(sorted.begin(), sorted.end() - 1, start));
}

void BloscChunk::read(std::span<std::byte> to) {
  while (!to.empty()) {
    const size_t within = done_ % block_size_;
    if (within == 0) unpack_block(done_ / block_size_);
    const size_t count = std::min(to.size(), block_.size() - within);
    std::memcpy(to.data(), block_.data() + within, count);
    done_ += count;
    to = to.subspan(count);
  }
}

void BloscChunk::unpack_block(size_t block) {
  const size_t begin = block * block_size_;
  if (begin >= size_) fail_damaged_chunk();
  block_.resize(std::min(block_size_, size_ - begin));
  if (starts_.empty()) return read_at_(header_.size() + begin, block_);
  // The last block is packed in another way if it is shorter: it stays shorter than the
  // header's block size.
  const size_t single = header_.size() + offset_size,
               packed = ends_[block] - starts_[block];
  packed_.resize(single + packed);
  std::copy(header_.begin(), header_.end(), packed_.begin());
  set_number(packed_, size_at, static_cast<uint32_t>(block_.size()));
  set_number(packed_, packed_size_at, static_cast<uint32_t>(packed_.size()));
  set_number(packed_, header_.size(), static_cast<uint32_t>(single));
  read_at_(starts_[block], std::span(packed_).subspan(single));
  const size_t unpacked = block_.size();
  block_.resize(block_size_);
  const int count = blosc_decompress_ctx(packed_.data(), block_.data(), block_size_, 1);
  block_.resize(unpacked);
  if (count != static_cast<int>(unpacked)) fail_damaged_chunk();
}

}  // namespace tyndall

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tyndall/math/vec.h"

namespace tyndall {

/// Appends numbers to a string of bytes, little-endian on every machine.
class ByteWriter {
 public:
  template <std::unsigned_integral T>
  void write(T value) {
    for (size_t i = 0; i < sizeof(T); ++i)
      bytes_.push_back(static_cast<std::byte>(static_cast<uint64_t>(value) >> (8 * i)));
  }
  void write(float value) { write(std::bit_cast<uint32_t>(value)); }
  void write(double value) { write(std::bit_cast<uint64_t>(value)); }
  void write(Vec3 v) { write(v.x), write(v.y), write(v.z); }

  void append(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }

  const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  std::vector<std::byte> bytes_;
};

/// Reads what a ByteWriter wrote. Past the end every number is zero, and failed() says so.
class ByteReader {
 public:
  /// `bytes` must outlive the reader.
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <std::unsigned_integral T>
  void read(T& value) {
    value = 0;
    if (bytes_.size() < sizeof(T)) return fail();
    uint64_t bits = 0;
    for (size_t i = 0; i < sizeof(T); ++i)
      bits |= static_cast<uint64_t>(bytes_[i]) << (8 * i);
    value = static_cast<T>(bits);
    bytes_ = bytes_.subspan(sizeof(T));
  }
  void read(float& value) { value = std::bit_cast<float>(read_as<uint32_t>()); }
  void read(double& value) { value = std::bit_cast<double>(read_as<uint64_t>()); }
  void read(Vec3& v) { read(v.x), read(v.y), read(v.z); }
  /// The next number, where its type is not that of a variable at hand.
  template <typename T>
  T read_as() {
    T value;
    read(value);
    return value;
  }

  /// The next `size` bytes; none, and the reader failed, if fewer are left.
  std::span<const std::byte> take(size_t size) {
    if (bytes_.size() < size) return fail(), bytes_;
    const std::span<const std::byte> taken = bytes_.first(size);
    bytes_ = bytes_.subspan(size);
    return taken;
  }

  bool failed() const { return failed_; }
  /// Marks the input as not what it should be.
  void fail() {
    failed_ = true;
    bytes_ = {};
  }
  size_t remaining() const { return bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  bool failed_ = false;
};

}  // namespace tyndall

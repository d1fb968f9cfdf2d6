// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <stdexcept>
#include <string_view>

#include "tyndall/loader/ply_header.h"

namespace tyndall::loader {

/// The data of a PLY file, one scalar after the other.
class PlyValues {
 public:
  PlyValues(std::string_view data, PlyFormat format) : data_(data), format_(format) {}

  /// Throws std::runtime_error if the data end or, in ascii, are no number.
  double next(PlyType type) {
    if (format_ != PlyFormat::ascii) return next_bytes(type);
    const double value = next_word();
    return type == PlyType::float32 ? static_cast<double>(static_cast<float>(value))
                                    : value;
  }
  size_t bytes_left() const { return data_.size() - at_; }
  bool is_ascii() const { return format_ == PlyFormat::ascii; }

 private:
  template <typename T>
  double next_as() {
    if (bytes_left() < sizeof(T)) throw std::runtime_error("the PLY data end too early");
    char bytes[sizeof(T)];
    std::memcpy(bytes, data_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (format_ == PlyFormat::binary_big_endian)
      for (size_t i = 0; i < sizeof(T) / 2; ++i)
        std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    T value;
    std::memcpy(&value, bytes, sizeof(T));
    return static_cast<double>(value);
  }
  double next_bytes(PlyType type);
  double next_word();

  std::string_view data_;
  PlyFormat format_;
  size_t at_ = 0;
};

}  // namespace tyndall::loader

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>

namespace tyndall {

/// The bytes of one grid of a .vdb file, in turn. Whatever does not fit in what is left of
/// them is damage: std::runtime_error, without the names of file and grid.
class OpenVdbBytes {
 public:
  OpenVdbBytes(std::ifstream& file, int64_t begin, int64_t end)
      : file_(file), left_(end > begin ? static_cast<uint64_t>(end - begin) : 0) {
    file.seekg(begin);
  }

  uint64_t left() const { return left_; }

  void read(std::span<std::byte> to) {
    take(to.size());
    if (!file_.read(reinterpret_cast<char*>(to.data()),
                    static_cast<std::streamsize>(to.size())))
      throw std::runtime_error("the file ends within a grid");
  }
  template <typename T>
  T number() {
    T value{};
    read(std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }
  std::string text() {
    const uint32_t size = number<uint32_t>();
    require(size <= left_);
    std::string text(size, ' ');
    read(std::as_writable_bytes(std::span(text)));
    return text;
  }
  void skip(uint64_t count) {
    take(count);
    // To seek is to read the buffer anew.
    constexpr uint64_t buffer = 4096;
    if (count < buffer)
      file_.ignore(static_cast<std::streamsize>(count));
    else
      file_.seekg(static_cast<std::streamoff>(count), std::ios::cur);
  }

  static void require(bool is_sound) {
    if (!is_sound) throw std::runtime_error("a grid is damaged");
  }

 private:
  void take(uint64_t count) {
    require(count <= left_);
    left_ -= count;
  }

  std::ifstream& file_;
  uint64_t left_;
};

}  // namespace tyndall

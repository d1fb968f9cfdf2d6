// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/nanovdb_stream.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "tyndall/media/blosc_chunk.h"

namespace tyndall {
namespace {

[[noreturn]] void fail_damaged() { throw std::runtime_error("a grid is damaged"); }

void read_bytes(std::ifstream& file, void* to, uint64_t size) {
  if (!file.read(static_cast<char*>(to), static_cast<std::streamsize>(size)))
    throw std::runtime_error("the file ends within a grid");
}

}  // namespace

class NanoVdbStream::Source {
 public:
  virtual ~Source() = default;
  virtual void read(std::span<std::byte> to) = 0;
  virtual void check_end() {}
};

namespace {

// `left` counts down what the directory promised.
class Packed {
 public:
  Packed(std::ifstream& file, const NanoVdbEntry& entry)
      : file_(file), left_(entry.packed_size) {
    file.seekg(static_cast<std::streamoff>(entry.offset));
  }
  void read(void* to, uint64_t size) {
    if (size > left_) fail_damaged();
    if (resume_at_ > 0) file_.seekg(static_cast<std::streamoff>(resume_at_));
    resume_at_ = 0;
    read_bytes(file_, to, size);
    left_ -= size;
  }
  // Blocks of packed bytes begin with their size.
  uint64_t block_size() {
    uint64_t size = 0;
    read(&size, sizeof size);
    if (size > left_) fail_damaged();
    return size;
  }
  // Passes over so many bytes, which are read later.
  BloscChunk::ReadAt part(uint64_t size) {
    const auto begin = static_cast<uint64_t>(file_.tellg());
    left_ -= size;
    resume_at_ = begin + size;
    return [&file = file_, begin](uint64_t offset, std::span<std::byte> to) {
      file.seekg(static_cast<std::streamoff>(begin + offset));
      read_bytes(file, to.data(), to.size());
    };
  }

 private:
  std::ifstream& file_;
  uint64_t left_;
  uint64_t resume_at_ = 0;  // if not 0: where to go on in the file
};

class PlainSource : public NanoVdbStream::Source {
 public:
  explicit PlainSource(Packed packed) : packed_(packed) {}
  void read(std::span<std::byte> to) override { packed_.read(to.data(), to.size()); }

 private:
  Packed packed_;
};

class ZipSource : public NanoVdbStream::Source {
 public:
  explicit ZipSource(Packed packed) : packed_(packed), left_(packed_.block_size()) {
    if (inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~ZipSource() override { inflateEnd(&stream_); }
  ZipSource(const ZipSource&) = delete;
  ZipSource& operator=(const ZipSource&) = delete;

  void read(std::span<std::byte> to) override {
    while (!to.empty()) {
      if (stream_.avail_in == 0) refill();
      const size_t wanted = std::min(to.size(), size_t{1} << 30);
      stream_.next_out = reinterpret_cast<Bytef*>(to.data());
      stream_.avail_out = static_cast<uInt>(wanted);
      const int status = inflate(&stream_, Z_NO_FLUSH);
      const size_t done = wanted - stream_.avail_out;
      to = to.subspan(done);
      is_at_end_ = status == Z_STREAM_END;
      if (status != Z_OK && !(is_at_end_ && to.empty())) fail_damaged();
    }
  }

  // Nothing follows, and the checksum of all that went before is right.
  void check_end() override {
    Bytef more = 0;
    while (!is_at_end_) {
      if (stream_.avail_in == 0) refill();
      stream_.next_out = &more;
      stream_.avail_out = 1;
      const int status = inflate(&stream_, Z_NO_FLUSH);
      is_at_end_ = status == Z_STREAM_END;
      if (stream_.avail_out == 0 || (status != Z_OK && !is_at_end_)) fail_damaged();
    }
  }

 private:
  void refill() {
    if (left_ == 0) fail_damaged();
    const uint64_t size = std::min<uint64_t>(left_, input_.size());
    packed_.read(input_.data(), size);
    left_ -= size;
    stream_.next_in = input_.data();
    stream_.avail_in = static_cast<uInt>(size);
  }

  Packed packed_;
  uint64_t left_;
  std::vector<Bytef> input_ = std::vector<Bytef>(1 << 16);
  z_stream stream_{};
  bool is_at_end_ = false;
};

class BloscSource : public NanoVdbStream::Source {
 public:
  BloscSource(Packed packed, uint64_t size) : packed_(packed), left_(size) {}

  void read(std::span<std::byte> to) override {
    while (!to.empty()) {
      if (chunk_.left() == 0) next_chunk();
      const size_t count = std::min(to.size(), chunk_.left());
      chunk_.read(to.first(count));
      to = to.subspan(count);
    }
  }

 private:
  void next_chunk() {
    constexpr uint64_t largest = uint64_t{1} << 30;  // as NanoVDB splits larger grids
    chunk_ = {};
    const uint64_t size = packed_.block_size();
    chunk_ = BloscChunk(packed_.part(size), size);
    if (chunk_.size() != std::min(largest, left_)) fail_damaged();
    left_ -= chunk_.size();
  }

  Packed packed_;
  uint64_t left_;  // of the grid, after this chunk
  BloscChunk chunk_;
};

}  // namespace

NanoVdbStream::NanoVdbStream(std::ifstream& file, const NanoVdbEntry& entry) {
  const Packed packed(file, entry);
  if (entry.codec == 0) {
    if (entry.packed_size < entry.info.memory)
      throw std::runtime_error("its directory is damaged");
    source_ = std::make_unique<PlainSource>(packed);
  } else if (entry.codec == 1) {
    source_ = std::make_unique<ZipSource>(packed);
  } else if (entry.codec == 2) {
    source_ = std::make_unique<BloscSource>(packed, entry.info.memory);
  } else {
    throw std::runtime_error(fmt::format("unknown compression {}", entry.codec));
  }
}

NanoVdbStream::~NanoVdbStream() = default;

void NanoVdbStream::read(std::span<std::byte> to) { source_->read(to); }

void NanoVdbStream::skip(size_t count) {
  std::vector<std::byte> bytes(size_t{1} << 16);
  for (size_t size; count > 0; count -= size) {
    size = std::min(count, bytes.size());
    source_->read({bytes.data(), size});
  }
}

void NanoVdbStream::check_end() { source_->check_end(); }

}  // namespace tyndall

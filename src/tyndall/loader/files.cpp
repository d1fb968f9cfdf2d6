// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/files.h"

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <system_error>

#include "tyndall/loader/reporter.h"

namespace tyndall::loader {
namespace {

namespace fs = std::filesystem;

struct CloseGzip {
  void operator()(gzFile file) const { gzclose(file); }
};

std::string folder_of(const std::string& path) {
  return fs::path(path).parent_path().string();
}

}  // namespace

FileFinder::FileFinder(const std::string& scene_path, const SourceLibrary& sources)
    : sources_(sources), folder_(folder_of(scene_path)) {}

std::string FileFinder::find(const std::string& name, Span where) const {
  if (name.empty()) fail(where, "the file name is empty");
  if (name.find('\0') != name.npos) fail(where, "the file name holds a zero byte");
  const fs::path first = (fs::path(folder_) / name).lexically_normal();
  std::error_code error;
  if (fs::exists(first, error)) return first.string();
  const fs::path second =
      (fs::path(folder_of(sources_[where.source].name)) / name).lexically_normal();
  if (fs::exists(second, error)) return second.string();
  fail(where, fmt::format("cannot read \"{}\": {}", first.string(), std::strerror(ENOENT)));
}

std::string read_bytes(const std::string& path) {
  if (fs::is_directory(path)) throw std::runtime_error(std::strerror(EISDIR));
  errno = 0;
  const std::unique_ptr<gzFile_s, CloseGzip> file(gzopen(path.c_str(), "rb"));
  if (!file) throw std::runtime_error(std::strerror(errno != 0 ? errno : ENOMEM));
  gzbuffer(file.get(), 1 << 17);
  std::string bytes;
  constexpr size_t block = 1 << 20;
  for (;;) {
    const size_t size = bytes.size();
    if (size > max_file_size) throw std::runtime_error("it is larger than 2 GiB");
    bytes.resize(size + block);
    const int count = gzread(file.get(), bytes.data() + size, block);
    int status = Z_OK;
    const char* words = gzerror(file.get(), &status);
    if (count < 0 || (count == 0 && status == Z_BUF_ERROR))
      throw std::runtime_error(status == Z_ERRNO       ? std::strerror(errno)
                               : status == Z_BUF_ERROR ? "the gzip data ends too early"
                                                       : words);
    bytes.resize(size + static_cast<size_t>(count));
    if (count == 0) break;
  }
  bytes.shrink_to_fit();
  return bytes;
}

std::string read_text(const std::string& path) {
  std::string text = read_bytes(path);
  if (text.find('\0') != text.npos) throw std::runtime_error("it is not a text file");
  return text;
}

}  // namespace tyndall::loader

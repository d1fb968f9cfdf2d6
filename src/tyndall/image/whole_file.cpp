// SPDX-License-Identifier: Apache-2.0
#include "tyndall/image/whole_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace tyndall {
namespace {

[[noreturn]] void fail(const std::string& path, const char* action, int error) {
  throw std::runtime_error(fmt::format("{}: cannot {}: {}", path, action,
                                       std::generic_category().message(error)));
}

/// An open file that is closed at the end of the scope.
class File {
 public:
  explicit File(int descriptor) : descriptor_(descriptor) {}
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }

  bool is_open() const { return descriptor_ >= 0; }
  int get() const { return descriptor_; }
  /// Closes now and tells whether the system accepted all data.
  bool close() { return ::close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_;
};

/// Pipes and devices cannot be replaced by a file: what is written goes into them.
bool is_pipe_or_device(const std::string& path) {
  struct stat status;
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

std::string temporary_name(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  return fmt::format("{}.{}-{}.tmp", path, ::getpid(), counter++);
}

/// Precondition: the name does not exist yet.
File create(const std::string& name) {
  return File(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
}

void check_is_no_folder(const std::string& path) {
  struct stat status;
  if (::stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode)) {
    fail(path, "write", EISDIR);
  }
}

bool write_all(const File& file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) bytes.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

}  // namespace

std::string follow_links(const std::string& path) {
  constexpr int most_links = 40;  // as Linux allows
  std::filesystem::path end = path;
  for (int i = 0; i <= most_links; ++i) {
    std::error_code error;
    const std::filesystem::path target = std::filesystem::read_symlink(end, error);
    if (error) return end.string();
    end = end.parent_path() / target;
  }
  fail(path, "write", ELOOP);
}

std::string read_whole_file(const std::string& path) {
  const File file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open()) fail(path, "read", errno);
  std::string bytes;
  for (;;) {
    const size_t size = bytes.size();
    const size_t room = std::max<size_t>(size, 1 << 16);
    bytes.resize(size + room);
    const ssize_t got = ::read(file.get(), bytes.data() + size, room);
    if (got < 0 && errno != EINTR) fail(path, "read", errno);
    bytes.resize(size + static_cast<size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return bytes;
  }
}

void write_whole_file(const std::string& path, std::string_view bytes) {
  check_is_no_folder(path);
  if (is_pipe_or_device(path)) {
    File file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!file.is_open() || !write_all(file, bytes) || !file.close())
      fail(path, "write", errno);
    return;
  }
  const std::string end = follow_links(path);
  const std::string temporary = temporary_name(end);
  File file = create(temporary);
  if (!file.is_open()) fail(path, "write", errno);
  if (!write_all(file, bytes) || !file.close() ||
      ::rename(temporary.c_str(), end.c_str()) != 0) {
    const int error = errno;
    ::unlink(temporary.c_str());
    fail(path, "write", error);
  }
}

void check_can_write_file(const std::string& path) {
  check_is_no_folder(path);
  if (is_pipe_or_device(path)) {
    if (::access(path.c_str(), W_OK) != 0) fail(path, "write", errno);
    return;
  }
  const std::string temporary = temporary_name(follow_links(path));
  const File file = create(temporary);
  if (!file.is_open()) fail(path, "write", errno);
  ::unlink(temporary.c_str());
}

}  // namespace tyndall

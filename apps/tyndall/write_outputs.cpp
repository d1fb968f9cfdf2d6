// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/write_outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "apps/tyndall/exit_code.h"
#include "tyndall/image/whole_file.h"

namespace tyndall::app {

namespace {

/// Saves what could not be written where it should go; returns a sentence about it.
std::string rescue(const Image& image) {
  try {
    const std::filesystem::path folder = std::filesystem::temp_directory_path();
    const std::string path = folder / fmt::format("tyndall-{}.exr", getpid());
    write_image(image, path);
    return "the image is saved as " + path;
  } catch (const std::exception& error) {
    return fmt::format("saving it elsewhere failed too: {}", error.what());
  }
}

/// The only spelling of a path that need not exist.
std::filesystem::path canonical(const std::string& path) {
  std::error_code error;
  const auto absolute = std::filesystem::absolute(follow_links(path));
  const auto result = std::filesystem::weakly_canonical(absolute, error);
  return error ? absolute : result;
}

}  // namespace

void check_distinct(const std::vector<std::string>& paths) {
  std::map<std::filesystem::path, std::string> seen;
  for (const std::string& path : paths) {
    const auto [other, is_new] = seen.emplace(canonical(path), path);
    if (!is_new)
      throw UsageError(
          fmt::format("{} and {} are the same file: one would overwrite the other",
                      other->second, path));
  }
}

void check_outputs(const std::vector<std::string>& paths) {
  for (const std::string& path : paths) {
    try {
      check_writable(path);
    } catch (const std::runtime_error& error) {
      throw OutputError(error.what());
    }
  }
}

void write_outputs(const Image& image, const std::vector<std::string>& paths,
                   const WriteOptions& options) {
  std::string failures;
  for (const std::string& path : paths) {
    try {
      write_image(image, path, options);
    } catch (const std::runtime_error& error) {
      failures += (failures.empty() ? "" : "; ") + std::string(error.what());
    }
  }
  if (!failures.empty()) throw OutputError(fmt::format("{}; {}", failures, rescue(image)));
}

void check_bytes_writable(const std::string& path) {
  try {
    check_can_write_file(path);
  } catch (const std::runtime_error& error) {
    throw OutputError(error.what());
  }
}

void write_bytes(std::span<const std::byte> bytes, const std::string& path) {
  try {
    write_whole_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  } catch (const std::runtime_error& error) {
    throw OutputError(error.what());
  }
}

}  // namespace tyndall::app

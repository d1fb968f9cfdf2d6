// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "tyndall/loader/source_library.h"

namespace tyndall::loader {

/// Finds the files that a scene names.
class FileFinder {
 public:
  /// `scene_path` is the scene file; its folder is where relative names start.
  FileFinder(const std::string& scene_path, const SourceLibrary& sources);

  /// The path of `name`: from the scene's folder or, if it is not there, from the folder of
  /// the file that names it. Throws Failure at `where` if there is no such file.
  std::string find(const std::string& name, Span where) const;

 private:
  const SourceLibrary& sources_;
  std::string folder_;
};

/// The largest file that the loader reads, after decompression [bytes].
inline constexpr size_t max_file_size = size_t{2} << 30;

/// All bytes of a file, decompressed if it is in gzip format. Throws std::runtime_error
/// with the system's or zlib's words, without the path.
std::string read_bytes(const std::string& path);

/// The same for a scene file; throws too if it is not a text.
std::string read_text(const std::string& path);

}  // namespace tyndall::loader

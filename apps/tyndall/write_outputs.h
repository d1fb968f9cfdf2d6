// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "tyndall/image/io.h"

namespace tyndall::app {

/// Throws std::invalid_argument if a name has no extension of an image file, OutputError if
/// one of the files could not be written. Leaves nothing behind.
void check_outputs(const std::vector<std::string>& paths);

/// Throws UsageError if two paths lead to the same file, however they are spelled.
void check_distinct(const std::vector<std::string>& paths);

/// Writes all the files. If one fails, the image goes as EXR to the folder of temporary
/// files instead, the others are still written, and OutputError tells all that.
void write_outputs(const Image& image, const std::vector<std::string>& paths,
                   const WriteOptions& options);

/// The same for a file that is no image. Both throw OutputError.
void check_bytes_writable(const std::string& path);
void write_bytes(std::span<const std::byte> bytes, const std::string& path);

}  // namespace tyndall::app

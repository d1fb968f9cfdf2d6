// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tyndall/image/image.h"
#include "tyndall/image/tone.h"

namespace tyndall {

struct WriteOptions {
  bool half = false;  ///< EXR: 16-bit channels (depth, spp and variance stay float)
  /// EXR: how many threads compress; 0: as many as the caller's oneTBB arena has. The bytes
  /// are the same. Other than one gives OpenEXR's pool, which the whole process shares, as
  /// many threads if it has fewer; then no other image may be read or written meanwhile.
  int threads = 1;
  ToneMapping tone = {};  ///< PNG
};

/// Reads EXR (any layers, tiled or scanline, luminance-chroma too), PNG (sRGB to linear),
/// PFM or HDR by the file's first bytes. Grey images give equal R, G and B; of an EXR of
/// several parts the first is read. Throws std::runtime_error with the path and the reason.
Image read_image(const std::string& path);

/// Writes by the extension: .exr, .hdr, .pfm or .png; only .exr keeps more than R, G, B.
/// Writes to a temporary name first and renames, so that an interrupted write never
/// destroys an older file. Throws std::invalid_argument for any other extension,
/// std::runtime_error if the file cannot be written.
void write_image(const Image& image, const std::string& path,
                 const WriteOptions& options = {});

/// Throws what write_image() would throw for an unknown extension, for want of a folder or
/// of permission. Leaves no file behind.
void check_writable(const std::string& path);

}  // namespace tyndall

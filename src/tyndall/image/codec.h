// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "tyndall/image/image.h"
#include "tyndall/image/tone.h"

/// One pair of functions per file format, from bytes to image and back; io.h chooses among
/// them. They throw std::runtime_error without the path, which they do not know.
namespace tyndall {

Image decode_exr(std::string_view bytes);
/// `threads` as in WriteOptions.
std::string encode_exr(const Image& image, bool half, int threads);

/// 8-bit samples are decoded from sRGB, 16-bit ones as the file says; alpha is "A",
/// straight.
Image decode_png(std::string_view bytes);
std::string encode_png(const Image& image, const ToneMapping& tone);

/// Portable float map: "PF" (colour) or "Pf" (grey), either byte order.
Image decode_pfm(std::string_view bytes);
std::string encode_pfm(const Image& image);

/// Radiance RGBE, run-length coded or flat; exposure lines are applied.
Image decode_hdr(std::string_view bytes);
std::string encode_hdr(const Image& image);

/// Throws unless 1 <= width, height and the pixels are few enough to hold (2^28).
void check_image_size(int64_t width, int64_t height);

}  // namespace tyndall

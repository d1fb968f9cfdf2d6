// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/inspect/pixel_font.h"

#include <array>
#include <cctype>
#include <cstdint>

namespace tyndall::app {
namespace {

struct Glyph {
  char letter;
  uint64_t rows;  // seven of five pixels, the first row in the highest bits
};

constexpr std::array glyphs = std::to_array<Glyph>({
    {' ', 0x000000000}, {'%', 0x672222273}, {'(', 0x088842082}, {')', 0x208210888},
    {'+', 0x0084f9080}, {',', 0x000001088}, {'-', 0x000070000}, {'.', 0x00000018c},
    {'/', 0x044222110}, {'0', 0x3a33ae62e}, {'1', 0x11842108e}, {'2', 0x3a213221f},
    {'3', 0x3a213062e}, {'4', 0x08ca97c42}, {'5', 0x7e1e0862e}, {'6', 0x1910f462e},
    {'7', 0x7c2221108}, {'8', 0x3a317462e}, {'9', 0x3a317844c}, {':', 0x008000080},
    {'=', 0x001f07c00}, {'[', 0x39084210e}, {']', 0x38421084e}, {'a', 0x000e0be2f},
    {'b', 0x421e8c63e}, {'c', 0x000e8c22e}, {'d', 0x042f8c62f}, {'e', 0x000e8fe0e},
    {'f', 0x191e42108}, {'g', 0x01f18bc2e}, {'h', 0x421e8c631}, {'i', 0x100c2108e},
    {'j', 0x08061084c}, {'k', 0x4212a6292}, {'l', 0x30842108e}, {'m', 0x001aad6b5},
    {'n', 0x001e8c631}, {'o', 0x000e8c62e}, {'p', 0x03d18fa10}, {'q', 0x01f18bc21},
    {'r', 0x0016cc210}, {'s', 0x000f8383e}, {'t', 0x211e42106}, {'u', 0x00118c66d},
    {'v', 0x00118c544}, {'w', 0x0011ad6aa}, {'x', 0x001151151}, {'y', 0x023151110},
    {'z', 0x001f1111f},
});

uint64_t rows_of(char letter) {
  for (const Glyph& glyph : glyphs)
    if (glyph.letter == letter) return glyph.rows;
  return 0;
}

}  // namespace

void draw_text(Image& image, int x, int y, std::string_view text, Rgb color) {
  for (const char c : text) {
    const uint64_t rows =
        rows_of(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
    for (int i = 0; i < 35; ++i) {
      const int px = x + i % 5, py = y + i / 5;
      const bool is_inside =
          px >= 0 && py >= 0 && px < image.width() && py < image.height();
      if (is_inside && (rows >> (34 - i) & 1) != 0) image.set_rgb(px, py, color);
    }
    x += letter_width;
  }
}

}  // namespace tyndall::app

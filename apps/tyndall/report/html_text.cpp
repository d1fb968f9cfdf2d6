// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/report/html_text.h"

#include <cstdint>

namespace tyndall::app {

std::string escape_html(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string base64(std::string_view bytes) {
  constexpr const char* digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string result;
  result.reserve((bytes.size() + 2) / 3 * 4);
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k) {
      const auto byte =
          i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : uint8_t{0};
      group = group << 8 | byte;
    }
    for (size_t k = 0; k < 4; ++k) {
      const bool is_padding = i + k > bytes.size();
      result += is_padding ? '=' : digits[(group >> (18 - 6 * k)) & 63];
    }
  }
  return result;
}

std::string png_url(std::string_view png) { return "data:image/png;base64," + base64(png); }

}  // namespace tyndall::app

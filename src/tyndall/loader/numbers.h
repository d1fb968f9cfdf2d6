// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cmath>
#include <string_view>

namespace tyndall::loader {

enum class NumberError { none, malformed, too_large };

/// Reads all of `text` as a decimal number. What is too small becomes zero; "inf" and "nan"
/// are malformed, as in pbrt-v4.
inline NumberError parse_number(std::string_view text, float& value) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (text.size() == 1 && '0' <= *begin && *begin <= '9') {
    value = static_cast<float>(*begin - '0');
    return NumberError::none;
  }
  if (begin != end && *begin == '+') ++begin;
  const char* first = begin;
  if (first != end && *first == '-' && first == text.data()) ++first;
  if (first == end || !(('0' <= *first && *first <= '9') || *first == '.'))
    return NumberError::malformed;
  const std::from_chars_result result = std::from_chars(begin, end, value);
  if (result.ptr != end || result.ec == std::errc::invalid_argument)
    return NumberError::malformed;
  if (result.ec == std::errc{}) return NumberError::none;
  double wide = 0;  // out of range for float: huge, or so small that it is zero
  if (std::from_chars(begin, end, wide).ec != std::errc{}) {
    const bool is_tiny = text.find("e-") != text.npos || text.find("E-") != text.npos;
    if (!is_tiny) return NumberError::too_large;
    wide = 0;
  }
  if (std::abs(wide) > 1) return NumberError::too_large;
  value = static_cast<float>(wide);
  return NumberError::none;
}

/// The same to double precision, for numbers that a float could hold.
inline NumberError parse_number(std::string_view text, double& value) {
  float rounded = 0;
  const NumberError error = parse_number(text, rounded);
  value = static_cast<double>(rounded);
  if (error != NumberError::none || rounded == 0) return error;
  if (text.front() == '+') text.remove_prefix(1);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return NumberError::none;
}

/// Reads all of `text` as a 32-bit integer.
inline NumberError parse_number(std::string_view text, int& value) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (text.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;
  const std::from_chars_result result = std::from_chars(begin, end, value);
  if (result.ptr != end || result.ec == std::errc::invalid_argument)
    return NumberError::malformed;
  return result.ec == std::errc{} ? NumberError::none : NumberError::too_large;
}

}  // namespace tyndall::loader

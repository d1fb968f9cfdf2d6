// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/parse_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace tyndall::app {

namespace {

[[noreturn]] void reject(const std::string& expected, const std::string& text) {
  throw std::invalid_argument(fmt::format("must be {}, got '{}'", expected, text));
}

template <typename Number>
[[noreturn]] void reject_whole_number(const std::string& text, Number min, Number max) {
  reject(fmt::format("a whole number from {} to {}", min, max), text);
}

/// Empty unless the whole text is one finite number in the range of its type.
template <typename Number>
std::optional<Number> to_number(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || parsed != end) return std::nullopt;
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(value)) return std::nullopt;
  return value;
}

/// The texts between commas.
std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// `count` numbers between separators, or empty.
template <typename Number>
std::optional<std::vector<Number>> to_numbers(const std::string& text, char separator,
                                              size_t count) {
  std::vector<Number> numbers;
  for (const std::string& part : split(text, separator)) {
    const std::optional<Number> number = to_number<Number>(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  if (numbers.size() != count) return std::nullopt;
  return numbers;
}

double seconds_of_unit(char unit) {
  switch (unit) {
    case 's':
      return 1;
    case 'm':
      return 60;
    case 'h':
      return 3600;
    default:
      return 0;
  }
}

}  // namespace

template <typename Number>
Number parse_number(const std::string& text) {
  if (const std::optional<Number> number = to_number<Number>(text)) return *number;
  if (std::is_floating_point_v<Number>) reject("a number", text);
  reject_whole_number(text, std::numeric_limits<Number>::min(),
                      std::numeric_limits<Number>::max());
}

template int parse_number<int>(const std::string&);
template uint32_t parse_number<uint32_t>(const std::string&);
template uint64_t parse_number<uint64_t>(const std::string&);
template float parse_number<float>(const std::string&);
template double parse_number<double>(const std::string&);

template <typename Number>
Number parse_whole_number(const std::string& text, Number min, Number max) {
  const std::optional<Number> number = to_number<Number>(text);
  if (!number || *number < min || *number > max) reject_whole_number(text, min, max);
  return *number;
}

template int parse_whole_number<int>(const std::string&, int, int);
template uint32_t parse_whole_number<uint32_t>(const std::string&, uint32_t, uint32_t);

int parse_threads(const std::string& text) { return parse_whole_number(text, 0, 4096); }

int parse_depth(const std::string& text) { return parse_whole_number(text, 0); }

double parse_duration(const std::string& text) {
  const std::string expected = "a positive time such as 30s, 10m or 1h30m";
  std::optional<double> total = to_number<double>(text);
  if (!total) {
    total = 0;
    std::string number;
    for (const char c : text) {
      if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
        number += c;
        continue;
      }
      const std::optional<double> value = to_number<double>(number);
      if (!value || seconds_of_unit(c) == 0) reject(expected, text);
      *total += *value * seconds_of_unit(c);
      number.clear();
    }
    if (!number.empty()) reject(expected, text);
  }
  if (!(*total > 0)) reject(expected, text);
  return *total;
}

Vec2i parse_size(const std::string& text) {
  const auto sides = to_numbers<int>(text, 'x', 2);
  if (!sides || (*sides)[0] < 1 || (*sides)[1] < 1)
    reject("a width and a height of at least 1, such as 640x360", text);
  return {(*sides)[0], (*sides)[1]};
}

std::pair<Vec2i, Vec2i> CropWindow::pixels(Vec2i size) const {
  const auto to_pixel = [this](float value, int side) {
    const float scaled = is_fraction ? std::ceil(value * static_cast<float>(side)) : value;
    return static_cast<int>(std::clamp(scaled, 0.0f, static_cast<float>(side)));
  };
  return {{to_pixel(x0, size.x), to_pixel(y0, size.y)},
          {to_pixel(x1, size.x), to_pixel(y1, size.y)}};
}

CropWindow parse_crop(const std::string& text) {
  const std::string expected =
      "x0,y0,x1,y1 with 0 <= x0 < x1 and 0 <= y0 < y1, in pixels or, up to 1, in fractions";
  const auto v = to_numbers<float>(text, ',', 4);
  if (!v) reject(expected, text);
  CropWindow crop{.x0 = (*v)[0], .y0 = (*v)[1], .x1 = (*v)[2], .y1 = (*v)[3]};
  if (!(crop.x0 >= 0 && crop.y0 >= 0 && crop.x0 < crop.x1 && crop.y0 < crop.y1))
    reject(expected, text);
  crop.is_fraction = crop.x1 <= 1 && crop.y1 <= 1;
  return crop;
}

Vec2i parse_pixel(const std::string& text) {
  const auto v = to_numbers<int>(text, ',', 2);
  if (!v || (*v)[0] < 0 || (*v)[1] < 0)
    reject("a pixel x,y counted from the top left", text);
  return {(*v)[0], (*v)[1]};
}

ScatteringOrders parse_orders(const std::string& text) {
  const size_t count = text.find('-') == std::string::npos ? 1 : 2;
  const auto v = to_numbers<int>(text, '-', count);
  if (!v || v->front() < 0 || v->front() > v->back())
    reject("a number of scattering events or a range, such as 2 or 1-2", text);
  return {.min = v->front(), .max = v->back()};
}

std::pair<std::string, std::string> parse_assignment(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) reject("name=value", text);
  return {text.substr(0, equals), text.substr(equals + 1)};
}

}  // namespace tyndall::app

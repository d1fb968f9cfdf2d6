// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/parse_values.h"

#include <gtest/gtest.h>

namespace tyndall::app {
namespace {

/// The message with which `parse` refuses a text, or "accepted".
template <typename Parse>
std::string refusal(Parse parse, const std::string& text) {
  try {
    parse(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ParseNumber, TakesTheWholeTextOnly) {
  EXPECT_EQ(parse_number<int>("-12"), -12);
  EXPECT_EQ(parse_number<uint64_t>("18446744073709551615"), UINT64_MAX);
  EXPECT_FLOAT_EQ(parse_number<float>("1.5e-3"), 1.5e-3f);
  EXPECT_EQ(refusal(parse_number<uint32_t>, "12x"),
            "must be a whole number from 0 to 4294967295, got '12x'");
  EXPECT_EQ(refusal(parse_number<uint32_t>, "-1"),
            "must be a whole number from 0 to 4294967295, got '-1'");
  EXPECT_EQ(refusal(parse_number<uint32_t>, "4294967296"),
            "must be a whole number from 0 to 4294967295, got '4294967296'");
  EXPECT_EQ(refusal(parse_number<float>, ""), "must be a number, got ''");
  EXPECT_EQ(refusal(parse_number<float>, "nan"), "must be a number, got 'nan'");
  EXPECT_EQ(refusal(parse_number<float>, "1e99"), "must be a number, got '1e99'");
}

TEST(ParseWholeNumber, SaysItsRange) {
  const auto at_least_one = [](const std::string& text) {
    return parse_whole_number(text, uint32_t{1});
  };
  EXPECT_EQ(at_least_one("1"), 1u);
  EXPECT_EQ(at_least_one("4294967295"), 4294967295u);
  for (const std::string text : {"0", "x", "-1", "1.5", "", "4294967296"})
    EXPECT_EQ(refusal(at_least_one, text),
              "must be a whole number from 1 to 4294967295, got '" + text + "'");
  EXPECT_EQ(parse_threads("4096"), 4096);
  for (const std::string text : {"-1", "4097", "all"})
    EXPECT_EQ(refusal(parse_threads, text),
              "must be a whole number from 0 to 4096, got '" + text + "'");
  EXPECT_EQ(parse_depth("0"), 0);
  EXPECT_EQ(refusal(parse_depth, "-1"),
            "must be a whole number from 0 to 2147483647, got '-1'");
}

TEST(ParseDuration, AddsUnits) {
  EXPECT_DOUBLE_EQ(parse_duration("30s"), 30);
  EXPECT_DOUBLE_EQ(parse_duration("10m"), 600);
  EXPECT_DOUBLE_EQ(parse_duration("1.5h"), 5400);
  EXPECT_DOUBLE_EQ(parse_duration("1h30m5s"), 5405);
  EXPECT_DOUBLE_EQ(parse_duration("0.25"), 0.25);
}

TEST(ParseDuration, RefusesTheRest) {
  for (const std::string text : {"", "0", "-3", "m", "5x", "1m30", "10 m", "inf", "1e400s"})
    EXPECT_EQ(refusal(parse_duration, text),
              "must be a positive time such as 30s, 10m or 1h30m, got '" + text + "'");
}

TEST(ParseSize, NeedsTwoPositiveSides) {
  EXPECT_EQ(parse_size("640x360"), (Vec2i{640, 360}));
  for (const std::string text :
       {"0x0", "640", "640x", "x360", "-1x5", "640x360x2", "1e3x2"})
    EXPECT_EQ(
        refusal(parse_size, text),
        "must be a width and a height of at least 1, such as 640x360, got '" + text + "'");
}

TEST(ParseCrop, PixelsWhereAValueIsAboveOne) {
  const auto [min, max] = parse_crop("10,20,30,45").pixels({100, 50});
  EXPECT_EQ(min, (Vec2i{10, 20}));
  EXPECT_EQ(max, (Vec2i{30, 45}));
}

TEST(ParseCrop, FractionsRoundUpAtBothEndsAsInPbrt) {
  const auto [min, max] = parse_crop("0,0.5,0.334,1").pixels({3, 5});
  EXPECT_EQ(min, (Vec2i{0, 3}));
  EXPECT_EQ(max, (Vec2i{2, 5}));
}

TEST(ParseCrop, EndsAtThePicture) {
  const auto [min, max] = parse_crop("10,10,1e9,1e9").pixels({64, 32});
  EXPECT_EQ(min, (Vec2i{10, 10}));
  EXPECT_EQ(max, (Vec2i{64, 32}));
}

TEST(ParseCrop, RefusesEmptyWindows) {
  for (const std::string text :
       {"1,2,3", "0,0,0,1", "5,5,4,6", "-1,0,1,1", "a,b,c,d", "0,0,nan,1"})
    EXPECT_EQ(
        refusal(parse_crop, text),
        "must be x0,y0,x1,y1 with 0 <= x0 < x1 and 0 <= y0 < y1, in pixels or, up to 1, in "
        "fractions, got '" +
            text + "'");
}

TEST(ParsePixel, CountsFromTheTopLeft) {
  EXPECT_EQ(parse_pixel("3,0"), (Vec2i{3, 0}));
  EXPECT_EQ(refusal(parse_pixel, "3,-1"),
            "must be a pixel x,y counted from the top left, got '3,-1'");
  EXPECT_EQ(refusal(parse_pixel, "3"),
            "must be a pixel x,y counted from the top left, got '3'");
}

TEST(ParseOrders, OneOrARange) {
  EXPECT_EQ(parse_orders("2").min, 2);
  EXPECT_EQ(parse_orders("2").max, 2);
  EXPECT_EQ(parse_orders("1-2").min, 1);
  EXPECT_EQ(parse_orders("1-2").max, 2);
  for (const std::string text : {"2-1", "", "-1", "1-", "one", "1-2-3"})
    EXPECT_EQ(refusal(parse_orders, text),
              "must be a number of scattering events or a range, such as 2 or 1-2, got '" +
                  text + "'");
}

TEST(ParseAssignment, SplitsAtTheFirstEqualsSign) {
  EXPECT_EQ(parse_assignment("a.b=c=d"),
            (std::pair<std::string, std::string>{"a.b", "c=d"}));
  EXPECT_EQ(parse_assignment("a="), (std::pair<std::string, std::string>{"a", ""}));
  EXPECT_EQ(refusal(parse_assignment, "a"), "must be name=value, got 'a'");
  EXPECT_EQ(refusal(parse_assignment, "=b"), "must be name=value, got '=b'");
}

}  // namespace
}  // namespace tyndall::app

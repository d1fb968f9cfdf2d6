// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/progress.h"

#include <gtest/gtest.h>

#include <limits>

namespace tyndall::app {
namespace {

RenderProgress at(double fraction) {
  return {.fraction = fraction,
          .seconds = 12.04,
          .seconds_remaining = 75,
          .samples = 64,
          .phase = "rendering"};
}

/// What a printer writes for progress in 1000 equal steps.
std::string written(ProgressStyle style) {
  std::FILE* file = std::tmpfile();
  ProgressPrinter printer(style, file, false);
  for (int i = 0; i <= 1000; ++i) printer.update(at(i / 1000.0));
  printer.finish();
  std::rewind(file);
  std::string text;
  for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file))
    text += static_cast<char>(c);
  std::fclose(file);
  return text;
}

std::ptrdiff_t line_count(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST(FormatSeconds, ChoosesItsUnit) {
  EXPECT_EQ(format_seconds(8.26), "8.3 s");
  EXPECT_EQ(format_seconds(59.94), "59.9 s");
  EXPECT_EQ(format_seconds(59.96), "1:00");
  EXPECT_EQ(format_seconds(3599.4), "59:59");
  EXPECT_EQ(format_seconds(3600 + 2 * 60 + 45), "1:02:45");
}

TEST(ProgressStyle, IsABarOnTerminalsOnly) {
  EXPECT_EQ(choose_progress_style("auto", true), ProgressStyle::bar);
  EXPECT_EQ(choose_progress_style("auto", false), ProgressStyle::line);
  EXPECT_EQ(choose_progress_style("farm", true), ProgressStyle::farm);
  EXPECT_EQ(choose_progress_style("bar", false), ProgressStyle::bar);
  EXPECT_EQ(choose_progress_style("none", true), ProgressStyle::none);
}

TEST(ProgressBar, FillsWithTheFraction) {
  EXPECT_EQ(format_progress_bar(at(0.5), 60),
            "rendering [######-------]  50 %     64 spp  12.0 s  ETA 1:15");
}

TEST(ProgressBar, NeverExceedsTheTerminal) {
  for (int width = 0; width < 200; ++width)
    EXPECT_LE(format_progress_bar(at(0.37), width).size(), static_cast<size_t>(width));
}

TEST(ProgressLine, SaysHowFarAndHowLong) {
  EXPECT_EQ(format_progress_line(at(0.999)), "rendering: 99 %, 64 spp, 12.0 s, ETA 1:15");
}

TEST(ProgressLine, LeavesOutAnUnknownEnd) {
  RenderProgress progress = at(0);
  progress.seconds_remaining = std::numeric_limits<double>::infinity();
  EXPECT_EQ(format_progress_line(progress), "rendering: 0 %, 64 spp, 12.0 s");
}

TEST(ProgressPrinter, WritesOneLineForEveryFivePercent) {
  const std::string text = written(ProgressStyle::line);
  EXPECT_EQ(line_count(text), 21);
  EXPECT_NE(text.find("rendering: 45 %, "), std::string::npos);
  EXPECT_NE(text.find("rendering: 100 %, "), std::string::npos);
  EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(ProgressPrinter, WritesWhatFarmsRead) {
  const std::string text = written(ProgressStyle::farm);
  EXPECT_EQ(line_count(text), 101);
  EXPECT_EQ(text.substr(0, 32), "ALF_PROGRESS 0%\nALF_PROGRESS 1%\n");
}

TEST(ProgressPrinter, ClearsItsBar) {
  const std::string text = written(ProgressStyle::bar);
  EXPECT_EQ(line_count(text), 0);
  EXPECT_EQ(text.substr(text.size() - 4), "\r\033[K");
  EXPECT_EQ(written(ProgressStyle::none), "");
}

}  // namespace
}  // namespace tyndall::app

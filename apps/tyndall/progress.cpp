// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace tyndall::app {

namespace {

int percent(const RenderProgress& progress) {
  // Never 100 before the end: rounding down.
  return static_cast<int>(std::floor(std::clamp(progress.fraction, 0.0, 1.0) * 100 + 1e-9));
}

/// "ETA 0:12", or nothing as long as nobody knows and at the end.
std::string format_eta(double seconds_remaining) {
  if (!std::isfinite(seconds_remaining) || seconds_remaining <= 0) return "";
  return "ETA " + format_seconds(seconds_remaining);
}

int terminal_width(std::FILE* stream) {
  winsize size = {};
  if (ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace

ProgressStyle choose_progress_style(const std::string& name, bool is_terminal) {
  if (name == "bar") return ProgressStyle::bar;
  if (name == "line") return ProgressStyle::line;
  if (name == "farm") return ProgressStyle::farm;
  if (name == "none") return ProgressStyle::none;
  return is_terminal ? ProgressStyle::bar : ProgressStyle::line;
}

std::string format_seconds(double seconds) {
  if (seconds < 59.95) return fmt::format("{:.1f} s", std::max(seconds, 0.0));
  const auto whole = static_cast<long long>(std::llround(std::min(seconds, 1e9)));
  const long long hours = whole / 3600, minutes = whole / 60 % 60, rest = whole % 60;
  if (hours == 0) return fmt::format("{}:{:02}", minutes, rest);
  return fmt::format("{}:{:02}:{:02}", hours, minutes, rest);
}

std::string format_progress_bar(const RenderProgress& progress, int width) {
  const std::string tail =
      fmt::format("] {:3} %  {:5} spp  {}  {}", percent(progress), progress.samples,
                  format_seconds(progress.seconds), format_eta(progress.seconds_remaining));
  const std::string head = progress.phase + " [";
  const int room = std::min(width - static_cast<int>(head.size() + tail.size()), 50);
  if (room < 5)
    return format_progress_line(progress).substr(0,
                                                 static_cast<size_t>(std::max(width, 0)));
  const int filled = room * percent(progress) / 100;
  return head + std::string(static_cast<size_t>(filled), '#') +
         std::string(static_cast<size_t>(room - filled), '-') + tail;
}

std::string format_progress_line(const RenderProgress& progress) {
  const std::string eta = format_eta(progress.seconds_remaining);
  return fmt::format("{}: {} %, {} spp, {}{}{}", progress.phase, percent(progress),
                     progress.samples, format_seconds(progress.seconds),
                     eta.empty() ? "" : ", ", eta);
}

ProgressPrinter::ProgressPrinter(ProgressStyle style, std::FILE* stream, bool use_color)
    : style_(style), stream_(stream), use_color_(use_color) {}

void ProgressPrinter::update(const RenderProgress& progress) {
  if (style_ == ProgressStyle::none) return;
  if (style_ == ProgressStyle::bar) return draw_bar(progress);
  const int step = percent(progress) / (style_ == ProgressStyle::line ? 5 : 1);
  if (step == last_step_ && progress.phase == last_phase_) return;
  last_step_ = step;
  last_phase_ = progress.phase;
  if (style_ == ProgressStyle::line)
    fmt::print(stream_, "{}\n", format_progress_line(progress));
  else
    fmt::print(stream_, "ALF_PROGRESS {}%\n", percent(progress));
  std::fflush(stream_);
}

void ProgressPrinter::finish() {
  if (!bar_is_shown_) return;
  fmt::print(stream_, "\r\033[K");
  std::fflush(stream_);
  bar_is_shown_ = false;
}

void ProgressPrinter::draw_bar(const RenderProgress& progress) {
  std::string text = format_progress_bar(progress, terminal_width(stream_) - 1);
  if (use_color_) {
    const size_t begin = text.find('#'), end = text.find_last_of('#');
    if (begin != std::string::npos) {
      text.insert(end + 1, "\033[0m");
      text.insert(begin, "\033[36m");
    }
  }
  fmt::print(stream_, "\r{}\033[K", text);
  std::fflush(stream_);
  bar_is_shown_ = true;
}

}  // namespace tyndall::app

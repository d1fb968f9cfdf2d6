// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

#include "tyndall/integrators/render.h"

namespace tyndall::app {

/// How progress is shown.
enum class ProgressStyle {
  none,
  bar,   ///< one line that is drawn over
  line,  ///< one line for every 5 %
  farm,  ///< "ALF_PROGRESS 45%", which render farms read
};

/// "auto" (a bar on a terminal, lines elsewhere), "bar", "line", "farm" or "none".
ProgressStyle choose_progress_style(const std::string& name, bool is_terminal);

/// "8.3 s", "12:05", "1:02:45" for times below a minute, an hour, and above.
std::string format_seconds(double seconds);

/// "rendering [#####-----]  50 %   64 spp  0:12  ETA 0:12" in at most `width` characters.
std::string format_progress_bar(const RenderProgress& progress, int width);
/// "rendering: 50 %, 64 spp, 12.0 s, ETA 12.1 s"
std::string format_progress_line(const RenderProgress& progress);

/// Writes progress to a stream as it comes.
class ProgressPrinter {
 public:
  /// `use_color` allows escape sequences for color in the bar.
  ProgressPrinter(ProgressStyle style, std::FILE* stream, bool use_color);

  void update(const RenderProgress& progress);
  /// Clears the bar, so that other text may follow.
  void finish();

 private:
  void draw_bar(const RenderProgress& progress);

  ProgressStyle style_;
  std::FILE* stream_;
  bool use_color_;
  bool bar_is_shown_ = false;
  int last_step_ = -1;  // of 5 % in line style, of 1 % in farm style
  std::string last_phase_;
};

}  // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/commands.h"
#include "apps/tyndall/crash_report.h"
#include "apps/tyndall/version.h"

int main(int argc, char** argv) {
  using namespace tyndall::app;
  report_crashes_in_volumes();
  Program program("tyndall", "A path tracer for light in fog, smoke and clouds.",
                  version_text());
  add_render_command(program);
  add_compare_command(program);
  add_convert_command(program);
  add_bench_command(program);
  add_report_command(program);
  add_info_command(program);
  add_inspect_command(program);
  return static_cast<int>(program.run(argc, argv));
}

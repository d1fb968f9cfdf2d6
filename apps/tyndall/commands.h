// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tyndall/arguments.h"

/// The subcommands: each in a file of its own, <name>_command.cpp, which declares its
/// arguments through Command and hands over what to run. To add one: the file, a line here,
/// a line in main.cpp and in CMakeLists.txt.
namespace tyndall::app {

void add_bench_command(Program& program);
void add_compare_command(Program& program);
void add_convert_command(Program& program);
void add_info_command(Program& program);
void add_inspect_command(Program& program);
void add_render_command(Program& program);
void add_report_command(Program& program);

}  // namespace tyndall::app

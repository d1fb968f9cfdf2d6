// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tyndall::app {

/// From now on, a crash while a volume file is read ends the program with a message that
/// names the file and ExitCode::scene; other crashes end it as before. The libraries that
/// read such files crash on some damaged ones.
void report_crashes_in_volumes();

}  // namespace tyndall::app

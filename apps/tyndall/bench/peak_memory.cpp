// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/bench/peak_memory.h"

#include <fstream>
#include <string>

namespace tyndall::app {

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << "5"; }

std::optional<double> peak_memory_since_reset() {
  std::ifstream status("/proc/self/status");
  for (std::string name; status >> name;) {
    double kibibytes = 0;
    if (name == "VmHWM:" && status >> kibibytes) return 1024 * kibibytes;
  }
  return std::nullopt;
}

}  // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/bench/build_info.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <fstream>
#include <thread>

#include "apps/tyndall/version.h"
#include "build_commit.h"

namespace tyndall::app {

namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return "unknown processor";
}

std::string system_name() {
  utsname names{};
  if (uname(&names) != 0) return "unknown system";
  return fmt::format("{} {} {}", names.sysname, names.release, names.machine);
}

}  // namespace

std::string build_commit() { return TYNDALL_COMMIT; }

std::string build_compiler() {
  const std::string text = version_text(), label = "compiler   ";
  const size_t begin = text.find(label) + label.size();
  return text.substr(begin, text.find('\n', begin) - begin);
}

std::string build_flags() { return TYNDALL_CXX_FLAGS; }

Machine this_machine() {
  const double pages = static_cast<double>(sysconf(_SC_PHYS_PAGES));
  return {cpu_name(), system_name(), static_cast<int>(std::thread::hardware_concurrency()),
          pages * static_cast<double>(sysconf(_SC_PAGESIZE))};
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

}  // namespace tyndall::app

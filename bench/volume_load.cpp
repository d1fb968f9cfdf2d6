// SPDX-License-Identifier: Apache-2.0
//
// What reading volumes costs: for each grid of numbers of each file, its uncompressed size,
// seconds, and how far memory rises while it is read and afterwards.
//
//   build/release/bench/tyndall_volume_load FILE...
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <string>

#include "tyndall/media/volume_file.h"

namespace {

// A line of /proc/self/status [bytes].
double status(const std::string& name) {
  std::ifstream file("/proc/self/status");
  std::string word;
  while (file >> word)
    if (double kilobytes = 0; word == name + ":" && file >> kilobytes)
      return kilobytes * 1024;
  return 0;
}

// Forgets the highest memory so far.
void reset_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

double uncompressed_size(const std::string& path, const std::string& name) {
  for (const tyndall::VolumeGridInfo& grid : tyndall::list_volume_grids(path))
    if (grid.name == name) return static_cast<double>(grid.memory);
  return 0;
}

void measure(const std::string& path, const std::string& name) {
  const std::string_view names[] = {name};
  reset_peak();
  const double before = status("VmRSS");
  const auto start = std::chrono::steady_clock::now();
  const tyndall::PlacedGrid read = tyndall::read_volume(path, names);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const double peak = status("VmHWM") - before,
               kept = static_cast<double>(read.grid->memory()),
               size = uncompressed_size(path, name);
  std::printf(
      "%-48s %-12s %8.2f MB %7.3f s   peak +%7.2f MB = %.2f   kept %6.2f MB = %.2f\n",
      path.substr(path.find_last_of('/') + 1).c_str(), name.c_str(), size / 1e6,
      seconds.count(), peak / 1e6, peak / size, kept / 1e6, kept / size);
}

// In a process of its own, so that nothing is left over from the grid before.
void measure_apart(const std::string& path, const std::string& name) {
  std::fflush(stdout);
  const pid_t child = ::fork();
  if (child == 0) {
    measure(path, name);
    std::fflush(stdout);
    ::_exit(0);
  }
  ::waitpid(child, nullptr, 0);
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    for (const tyndall::VolumeGridInfo& grid : tyndall::list_volume_names(argv[i]))
      if (grid.is_scalar) measure_apart(argv[i], grid.name);
}

// SPDX-License-Identifier: Apache-2.0
//
// What reading volumes costs: for each grid of numbers of each file, its uncompressed size,
// seconds, and how far memory rises while it is read and afterwards.
//
//   build/release/bench/tyndall_volume_load FILE...
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

void measure(const std::string& path, const tyndall::VolumeGridInfo& grid) {
  const std::string_view names[] = {grid.name};
  reset_peak();
  const double before = status("VmRSS");
  const auto start = std::chrono::steady_clock::now();
  const tyndall::PlacedGrid read = tyndall::read_volume(path, names);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  const double size = static_cast<double>(grid.memory);
  std::printf(
      "%-48s %-12s %8.2f MB %7.3f s   peak +%7.2f MB = %.2f   kept %6.2f MB = %.2f\n",
      path.substr(path.find_last_of('/') + 1).c_str(), grid.name.c_str(), size / 1e6,
      seconds.count(), (status("VmHWM") - before) / 1e6, (status("VmHWM") - before) / size,
      static_cast<double>(read.grid->memory()) / 1e6,
      static_cast<double>(read.grid->memory()) / size);
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i)
    for (const tyndall::VolumeGridInfo& grid : tyndall::list_volume_grids(argv[i]))
      if (grid.is_scalar) measure(argv[i], grid);
}

// SPDX-License-Identifier: Apache-2.0
#include "tyndall/media/mapped_pages.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>

namespace tyndall {

void release_mapped_pages(const std::filesystem::path& file) {
  struct stat status;
  if (::stat(file.c_str(), &status) != 0) return;
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    // begin-end rwxs offset major:minor inode path
    uintptr_t begin = 0, end = 0;
    uint64_t inode = 0;
    unsigned device_major = 0, device_minor = 0;
    char access[5] = {};
    const int found = std::sscanf(line.c_str(), "%lx-%lx %4s %*x %x:%x %lu", &begin, &end,
                                  access, &device_major, &device_minor, &inode);
    // Pages that were written to would lose what they hold.
    if (found == 6 && access[1] == '-' && inode == status.st_ino &&
        device_major == major(status.st_dev) && device_minor == minor(status.st_dev))
      ::madvise(reinterpret_cast<void*>(begin),  // NOLINT: the kernel writes numbers
                end - begin, MADV_DONTNEED);
  }
}

}  // namespace tyndall

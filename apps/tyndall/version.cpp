// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/version.h"

#include <fmt/format.h>

namespace tyndall::app {

namespace {

std::string compiler() {
#ifdef __clang__
  return fmt::format("clang {}.{}.{}", __clang_major__, __clang_minor__,
                     __clang_patchlevel__);
#else
  return fmt::format("gcc {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
}

}  // namespace

std::string version_name() { return "tyndall " TYNDALL_VERSION; }

// The numbers come from CMake, so that this file needs no header of the libraries.
std::string version_text() {
  return fmt::format(
      "{}\ncompiler   {}, {}{}\nlibraries  Embree {}, oneTBB {}, OpenEXR {}, fmt {}\n"
      "license    Apache-2.0",
      version_name(), compiler(), TYNDALL_BUILD_TYPE, TYNDALL_BUILD_EXTRAS,
      TYNDALL_EMBREE_VERSION, TYNDALL_TBB_VERSION, TYNDALL_OPENEXR_VERSION,
      TYNDALL_FMT_VERSION);
}

}  // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
//
// Stands in for openvdb_file.cpp in builds without OpenVDB.
#include <stdexcept>

#include "tyndall/media/openvdb_file.h"

namespace tyndall {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error(
      "this build cannot read .vdb files (TYNDALL_OPENVDB is off); convert it with "
      "nanovdb_convert");
}

}  // namespace

std::vector<VolumeGridInfo> list_openvdb_grids(const std::filesystem::path& /*path*/) {
  fail();
}

std::vector<VolumeGridInfo> list_openvdb_names(const std::filesystem::path& /*path*/) {
  fail();
}

PlacedGrid read_openvdb_grid(const std::filesystem::path& /*path*/,
                             const std::string& /*name*/) {
  fail();
}

}  // namespace tyndall

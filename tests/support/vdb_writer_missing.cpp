// SPDX-License-Identifier: Apache-2.0
//
// Stands in for vdb_writer.cpp in builds without OpenVDB.
#include <stdexcept>

#include "support/volume_writer.h"

namespace tyndall::test {

const bool has_openvdb = false;

void write_vdb(const std::filesystem::path& /*path*/,
               const std::vector<TestGrid>& /*grids*/) {
  throw std::logic_error("this build has no OpenVDB");
}
void write_vdb_without_numbers(const std::filesystem::path& /*path*/) {
  throw std::logic_error("this build has no OpenVDB");
}

}  // namespace tyndall::test

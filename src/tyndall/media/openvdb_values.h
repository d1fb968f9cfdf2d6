// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tyndall/media/openvdb_bytes.h"

namespace tyndall {

/// How the values of a grid of a .vdb file are stored.
struct OpenVdbValues {
  uint32_t size = 0;         ///< of a value in memory [bytes]
  uint32_t stored_size = 0;  ///< of a value in the file, less if saved as half [bytes]
  uint32_t flags = 0;        ///< openvdb::io::COMPRESS_*

  static constexpr uint32_t zip = 1, active_only = 2, blosc = 4;
};

/// Passes over the values of one node, of which so many are active. Damage of what says
/// how long they are is a std::runtime_error; if `is_unpacked`, so is any that hinders to
/// unpack them.
class OpenVdbValueCheck {
 public:
  OpenVdbValueCheck(OpenVdbBytes& bytes, OpenVdbValues values)
      : bytes_(bytes), values_(values) {}
  void pass(uint32_t count, uint32_t active_count, bool is_unpacked);

 private:
  void pass_chunk(uint64_t size, bool is_unpacked);
  void pass_packed(uint64_t packed_size, uint64_t size, bool is_unpacked);

  OpenVdbBytes& bytes_;
  OpenVdbValues values_;
  std::vector<std::byte> packed_, unpacked_;
};

}  // namespace tyndall

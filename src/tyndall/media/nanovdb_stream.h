// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <fstream>
#include <memory>
#include <span>

#include "tyndall/media/nanovdb_file.h"

namespace tyndall {

/// The memory image of a grid of a .nvdb file, read from its begin to its end, unpacked
/// piece by piece: the whole never needs to be in memory at once.
class NanoVdbStream {
 public:
  /// Throws std::runtime_error without the file's name, as read() does.
  NanoVdbStream(std::ifstream& file, const NanoVdbEntry& entry);
  ~NanoVdbStream();

  /// The next bytes. Reading past the end of the grid is an error.
  void read(std::span<std::byte> to);
  void skip(size_t count);
  /// To be called where the grid ends: throws if its checksum is not right.
  void check_end();

  class Source;  ///< how one codec unpacks

 private:
  std::unique_ptr<Source> source_;
};

}  // namespace tyndall

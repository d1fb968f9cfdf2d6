// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "tyndall/media/volume_file.h"

namespace tyndall::app {

/// A volume file and its grids, for people: several lines, each with its end.
std::string volume_text(const std::string& path, const std::vector<VolumeGridInfo>& grids);

/// The same for programs. Bounds and ranges that are not known are null.
nlohmann::ordered_json volume_json(const std::string& path,
                                   const std::vector<VolumeGridInfo>& grids);

/// "640 B", "1.07 MB": three significant digits.
std::string short_bytes(uint64_t bytes);

}  // namespace tyndall::app

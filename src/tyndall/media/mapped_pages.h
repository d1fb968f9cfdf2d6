// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace tyndall {

/// Gives back the memory of all read-only maps of a file into this process: pages that are
/// looked at again are read again. Does nothing where the system does not list its maps.
void release_mapped_pages(const std::filesystem::path& file);

}  // namespace tyndall

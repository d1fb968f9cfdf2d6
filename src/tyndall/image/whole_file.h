// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tyndall {

/// The bytes of a file. Throws std::runtime_error: "PATH: cannot read: REASON".
std::string read_whole_file(const std::string& path);

/// What a path names once symbolic links are followed; it need not exist. Throws
/// std::runtime_error if they go in circles.
std::string follow_links(const std::string& path);

/// Writes to a temporary name in the same folder and renames it to `path`, so that no
/// reader ever sees half a file and a failure leaves an older file as it was. Symbolic
/// links stay, and what they lead to is written; so are pipes and devices, in place. Throws
/// std::runtime_error: "PATH: cannot write: REASON".
void write_whole_file(const std::string& path, std::string_view bytes);

/// Throws what write_whole_file() would throw for want of a folder or of permission. Leaves
/// no file behind.
void check_can_write_file(const std::string& path);

}  // namespace tyndall

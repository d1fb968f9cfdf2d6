// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace tyndall {

/// Asks the system to keep [begin, begin + size) in huge pages, as far as they fit in it:
/// random reads of large tables then seldom miss the cache of page addresses. Changes no
/// contents and gives nothing back; does nothing where the system cannot.
void prefer_huge_pages(void* begin, size_t size);

}  // namespace tyndall

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "tyndall/math/vec.h"

namespace tyndall::app {

/// The memory that this process may use: the machine's, or its control group's limit
/// [bytes].
int64_t available_memory();

/// Throws ResourceError if a film of this many pixels cannot fit, with both amounts.
void check_film_fits(Vec2i crop_min, Vec2i crop_max, int64_t available);

}  // namespace tyndall::app

// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "tyndall/loader/load_scene.h"

// Any bytes give a scene or an exception.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  try {
    tyndall::parse_scene({reinterpret_cast<const char*>(data), size}, "fuzz.pbrt");
  } catch (const std::runtime_error&) {  // SceneError is one
  }
  return 0;
}

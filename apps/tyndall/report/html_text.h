// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace tyndall::app {

/// Text as it may stand in an element or in a quoted attribute.
std::string escape_html(std::string_view text);

std::string base64(std::string_view bytes);

/// "data:image/png;base64,..."
std::string png_url(std::string_view png);

}  // namespace tyndall::app

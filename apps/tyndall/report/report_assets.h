// SPDX-License-Identifier: Apache-2.0
#pragma once

/// The page's files, as the build embeds them.
namespace tyndall::app::asset {

extern const char* const help_html;
extern const char* const page_js;
extern const char* const pictures_js;
extern const char* const report_css;
extern const char* const viewer_js;

}  // namespace tyndall::app::asset

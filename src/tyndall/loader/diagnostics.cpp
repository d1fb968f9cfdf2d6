// SPDX-License-Identifier: Apache-2.0
#include "tyndall/loader/diagnostics.h"

#include <utility>

namespace tyndall {
namespace {

std::string all_texts(const std::vector<Diagnostic>& diagnostics) {
  std::string all;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!all.empty()) all += '\n';
    all += diagnostic.text;
  }
  return all;
}

}  // namespace

SceneError::SceneError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(all_texts(diagnostics)), diagnostics_(std::move(diagnostics)) {}

}  // namespace tyndall

// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "tyndall/image/bias_test.h"
#include "tyndall/image/metrics.h"

/// Metrics as JSON. Infinities and NaN become null and are read back as NaN.
namespace tyndall::app {

nlohmann::json to_json(const ImageErrors& errors);
nlohmann::json to_json(const std::optional<BiasTest>& bias);
ImageErrors errors_from_json(const nlohmann::json& json);
std::optional<BiasTest> bias_from_json(const nlohmann::json& json);

/// NaN for null.
double number_from_json(const nlohmann::json& json);

}  // namespace tyndall::app

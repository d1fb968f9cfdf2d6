// SPDX-License-Identifier: Apache-2.0
#include "apps/tyndall/metrics_json.h"

#include <limits>

namespace tyndall::app {

namespace {

nlohmann::json from_optional(const std::optional<double>& x) {
  return x ? nlohmann::json(*x) : nlohmann::json();
}

std::optional<double> to_optional(const nlohmann::json& json) {
  if (json.is_null()) return std::nullopt;
  return json.get<double>();
}

}  // namespace

double number_from_json(const nlohmann::json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

nlohmann::json to_json(const ImageErrors& e) {
  return {{"mse", e.mse},
          {"rel_mse", e.rel_mse},
          {"rel_mse_trimmed", e.rel_mse_trimmed},
          {"smape", e.smape},
          {"psnr", e.psnr},
          {"ldr_flip", from_optional(e.ldr_flip)},
          {"hdr_flip", from_optional(e.hdr_flip)},
          {"percentile_99_9", e.percentile_99_9},
          {"mean", e.mean},
          {"reference_mean", e.reference_mean},
          {"not_finite", e.not_finite},
          {"reference_not_finite", e.reference_not_finite}};
}

nlohmann::json to_json(const std::optional<BiasTest>& bias) {
  if (!bias) return {};
  return {{"mean_difference", bias->mean_difference},
          {"standard_error", bias->standard_error},
          {"p_value", bias->p_value},
          {"tiles", bias->tiles},
          {"rejected_tiles", bias->rejected_tiles},
          {"smallest_tile_p_value", bias->smallest_tile_p_value},
          {"reference_has_variance", bias->reference_has_variance}};
}

ImageErrors errors_from_json(const nlohmann::json& json) {
  ImageErrors e;
  e.mse = number_from_json(json.at("mse"));
  e.rel_mse = number_from_json(json.at("rel_mse"));
  e.rel_mse_trimmed = number_from_json(json.at("rel_mse_trimmed"));
  e.smape = number_from_json(json.at("smape"));
  e.psnr = number_from_json(json.at("psnr"));
  e.ldr_flip = to_optional(json.at("ldr_flip"));
  e.hdr_flip = to_optional(json.at("hdr_flip"));
  e.percentile_99_9 = number_from_json(json.at("percentile_99_9"));
  e.mean = number_from_json(json.at("mean"));
  e.reference_mean = number_from_json(json.at("reference_mean"));
  e.not_finite = json.at("not_finite");
  e.reference_not_finite = json.at("reference_not_finite");
  return e;
}

std::optional<BiasTest> bias_from_json(const nlohmann::json& json) {
  if (json.is_null()) return std::nullopt;
  BiasTest bias;
  bias.mean_difference = number_from_json(json.at("mean_difference"));
  bias.standard_error = number_from_json(json.at("standard_error"));
  bias.p_value = number_from_json(json.at("p_value"));
  bias.tiles = json.at("tiles");
  bias.rejected_tiles = json.at("rejected_tiles");
  bias.smallest_tile_p_value = number_from_json(json.at("smallest_tile_p_value"));
  bias.reference_has_variance = json.at("reference_has_variance");
  return bias;
}

}  // namespace tyndall::app

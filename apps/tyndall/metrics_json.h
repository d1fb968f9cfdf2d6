// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apps/tyndall/json_fields.h"
#include "tyndall/image/bias_test.h"
#include "tyndall/image/metrics.h"

/// The members of metrics as JSON names them.
namespace tyndall::app {

void fields(auto& archive, Of<ImageErrors> auto& e) {
  archive("mse", e.mse);
  archive("rel_mse", e.rel_mse);
  archive("rel_mse_trimmed", e.rel_mse_trimmed);
  archive("smape", e.smape);
  archive("psnr", e.psnr);
  archive("ldr_flip", e.ldr_flip);
  archive("hdr_flip", e.hdr_flip);
  archive("percentile_99_9", e.percentile_99_9);
  archive("mean", e.mean);
  archive("reference_mean", e.reference_mean);
  archive("not_finite", e.not_finite);
  archive("reference_not_finite", e.reference_not_finite);
}

void fields(auto& archive, Of<BiasTest> auto& bias) {
  archive("mean_difference", bias.mean_difference);
  archive("standard_error", bias.standard_error);
  archive("p_value", bias.p_value);
  archive("tiles", bias.tiles);
  archive("rejected_tiles", bias.rejected_tiles);
  archive("smallest_tile_p_value", bias.smallest_tile_p_value);
  archive("reference_has_variance", bias.reference_has_variance);
}

}  // namespace tyndall::app

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`tyndall compare` against NumPy and against FLIP's authors' own implementation."""

import json
import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "tests" / "apps"), str(ROOT / "tests" / "image")]
import peers  # noqa: E402

peers.use("numpy", "flip-evaluator")

import numpy as np  # noqa: E402

from expected_metrics import expected, images  # noqa: E402
from program import ProgramTest, write_pfm  # noqa: E402


def night(random, width, height):
    """A dark picture with a few lamps, and the same with the noise of a path tracer."""
    y, x = np.mgrid[:height, :width] / height
    reference = np.stack([0.02 + 0.1 * x, 0.03 + 0.1 * y, 0.05 + 0.2 * x * y], -1)
    for _ in range(5):
        cx, cy, power = random.uniform(0, width / height), random.uniform(), random.uniform(1, 300)
        reference += power * np.exp(-((x - cx) ** 2 + (y - cy) ** 2) / 2e-4)[..., None]
    noisy = reference * random.gamma(2, 0.5, (height, width, 1))
    return noisy.astype("f4"), reference.astype("f4")


class MetricsTest(ProgramTest):
    def check(self, image, reference):
        write_pfm(self.folder / "a.pfm", image)
        write_pfm(self.folder / "r.pfm", reference)
        result = self.run_program("compare", "a.pfm", "--reference", "r.pfm", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        found = json.loads(result.stdout)["images"][0]
        for name, value in expected(image, reference).items():
            # FLIP, and PSNR's sRGB curve, are computed in single precision.
            tolerance = 2e-5 if name in ("psnr", "ldr_flip", "hdr_flip") else 1e-9
            self.assertAlmostEqual(found[name], value, delta=tolerance * max(1, abs(value)),
                                   msg=name)

    def test_waves(self):
        self.check(*images())

    def test_night(self):
        self.check(*night(np.random.default_rng(3), 160, 90))

    def test_odd_size(self):
        self.check(*night(np.random.default_rng(4), 37, 121))

    def test_equal_images(self):
        image, _ = night(np.random.default_rng(5), 64, 64)
        write_pfm(self.folder / "a.pfm", image)
        write_pfm(self.folder / "r.pfm", image)
        result = self.run_program("compare", "a.pfm", "--reference", "r.pfm", "--json")
        found = json.loads(result.stdout)["images"][0]
        for name in ("mse", "rel_mse", "smape", "ldr_flip", "hdr_flip", "percentile_99_9"):
            self.assertEqual(found[name], 0, name)


if __name__ == "__main__":
    unittest.main()

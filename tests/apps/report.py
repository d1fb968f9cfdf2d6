# SPDX-License-Identifier: Apache-2.0
"""What the tests of `tyndall report` share: results of runs that never were."""

import json
import re

import numpy as np

from program import ProgramTest, write_pfm

METHODS = {"volpath": 0.3, "jis": 0.1, "learned <new>": 0.02}


def errors(rel_mse):
    return {"mse": rel_mse, "rel_mse": rel_mse, "rel_mse_trimmed": rel_mse, "smape": 0.1,
            "psnr": 30, "ldr_flip": 0.1, "hdr_flip": None, "percentile_99_9": 1, "mean": 1,
            "reference_mean": 1, "not_finite": 0, "reference_not_finite": 0}


def run(name, seed, rel_mse):
    checkpoints = [{"seconds": t, "samples_per_pixel": 4 * t, "mse": 1, "rel_mse": rel_mse * 8 / t,
                    "rel_mse_trimmed": 1} for t in (1, 2, 4, 8)]
    return {"seed": seed, "seconds": 8, "training_seconds": 0.5 * (name != "volpath"),
            "cpu_seconds": 16, "samples_per_pixel": 32, "paths": 1000, "rejected_samples": 0,
            "checkpoints": checkpoints, "errors": errors(rel_mse), "bias": None,
            "image": re.sub(r"\W+", "_", name) + ".pfm", "counters": {"path.length.mean": 3.5},
            "notes": ["learning took a while"] if name != "volpath" else [],
            "command": f"tyndall render fog.pbrt --seed {seed}"}


class ReportTest(ProgramTest):
    SIZE = (96, 54)

    def setUp(self):
        super().setUp()
        width, height = self.SIZE
        random = np.random.default_rng(1)
        y, x = np.mgrid[:height, :width] / height
        self.images = {"reference": np.stack([0.1 + x, 0.2 + y, 0.05 + x * y], -1)}
        for name, variance in METHODS.items():
            noise = random.gamma(1 / variance, variance, (height, width, 1))
            self.images[name] = self.images["reference"] * noise
        self.images["volpath"][3, 5] = np.nan
        for name, image in self.images.items():
            write_pfm(self.folder / (re.sub(r"\W+", "_", name) + ".pfm"), image)
        methods = [{"name": name, "integrator": name, "options": {},
                    "runs": [run(name, seed, variance * (1 + 0.1 * seed)) for seed in range(3)]}
                   for name, variance in METHODS.items()]
        self.results = {
            "format": "tyndall-results", "version": 1, "created": "2026-01-01T00:00:00Z",
            "command": "tyndall bench fog.pbrt", "program": "tyndall 0", "commit": "abc",
            "compiler": "gcc", "flags": "-O3", "threads": 2, "time_limit": 8, "epsilon": 0.01,
            "machine": {"cpu": "CPU", "system": "Linux", "cores": 2, "memory_bytes": 1e9},
            "scenes": [{"name": "fog & <lamp>", "path": "fog.pbrt", "hash": "0", "width": width,
                        "height": height, "reference": "reference.pfm",
                        "reference_samples_per_pixel": 1000, "reference_rel_mse": 0.01,
                        "methods": methods}]}
        self.write_results()

    def write_results(self):
        self.write("results.json", json.dumps(self.results))

    def report(self, *arguments):
        return self.run_program("report", "results.json", *arguments)

    def page(self):
        result = self.report()
        self.assertEqual(result.returncode, 0, result.stderr)
        return (self.folder / "report.html").read_text()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the numbers that metrics_test.cpp expects.

Independent of the program: NumPy for the plain metrics, the authors' flip-evaluator 1.7
(pip install flip-evaluator) for FLIP. The images are given by formulas that the test repeats.
"""
import flip_evaluator
import numpy as np

WIDTH, HEIGHT, EPSILON = 48, 40, 0.01


def images():
    y, x, c = np.meshgrid(np.arange(HEIGHT), np.arange(WIDTH), np.arange(3), indexing="ij")
    reference = (0.55 + 0.45 * np.sin(0.4 * x + 0.25 * y + 1.3 * c)) * 2.0 ** ((x - 24) / 12)
    noise = np.sin(12.9898 * x + 78.233 * y + 37.719 * c)
    return (reference * (1 + 0.25 * noise)).astype(np.float32), reference.astype(np.float32)


def srgb(x):
    x = np.clip(x, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def flip(image, reference, kind):
    """The map (height, width), its mean, and the parameters that were chosen."""
    if kind == "LDR":
        image, reference = (np.clip(i, 0, 1) for i in (image, reference))
    values, mean, parameters = flip_evaluator.evaluate(reference, image, kind, inputsRGB=False,
                                                       applyMagma=False)
    return values[..., 0], mean, parameters


def expected(image, reference):
    """The metrics by their names in `tyndall compare --json`."""
    a, b = image.astype(np.float64), reference.astype(np.float64)
    relative = ((a - b) ** 2 / (b**2 + EPSILON)).mean(axis=2).ravel()
    kept = relative.size - int(np.ceil(1e-3 * relative.size))
    return {"mse": ((a - b) ** 2).mean(),
            "rel_mse": relative.mean(),
            "rel_mse_trimmed": np.sort(relative)[:kept].mean(),
            "smape": (2 * np.abs(a - b) / (np.abs(a) + np.abs(b))).mean(),
            "psnr": -10 * np.log10(((srgb(a) - srgb(b)) ** 2).mean()),
            "percentile_99_9": np.quantile(np.abs(a - b).mean(axis=2), 0.999,
                                           method="inverted_cdf"),
            "mean": a.mean(), "reference_mean": b.mean(),
            "ldr_flip": flip(image, reference, "LDR")[1],
            "hdr_flip": flip(image, reference, "HDR")[1]}


def main():
    image, reference = images()
    for name, value in expected(image, reference).items():
        print(name, value)
    for kind in ("LDR", "HDR"):
        values, _, parameters = flip(image, reference, kind)
        print(kind, values[20, 30], values[0, 0], values[39, 47], parameters)
    reference[20, 10], image[20, 10] = 3e4, 2e4
    values, mean, parameters = flip(image, reference, "HDR")
    print("HDR with a sun", mean, values[20, 12], parameters)


if __name__ == "__main__":
    main()

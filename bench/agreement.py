#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether all integrators make the same pictures of the archetype scenes: a Welch test per tile.

Renders what is not in the folder --output yet, SCENE.VARIANT.INTEGRATOR.exr each, with --spp samples
per pixel (610 are 1e7 in all), and prints a line for each pair of integrators in a table in Markdown:

  worst z    the largest difference of the means of a tile of 16 x 16 pixels, in standard errors
  p          probability of one as large in any of the tiles, if the pictures agree [Sidak67]
  mean z^2   over the tiles: one if they agree and the variances are right
  tiles      compared: those where the variance of both is that of a tenth of the pixels or more
             (where less has been found, it is not known)
  total      difference of the whole pictures, and in standard errors
  fireflies  variance of either picture with all pixels over that without the worst 0.1 %: far above
             one, variances are not known, and neither are z and p

Exits with 1 if a pair whose fireflies are below 1.5 has a p so small that among all such pairs one
would have it once in a thousand times.
"""

import argparse
import itertools
import math
import os
import pathlib
import subprocess
import sys

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "apps"))
from program import ExrFile  # noqa: E402

TILE = 16
KNOWN_SHARE = 0.03
TRUSTED = 1.5
LEVEL = 1e-3


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/tyndall")
    parser.add_argument("--archetypes", type=pathlib.Path,
                        default=pathlib.Path(os.environ.get(
                            "TYNDALL_ARCHETYPES", ROOT.parent / "shared/scenes/archetypes")))
    parser.add_argument("--scenes", default="", help="s01,s04: beginnings of names [all]")
    parser.add_argument("--variants", default="scene-d1,scene-d2,scene", help="names of files")
    parser.add_argument("--integrators", default="volpath,equiangular,jis,learned")
    parser.add_argument("--spp", type=int, default=610, help="[610]")
    parser.add_argument("--seed", type=int, default=7, help="[7]")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "build/agreement")
    parser.add_argument("--only-table", action="store_true", help="render nothing")
    return parser.parse_args()


class Picture:
    """Means and variances of the tiles of a picture, and of all of it."""

    def __init__(self, path):
        channels = ExrFile(path).channels()
        mean = np.mean([channels[c] for c in "RGB"], 0, dtype=float)
        # Channels share their noise: the error of their mean is at most the mean of their errors.
        error = np.mean([np.sqrt(channels["variance." + c], dtype=float) for c in "RGB"], 0)
        self.mean, self.variance = tiles(mean), tiles(error**2) / TILE**2
        # The number of pixels of equal variance that vary like these, over all.
        share = tiles(error**2)**2 / np.maximum(tiles(error**4), 1e-300)
        self.is_known = share > KNOWN_SHARE
        # A bright pixel is not to excuse its variance: relative to the mean of its tile.
        around = np.kron(self.mean, np.ones((TILE, TILE)))
        inside = (error**2)[:around.shape[0], :around.shape[1]]
        weighted = np.sort((inside / (around**2 + 0.01 * mean.mean()**2)).ravel())
        kept = weighted[:weighted.size - math.ceil(1e-3 * weighted.size)]
        self.fireflies = weighted.mean() / max(kept.mean(), 1e-30)


def tiles(values):
    height, width = (size - size % TILE for size in values.shape)
    return values[:height, :width].reshape(height // TILE, TILE, width // TILE, TILE).mean((1, 3))


def any_of(p, count):
    """Probability that one of so many independent events of probability p happens."""
    return -math.expm1(count * math.log1p(-p)) if p < 1 else 1.0


def two_sided(z):
    return math.erfc(abs(z) / math.sqrt(2))


class Pair:
    """How two pictures of a scene differ."""

    def __init__(self, name, a, b):
        self.name = name
        variance = a.variance + b.variance
        difference = b.mean - a.mean
        known = a.is_known & b.is_known
        z = difference[known] / np.sqrt(variance[known])
        self.tiles = z.size
        self.worst = float(z[np.argmax(np.abs(z))]) if z.size else 0.0
        self.p = any_of(two_sided(self.worst), max(z.size, 1))
        self.mean_square = float(np.mean(z**2)) if z.size else 0.0
        self.total = float(difference.mean() / a.mean.mean())
        self.total_z = float(difference.mean() / np.sqrt(max(variance.mean() / variance.size,
                                                             1e-300)))
        self.fireflies = a.fireflies, b.fireflies

    def is_trusted(self):
        return max(self.fireflies) < TRUSTED

    def row(self):
        return [*self.name, f"{self.worst:.2f}", f"{self.p:.2g}", f"{self.mean_square:.2f}",
                str(self.tiles),                 f"{100 * self.total:.3f} %", f"{self.total_z:.2f}",
                " / ".join(f"{f:.2f}" for f in self.fireflies)]


def render(arguments, scene, variant, integrator, path):
    command = [arguments.program, "render", scene / f"{variant}.pbrt", "--integrator", integrator,
               "--spp", str(arguments.spp), "--seed", str(arguments.seed), "--float", "-q", "-o",
               path]
    if subprocess.run(command).returncode != 0:
        sys.exit(f"{scene.name} {variant}: {integrator} failed")


def pictures(arguments, scene, variant):
    """Of one scene, by integrator: those there are, or that can be made."""
    found = {}
    for integrator in arguments.integrators.split(","):
        path = arguments.output / f"{scene.name}.{variant}.{integrator}.exr"
        if not path.exists() and not arguments.only_table and (scene / f"{variant}.pbrt").exists():
            render(arguments, scene, variant, integrator, path)
        if path.exists():
            found[integrator] = Picture(path)
    return found


def compare_all(arguments):
    beginnings = tuple(arguments.scenes.split(","))
    for variant in arguments.variants.split(","):
        for scene in sorted(arguments.archetypes.glob("*/")):
            if not scene.name.startswith(beginnings):
                continue
            found = pictures(arguments, scene, variant)
            for (one, a), (other, b) in itertools.combinations(found.items(), 2):
                yield Pair((scene.name, variant, one, other), a, b)


def main():
    arguments = parse_arguments()
    arguments.output.mkdir(parents=True, exist_ok=True)
    head = ["scene", "variant", "one", "other", "worst z", "p", "mean z^2", "tiles", "total", "its z",
            "fireflies"]
    print("| " + " | ".join(head) + " |\n|" + " --- |" * len(head))
    pairs = []
    for pair in compare_all(arguments):
        pairs.append(pair)
        print("| " + " | ".join(pair.row()) + " |", flush=True)
    trusted = [pair for pair in pairs if pair.is_trusted()]
    if not trusted:
        sys.exit("nothing to compare")
    least = min(trusted, key=lambda pair: pair.p)
    p = any_of(least.p, len(trusted))
    print(f"\n{len(pairs)} pairs, {len(trusted)} of them without fireflies: the least p of these, "
          f"{least.p:.2g} ({' '.join(least.name)}), or less is among so many with probability "
          f"{p:.2g}.")
    sys.exit(0 if p > LEVEL else 1)


if __name__ == "__main__":
    main()

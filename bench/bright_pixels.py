#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Bright pixels (fireflies) of renders of small pictures.

A pixel is bright if its luminance is more than four times the median of the 24 pixels around it plus
a hundredth of the picture's mean, and more than twice the fourth highest of them: lamps and their
edges are not, single pixels that a rare path has lit are. A light of one to four pixels counts too.

Renders each scene at --width pixels and prints a table in Markdown: how many pixels are bright, how
far the worst stands out, pixels that are not finite or negative, and the processor time. Further
arguments after -- go to tyndall.
"""

import argparse
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", nargs="+", type=pathlib.Path, metavar="SCENE")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/tyndall")
    parser.add_argument("--width", type=int, default=128)
    parser.add_argument("--spp", type=int, default=256)
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for pictures in PNG and EXR")
    parser.add_argument("--list", action="store_true", help="print every bright pixel")
    own = sys.argv[1:]
    further = own[own.index("--") + 1:] if "--" in own else []
    return parser.parse_args(own[:len(own) - len(further) - ("--" in own)]), further


def picture_size(scene, width):
    """The scene's own aspect ratio at this width."""
    text = scene.read_text(errors="replace")
    x, y = (re.search(rf'^[^#\n]*"integer {axis}resolution"\s*\[?\s*(\d+)', text, re.M)
            for axis in "xy")
    aspect = int(y[1]) / int(x[1]) if x and y else 0.5625
    return f"{width}x{max(1, round(width * aspect))}"


def read_pfm(path):
    """The pixels of a color PFM file, top row first."""
    with open(path, "rb") as file:
        file.readline()
        width, height = (int(word) for word in file.readline().split())
        order = "<" if float(file.readline()) < 0 else ">"
        pixels = np.fromfile(file, order + "f4").reshape(height, width, 3)
    return pixels[::-1]


def neighbors(values):
    """The 24 values around each, sorted, along a last axis; edges repeat."""
    padded = np.pad(values, 2, mode="reflect")
    height, width = values.shape
    shifted = [padded[y:y + height, x:x + width] for y in range(5) for x in range(5)
               if (x, y) != (2, 2)]
    return np.sort(np.stack(shifted, axis=-1), axis=-1)


def excess(pixels):
    """How many times a pixel's luminance exceeds what is not bright there."""
    values = np.nan_to_num(pixels @ LUMINANCE)
    around = neighbors(values)
    limit = 4 * np.median(around, axis=-1) + 0.01 * values.mean()
    return values / np.maximum(np.maximum(limit, 2 * around[..., -4]), 1e-30)


def render(arguments, further, scene, folder):
    """The picture, and the processor time in seconds."""
    outputs = ["-o", folder / "image.pfm"]
    if arguments.keep:
        arguments.keep.mkdir(parents=True, exist_ok=True)
        for suffix in ("png", "exr"):
            outputs += ["-o", arguments.keep / f"{scene.parent.name}_{scene.stem}.{suffix}"]
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([arguments.program, "render", scene, "--quiet", "--spp", str(arguments.spp),
                    "--size", picture_size(scene, arguments.width), *outputs, *further], check=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return read_pfm(folder / "image.pfm"), seconds


def main():
    arguments, further = parse_arguments()
    print("| scene | bright | worst | not finite | negative | seconds |\n| --- | --- | --- | --- | --- | --- |")
    for scene in arguments.scenes:
        with tempfile.TemporaryDirectory() as folder:
            pixels, seconds = render(arguments, further, scene, pathlib.Path(folder))
        ratio = excess(pixels)
        print(f"| {scene.parent.name}/{scene.stem} | {(ratio > 1).sum()} | x{ratio.max():.1f} "
              f"| {(~np.isfinite(pixels)).sum()} | {(pixels < 0).sum()} | {seconds:.0f} |", flush=True)
        if arguments.list:
            for y, x in np.argwhere(ratio > 1):
                print(f"    {x},{y}: {pixels[y, x]}, x{ratio[y, x]:.1f}")


if __name__ == "__main__":
    main()

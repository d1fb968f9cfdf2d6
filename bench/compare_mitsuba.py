#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Renders the same scenes with Mitsuba 3 and with tyndall: agreement of means, and speed.

Mitsuba's variant is scalar_rgb, its integrator volpath; depth, threads, samples and pictures are
the same. Both render in turn, several rounds with different seeds. Path samples per second are
medians over the rounds; the means of 8x8 tiles are compared by Welch's test at 1 % over all tiles.

Mitsuba is installed by pip if it is not there (peers.py). Exit status: 0 agreement, 1 not, 77
skipped because Mitsuba cannot be installed.
"""

import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import peers

TILES = 8
# A square hole of 0.6 between the lamp and the middle of the box.
GOBO = ((-1.5, -2.5, 0.4, 1.8), (1.0, -2.5, 2.9, 1.8), (0.4, -2.5, 1.0, -0.65), (0.4, -0.05, 1.0, 1.8))


def density_grid(n):
    """A smooth, lumpy ball in [0, 1], zero at the border, indices (z, y, x)."""
    import numpy as np
    c = (np.arange(n) + 0.5) / n * 2 - 1
    z, y, x = np.meshgrid(c, c, c, indexing="ij")
    lumps = 0.5 + 0.5 * np.sin(7 * x + 2 * np.sin(5 * y)) * np.sin(6 * z + 1) * np.cos(8 * y)
    ball = np.clip(3 * (0.9 - np.sqrt(x * x + y * y + z * z)), 0, 1)
    density = (ball * lumps).astype("float32")
    for axis in range(3):  # what lies beyond the last samples differs between the renderers
        density[(slice(None),) * axis + ([0, -1],)] = 0
    return density


class Comparison:
    """One scene in both languages: a ball lamp over a floor, and a box of fog or smoke.

    plates: rectangles (x0, z0, x1, z1) that shade the box, all at the height PLATE_Y.
    """

    PLATE_Y = 1.4

    def __init__(self, name, sigma_t, albedo, g, depth, size, grid=None, plates=()):
        self.name, self.sigma_t, self.albedo, self.g = name, sigma_t, albedo, g
        self.depth, self.size, self.grid, self.plates = depth, size, grid, plates

    def pbrt_medium(self):
        sigma_s, sigma_a = self.sigma_t * self.albedo, self.sigma_t * (1 - self.albedo)
        text = (f'"rgb sigma_s" [{sigma_s} {sigma_s} {sigma_s}] '
                f'"rgb sigma_a" [{sigma_a} {sigma_a} {sigma_a}] "float g" {self.g}')
        if self.grid is None:
            return f'MakeNamedMedium "m" "string type" "homogeneous" {text}\n'
        n = self.grid.shape[0]
        values = " ".join(f"{v:.6g}" for v in self.grid.ravel())
        return (f'MakeNamedMedium "m" "string type" "uniformgrid" {text} "point3 p0" [-1 -1 -1] '
                f'"point3 p1" [1 1 1] "integer nx" {n} "integer ny" {n} "integer nz" {n} '
                f'"float density" [{values}]\n')

    def pbrt_plates(self):
        y = self.PLATE_Y
        return "".join(f'Shape "bilinearmesh" "point3 P" [{x0} {y} {z0}  {x1} {y} {z0}  '
                       f'{x0} {y} {z1}  {x1} {y} {z1}]\n' for x0, z0, x1, z1 in self.plates)

    def pbrt(self):
        corners = " ".join(f"{x} {y} {z}" for z in (-1, 1) for y, x in
                           ((-1, -1), (-1, 1), (1, 1), (1, -1)))
        faces = "0 4 7 0 7 3 1 2 6 1 6 5 0 1 5 0 5 4 3 7 6 3 6 2 0 3 2 0 2 1 4 5 6 4 6 7"
        return f'''Film "rgb" "integer xresolution" {self.size} "integer yresolution" {self.size}
PixelFilter "box"
Sampler "independent"
Integrator "volpath" "integer maxdepth" {self.depth}
LookAt 0.5 1.5 -5  0 -0.1 0  0 1 0
Camera "perspective" "float fov" 35
WorldBegin
AttributeBegin
  AreaLightSource "diffuse" "rgb L" [40 40 40]
  Material "diffuse" "rgb reflectance" [0 0 0]
  Translate 1.2 2.4 -0.6
  Shape "sphere" "float radius" 0.25
AttributeEnd
Material "diffuse" "rgb reflectance" [0.5 0.5 0.5]
Shape "bilinearmesh" "point3 P" [-4 -1.1 -4  4 -1.1 -4  -4 -1.1 4  4 -1.1 4]
{self.pbrt_plates()}{self.pbrt_medium()}AttributeBegin
  Material "interface"
  MediumInterface "m" ""
  Shape "trianglemesh" "point3 P" [{corners}] "integer indices" [{faces}]
AttributeEnd
'''

    def mitsuba_medium(self, mi):
        medium = {"type": "homogeneous", "albedo": self.albedo, "sigma_t": self.sigma_t,
                  "phase": {"type": "hg", "g": self.g} if self.g else {"type": "isotropic"}}
        if self.grid is not None:
            to_world = mi.ScalarTransform4f().translate([-1, -1, -1]).scale(2)
            medium.update(type="heterogeneous", scale=self.sigma_t, sigma_t={
                "type": "gridvolume", "grid": mi.VolumeGrid(self.grid[..., None]),
                "to_world": to_world, "filter_type": "trilinear"})
        return medium

    def mitsuba_plates(self, mi):
        transform = mi.ScalarTransform4f
        return {f"plate{i}": {
            "type": "rectangle",
            "bsdf": {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": 0.5}},
            "to_world": transform().translate([(x0 + x1) / 2, self.PLATE_Y, (z0 + z1) / 2])
                                   .rotate([1, 0, 0], -90)
                                   .scale([(x1 - x0) / 2, (z1 - z0) / 2, 1])}
            for i, (x0, z0, x1, z1) in enumerate(self.plates)}

    def mitsuba(self, mi):
        transform = mi.ScalarTransform4f
        return {
            **self.mitsuba_plates(mi),
            "type": "scene",
            # Depth 1 is emission seen directly; pbrt counts scattering vertices.
            "integrator": {"type": "volpath", "max_depth": self.depth + 1, "rr_depth": 1000},
            "sensor": {
                "type": "perspective", "fov": 35, "fov_axis": "smaller",
                "to_world": transform().look_at([0.5, 1.5, -5], [0, -0.1, 0], [0, 1, 0]),
                "film": {"type": "hdrfilm", "width": self.size, "height": self.size,
                         "pixel_format": "rgb", "component_format": "float32",
                         "rfilter": {"type": "box"}},
                "sampler": {"type": "independent"}},
            "lamp": {"type": "sphere", "center": [1.2, 2.4, -0.6], "radius": 0.25,
                     "bsdf": {"type": "diffuse", "reflectance": 0.0},
                     "emitter": {"type": "area", "radiance": 40.0}},
            "floor": {"type": "rectangle", "bsdf": {"type": "diffuse", "reflectance": 0.5},
                      "to_world": transform().translate([0, -1.1, 0]).rotate([1, 0, 0], -90)
                                             .scale(4)},
            "box": {"type": "cube", "bsdf": {"type": "null"},
                    "interior": self.mitsuba_medium(mi)}}


def read_pfm(np, path):
    """A color PFM file: (height, width, 3), row 0 on top."""
    header, size, scale, data = path.read_bytes().split(b"\n", 3)
    assert header == b"PF" and float(scale) < 0, path
    width, height = map(int, size.split())
    return np.frombuffer(data, "<f4").reshape(height, width, 3)[::-1]


class Tyndall:
    def __init__(self, program, comparison, folder, threads, clock):
        self.command = [program, "render", folder / f"{comparison.name}.pbrt", "--stats", "json",
                        "--quiet", "-t", str(threads), "--integrator", "volpath"]
        self.clock = clock
        self.output = folder / f"{comparison.name}.pfm"
        (folder / f"{comparison.name}.pbrt").write_text(comparison.pbrt())

    def render(self, mi, np, spp, seed):
        """The picture (height, width, 3) and the seconds that it took."""
        text = subprocess.run([*self.command, "--spp", str(spp), "--seed", str(seed), "-o",
                               self.output], check=True, capture_output=True, text=True).stdout
        image = read_pfm(np, self.output)
        return image, json.loads(text)["seconds" if self.clock == "wall" else "cpu_seconds"]


class Mitsuba:
    def __init__(self, mi, comparison, clock):
        self.clock = time.perf_counter if clock == "wall" else time.process_time
        self.scene = mi.load_dict(comparison.mitsuba(mi))

    def render(self, mi, np, spp, seed):
        start = self.clock()
        image = np.array(mi.render(self.scene, spp=spp, seed=seed))
        # Mitsuba's world is right-handed, pbrt's left-handed: the picture is mirrored.
        return image[:, ::-1, :3], self.clock() - start


def tile_means(np, image):
    step = image.shape[0] // TILES
    gray = image[:TILES * step, :TILES * step].mean(axis=2)
    return gray.reshape(TILES, step, TILES, step).mean(axis=(1, 3)).ravel()


def normal_quantile(p):
    return statistics.NormalDist().inv_cdf(p)


def t_quantile(p, degrees):
    """Student's t by the Cornish-Fisher expansion, good to a percent from 5 degrees on."""
    z, v = normal_quantile(p), degrees
    return (z + (z**3 + z) / (4 * v) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * v**2)
            + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * v**3))


def agreement(np, a, b):
    """Largest Welch statistic over the tiles, its limit, and the relative difference of means."""
    a, b = np.array(a), np.array(b)  # (rounds, tiles)
    variance = a.var(axis=0, ddof=1) / len(a) + b.var(axis=0, ddof=1) / len(b)
    t = np.abs(a.mean(axis=0) - b.mean(axis=0)) / np.sqrt(np.maximum(variance, 1e-30))
    alpha = 1 - (1 - 0.01) ** (1 / a.shape[1])  # Sidak
    limit = t_quantile(1 - alpha / 2, len(a) + len(b) - 2)
    return float(t.max()), limit, float(a.mean() / b.mean() - 1)


def compare(mi, np, comparison, arguments, folder):
    ours = Tyndall(arguments.program, comparison, folder, arguments.threads, arguments.clock)
    theirs = Mitsuba(mi, comparison, arguments.clock)
    speeds, tiles = {"tyndall": [], "mitsuba": []}, {"tyndall": [], "mitsuba": []}
    for seed in range(arguments.rounds):
        for name, renderer in (("tyndall", ours), ("mitsuba", theirs)):
            image, seconds = renderer.render(mi, np, arguments.spp, seed)
            speeds[name].append(comparison.size**2 * arguments.spp / seconds)
            tiles[name].append(tile_means(np, image))
    t, limit, difference = agreement(np, tiles["tyndall"], tiles["mitsuba"])
    median = {name: statistics.median(values) for name, values in speeds.items()}
    ratios = [a / b for a, b in zip(speeds["tyndall"], speeds["mitsuba"])]
    return {"scene": comparison.name, "tyndall_paths_per_second": median["tyndall"],
            "mitsuba_paths_per_second": median["mitsuba"],
            "speed_ratio": statistics.median(ratios), "speed_ratio_range": [min(ratios), max(ratios)],
            "mean_difference": difference, "largest_t": t, "t_limit": limit, "agrees": t <= limit}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path, default=peers.ROOT / "build/release/tyndall")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--rounds", type=int, default=6)
    parser.add_argument("--spp", type=int, default=64)
    parser.add_argument("--size", type=int, default=128)
    parser.add_argument("--depth", type=int, default=8)
    parser.add_argument("--clock", choices=("wall", "cpu"), default="wall",
                        help="cpu: processor time of all threads, for a machine that is busy")
    parser.add_argument("--json", type=pathlib.Path, help="write the results here")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    peers.use("mitsuba", "numpy")
    import drjit
    import mitsuba as mi
    import numpy as np
    mi.set_variant("scalar_rgb")
    drjit.set_thread_count(arguments.threads)
    comparisons = [
        Comparison("fog", 1.5, 0.95, 0.0, arguments.depth, arguments.size),
        Comparison("forward_fog", 3.0, 0.98, 0.7, arguments.depth, arguments.size),
        Comparison("gobo", 1.5, 0.95, 0.3, arguments.depth, arguments.size, plates=GOBO),
        Comparison("grid", 8.0, 0.95, 0.3, arguments.depth, arguments.size, density_grid(48))]
    results = []
    with tempfile.TemporaryDirectory() as folder:
        for comparison in comparisons:
            result = compare(mi, np, comparison, arguments, pathlib.Path(folder))
            results.append(result)
            print("{scene:12} tyndall {tyndall_paths_per_second:9.0f} paths/s, Mitsuba "
                  "{mitsuba_paths_per_second:9.0f}, ratio {speed_ratio:5.2f} | mean differs by "
                  "{mean_difference:+.2%}, largest t {largest_t:.2f} of {t_limit:.2f}".format(**result),
                  "" if result["agrees"] else "DISAGREES", flush=True)
    if arguments.json:
        arguments.json.write_text(json.dumps(
            {"mitsuba": mi.__version__, "threads": arguments.threads, "clock": arguments.clock, "spp": arguments.spp,
             "rounds": arguments.rounds, "results": results}, indent=2) + "\n")
    return 0 if all(r["agrees"] for r in results) else 1


if __name__ == "__main__":
    sys.exit(main())

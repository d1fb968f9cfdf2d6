#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the efficiency of the integrators on the archetype scenes.

Efficiency is 1 / (relative variance x processor seconds); it is printed relative to the first
integrator. Runs are interleaved (seed by seed, scene by scene, integrator by integrator) and kept
in a folder: a stopped measurement goes on where it was. A run has as many samples as take --seconds
of processor time, found by a short pilot, so that a machine at work does not change its picture.

Columns of the table, each for all pixels and, after the slash, without the worst 0.1 % of them:
  variance    mean over the pixels of variance / (mean^2 + 0.01 (mean of the picture)^2), of the
              picture after one run; between seeds if there are three, else as the renders estimate
              it themselves, which misses what few samples find: up to 1.6 times too little for
              volpath. No reference is needed.
  efficiency  over the first integrator, at equal processor time; in brackets its standard error
  a sample    variance of the first integrator over that of this one, at equal samples
  fireflies   variance with all pixels over that without the worst 0.1 %
"""

import argparse
import hashlib
import json
import os
import pathlib
import platform
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "apps"))
from program import ExrFile  # noqa: E402

VARIANTS = {"full": "scene.pbrt", "d1": "scene-d1.pbrt", "d2": "scene-d2.pbrt"}
TRIMMED = 1e-3
PILOT_SAMPLES = 8
BEGIN, END = "<!-- efficiency.py: begin -->", "<!-- efficiency.py: end -->"


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path,
                        default=pathlib.Path(os.environ.get("PROGRAM_UNDER_TEST",
                                                            ROOT / "build/release/tyndall")))
    parser.add_argument("--archetypes", type=pathlib.Path,
                        default=pathlib.Path(os.environ.get(
                            "TYNDALL_ARCHETYPES", ROOT.parent / "shared/scenes/archetypes")),
                        help="folder of the scenes' folders")
    parser.add_argument("--scenes", default="", help="s01,s04: beginnings of names [all]")
    parser.add_argument("--variants", default="full,d1,d2", help="[full,d1,d2]")
    parser.add_argument("--integrators", default="volpath,equiangular,jis,learned",
                        help="the baseline first [volpath,equiangular,jis,learned]")
    parser.add_argument("--seconds", type=float, default=10, help="processor time of a run [10]")
    parser.add_argument("--seeds", type=int, default=5, help="runs of each kind [5]")
    parser.add_argument("--threads", type=int, default=0, help="[all]")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "build/efficiency",
                        help="folder of the runs [build/efficiency]")
    parser.add_argument("--docs", type=pathlib.Path,
                        help="a Markdown file that the table is written into, between its marks")
    parser.add_argument("--only-table", action="store_true", help="render nothing")
    return parser.parse_args()


def samples_taking(seconds, measure):
    """Samples per pixel that take so long; `measure` tells how long so many take."""
    few, more = measure(1), measure(1 + PILOT_SAMPLES)
    each = max(more - few, 0.1 * more) / PILOT_SAMPLES
    return max(round((seconds - few) / each), 1)


class Runs:
    """The finished runs: one .npz file each, in one folder."""

    def __init__(self, arguments):
        self.arguments = arguments
        self.folder = arguments.output
        self.folder.mkdir(parents=True, exist_ok=True)
        self.pilots = {}

    def check_conditions(self):
        """Ends the program if the folder holds runs of another program or length."""
        conditions = {"program": hashlib.sha256(self.arguments.program.read_bytes()).hexdigest(),
                      "seconds": self.arguments.seconds, "threads": self.arguments.threads}
        path = self.folder / "conditions.json"
        if not path.exists():
            path.write_text(json.dumps(conditions))
        elif json.loads(path.read_text()) != conditions:
            sys.exit(f"{self.folder} holds runs of another program, --seconds or --threads: "
                     "remove it, or give another --output")

    def path(self, scene, variant, integrator, seed):
        return self.folder / f"{scene}.{variant}.{integrator.replace(':', '_')}.{seed}.npz"

    def load(self, scene, variant, integrator):
        runs = [self.path(scene, variant, integrator, seed)
                for seed in range(1, self.arguments.seeds + 1)]
        return [np.load(path) for path in runs if path.exists()]

    def make(self, scene, variant, integrator, seed):
        path = self.path(scene, variant, integrator, seed)
        if path.exists():
            return
        run = self.render(scene, variant, integrator, seed,
                          self.samples(scene, variant, integrator))
        with tempfile.NamedTemporaryFile(dir=self.folder, delete=False) as file:
            np.savez(file, **run)
        os.replace(file.name, path)

    def samples(self, scene, variant, integrator):
        """Samples per pixel that take --seconds of processor time."""
        path = self.folder / f"{scene}.{variant}.{integrator.replace(':', '_')}.pilot.json"
        if not path.exists():
            path.write_text(json.dumps(samples_taking(
                self.arguments.seconds,
                lambda n: self.render(scene, variant, integrator, 0, n)["cpu"])))
        return round(json.loads(path.read_text()))

    def render(self, scene, variant, integrator, seed, samples):
        """Picture, its variance, samples and processor time of one render."""
        name, *options = integrator.split(":")
        with tempfile.TemporaryDirectory() as folder:
            image = pathlib.Path(folder) / "run.exr"
            result = subprocess.run(
                [self.arguments.program, "render",
                 self.arguments.archetypes / scene / VARIANTS[variant], "--integrator", name,
                 "--seed", str(seed), "--spp", str(samples), "--threads",
                 str(self.arguments.threads), "--float", "-q", "--stats", "json", "-o", image,
                 *(word for option in options for word in ("--set", option))],
                capture_output=True, text=True)
            if result.returncode != 0:
                sys.exit(f"{scene} {variant} {integrator}: {result.stderr}")
            statistics = json.loads(result.stdout)
            channels = ExrFile(image).channels()
        return {"mean": np.stack([channels[c] for c in "RGB"], -1),
                "variance": np.stack([channels["variance." + c] for c in "RGB"], -1),
                "cpu": statistics["cpu_seconds"], "spp": statistics["samples_per_pixel"]}


def trimmed_mean(values):
    """Means of all values, and of all but the largest."""
    ordered = np.sort(values.ravel())
    kept = ordered[:ordered.size - int(np.ceil(TRIMMED * ordered.size))]
    return np.array([ordered.mean(), kept.mean()])


def relative(variance, picture):
    """To the square of each pixel, dark ones left out; the mean over the colors."""
    return np.mean(variance / (picture**2 + 0.01 * picture.mean()**2), -1)


class Measured:
    """What the runs of one integrator on one scene say. With three or more, their own variances
    are used by error() alone."""

    def __init__(self, runs, picture):
        self.runs = runs
        self.picture = picture
        self.cpu = float(np.mean([run["cpu"] for run in runs]))
        self.spp = float(np.mean([run["spp"] for run in runs]))
        if len(runs) >= 3:
            between = np.var([run["mean"] for run in runs], axis=0, ddof=1)
            self.variance = trimmed_mean(relative(between, picture))
        else:
            self.variance = trimmed_mean(np.mean(self.own_variances(), 0))

    def own_variances(self):
        return [relative(run["variance"], self.picture) for run in self.runs]

    def error(self):
        """How much the variance moves from run to run: its relative standard error."""
        if len(self.runs) < 3:
            return np.full(2, np.nan)
        each = np.array([trimmed_mean(variance) for variance in self.own_variances()])
        return np.std(each, axis=0, ddof=1) / each.mean(0) / np.sqrt(len(self.runs))

    def cost(self):
        return self.variance * self.cpu

    def cost_of_sample(self):
        return self.variance * self.spp

    def fireflies(self):
        return self.variance[0] / self.variance[1]


def picture_of(runs):
    """The mean of all runs, each with the weight of its inverse variance."""
    weights = [1 / max(float(trimmed_mean(run["variance"])[1]), 1e-30) for run in runs]
    return np.average([run["mean"] for run in runs], axis=0, weights=weights)


def pair(values):
    return " / ".join(f"{value:.2g}" if value < 9.95 else f"{value:.0f}" for value in values)


def rows_of(measured, scene, variant):
    """Lines of the table for one scene; `measured` by integrator, the baseline first."""
    base = next(iter(measured.values()))
    base_error = base.error()
    for integrator, m in measured.items():
        efficiency = pair(base.cost() / m.cost())
        error = np.hypot(base_error, m.error())
        if m is not base and np.all(np.isfinite(error)):
            efficiency += f" (± {100 * error[0]:.0f} / {100 * error[1]:.0f} %)"
        yield [f"{scene} {variant}", integrator, f"{len(m.runs)} x {m.spp:.0f}", f"{m.cpu:.1f}",
               pair(m.variance), efficiency, pair(base.cost_of_sample() / m.cost_of_sample()),
               f"{m.fireflies():.2f}"]


def table(runs, scenes, variants, integrators):
    head = ["scene", "integrator", "runs x spp", "cpu [s]", "variance", "efficiency", "a sample",
            "fireflies"]
    rows = []
    for scene in scenes:
        for variant in variants:
            found = {i: runs.load(scene, variant, i) for i in integrators}
            found = {i: r for i, r in found.items() if r}
            if integrators[0] not in found:
                continue
            picture = picture_of([run for some in found.values() for run in some])
            measured = {i: Measured(r, picture) for i, r in found.items()}
            rows += rows_of(measured, scene, variant)
    widths = [max(len(row[i]) for row in [head, *rows]) for i in range(len(head))]
    lines = [head, ["-" * width for width in widths], *rows]
    return "\n".join("| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths)) + " |"
                     for line in lines)


def machine():
    """The processor's name, as far as the system tells."""
    info = pathlib.Path("/proc/cpuinfo")
    names = [line.split(":")[1].strip() for line in info.read_text().splitlines()
             if line.startswith("model name")] if info.exists() else []
    return names[0] if names else platform.processor() or platform.machine()


def write_docs(path, text, arguments):
    """Replaces what stands between the marks."""
    before, rest = path.read_text().split(BEGIN)
    after = rest.split(END)[1]
    version = subprocess.run(["git", "-C", str(ROOT), "rev-parse", "--short", "HEAD"],
                             capture_output=True, text=True).stdout.strip() or "unknown"
    options = f"--seconds {arguments.seconds:g} --seeds {arguments.seeds}"
    said = (f"Commit {version}, {machine()}, {os.cpu_count()} processors; "
            f"`bench/efficiency.py {options}`.")
    path.write_text(f"{before}{BEGIN}\n{said}\n\n{text}\n{END}{after}")


def main():
    arguments = parse_arguments()
    wanted = tuple(arguments.scenes.split(","))
    scenes = sorted(path.parent.name for path in arguments.archetypes.glob("*/scene.pbrt")
                    if path.parent.name.startswith(wanted))
    variants = arguments.variants.split(",")
    integrators = arguments.integrators.split(",")
    if not scenes:
        sys.exit(f"no scene of that name in {arguments.archetypes}")
    runs = Runs(arguments)
    if not arguments.only_table:
        runs.check_conditions()
        for seed in range(1, arguments.seeds + 1):
            for scene in scenes:
                for variant in variants:
                    for integrator in integrators:
                        runs.make(scene, variant, integrator, seed)
                print(f"seed {seed}: {scene}", file=sys.stderr, flush=True)
    text = table(runs, scenes, variants, integrators)
    print(text)
    if arguments.docs:
        write_docs(arguments.docs, text, arguments)


if __name__ == "__main__":
    main()

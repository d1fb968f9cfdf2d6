#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the efficiency of tyndall's integrators over Mitsuba 3's volpath, on archetype scenes.

The same scenes, depth and pictures; Mitsuba's other settings are its own. Efficiency is
1 / (relative variance between seeds x processor seconds), with all pixels and, after the slash,
without the worst 0.1 %, as in efficiency.py. Runs are interleaved seed by seed. Loading the scene
is left out of Mitsuba's time, compiling its kernel, too; learning is in tyndall's.

Of Mitsuba's variants, llvm_ad_rgb is the fast one; it needs LLVM (DRJIT_LIBLLVM_PATH; 16 or newer
on processors with AVX-512). Mitsuba is installed by pip if it is not there (peers.py).

Exit status: 0 if the means of 8 x 8 tiles agree by Welch's test at 1 % over all tiles, 1 if not
(spots do not, their rims differ), 77 if there are no scenes or Mitsuba cannot be installed.
"""

import argparse
import os
import pathlib
import sys
import time

import peers


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=peers.ROOT / "build/release/tyndall")
    parser.add_argument("--archetypes", type=pathlib.Path,
                        default=peers.ROOT.parent / "shared/scenes/archetypes",
                        help="folder of the scenes' folders")
    parser.add_argument("--scenes", default="s01,s02,s04,s05", help="beginnings of names")
    parser.add_argument("--variants", default="full", help="full,d1,d2 [full]")
    parser.add_argument("--integrators", default="volpath,equiangular,jis,learned")
    parser.add_argument("--mitsuba", default="llvm_ad_rgb", help="its variant [llvm_ad_rgb]")
    parser.add_argument("--seconds", type=float, default=10, help="processor time of a run [10]")
    parser.add_argument("--seeds", type=int, default=5, help="runs of each kind, three or more [5]")
    parser.add_argument("--threads", type=int, default=len(os.sched_getaffinity(0)))
    arguments = parser.parse_args()
    if arguments.seeds < 3:
        parser.error("--seeds: three or more, the variance is that between them")
    return arguments


class Mitsuba:
    """Renders one scene; samples per pixel for a run of --seconds are found by a pilot."""

    MOST_AT_ONCE = 256  # samples per pixel, for the memory of a wavefront

    def __init__(self, mi, path, seconds):
        import pbrt_to_mitsuba
        self.mi, self.scene = mi, pbrt_to_mitsuba.load(mi, path)
        for spp in (8, 8):  # the first compiles
            pilot = self.render(spp, 0)
        self.spp = max(round(8 * seconds / pilot["cpu"]), 1)

    def render(self, spp, seed):
        import numpy as np
        start, sum, done = time.process_time(), 0, 0
        while done < spp:
            n = min(spp - done, self.MOST_AT_ONCE)
            image = np.array(self.mi.render(self.scene, spp=n, seed=1000003 * seed + done))
            sum, done = sum + n * image[..., :3].astype("float64"), done + n
        # Its pictures are mirrored: pbrt's world is left-handed.
        return {"mean": sum[:, ::-1] / spp, "cpu": time.process_time() - start, "spp": spp}

    def run(self, seed):
        return self.render(self.spp, seed)


class Tyndall:
    def __init__(self, arguments, scene, variant, integrator):
        self.arguments, self.what = arguments, (scene, variant, integrator)
        import efficiency
        self.spp = efficiency.samples_taking(arguments.seconds, lambda n: self.render(n, 0)["cpu"])

    def render(self, spp, seed):
        import efficiency
        return efficiency.Runs.render(self, *self.what, seed, spp)

    def run(self, seed):
        return self.render(self.spp, seed)


def largest_t(np, a, b):
    """The largest Welch statistic of an 8 x 8 tile's mean."""
    import compare_mitsuba
    return compare_mitsuba.agreement(np, *([compare_mitsuba.tile_means(np, run["mean"]) for run in runs]
                                           for runs in (a, b)))


def measured(np, runs):
    import efficiency
    return efficiency.Measured(runs, np.mean([run["mean"] for run in runs], axis=0))


def print_row(name, m, base, agreement):
    from efficiency import pair
    cells = [name, f"{len(m.runs)} x {m.spp:.0f}", f"{m.cpu:.1f}", pair(m.variance),
             pair(base.cost() / m.cost()), pair(base.cost_of_sample() / m.cost_of_sample()), agreement]
    print("| " + " | ".join(cells) + " |", flush=True)


def print_rows(np, what, runs):
    """One for each kind of runs, the first of which is the base. Returns whether all agree with it."""
    all_agree = True
    base, *others = runs
    base_measured = measured(np, runs[base])
    print_row(f"{what} {base}", base_measured, base_measured, "")
    for name in others:
        t, limit, difference = largest_t(np, runs[name], runs[base])
        all_agree &= not t > limit
        print_row(f"{what} {name}", measured(np, runs[name]), base_measured,
                  f"{100 * difference:+.2f} %, {t:.1f} of {limit:.1f}")
    return all_agree


def main():
    arguments = parse_arguments()
    if not arguments.archetypes.is_dir():
        peers.skip(f"there is no folder {arguments.archetypes}")
    peers.use("mitsuba", "numpy")
    import drjit
    import mitsuba as mi
    import numpy as np
    mi.set_variant(arguments.mitsuba)
    drjit.set_thread_count(arguments.threads)
    wanted = tuple(arguments.scenes.split(","))
    names = sorted(path.name for path in arguments.archetypes.iterdir() if path.name.startswith(wanted))
    import efficiency
    print(f"Mitsuba {mi.__version__}, {arguments.mitsuba}; {efficiency.machine()}\n")
    print("| scene, integrator | runs x spp | cpu [s] | variance | efficiency | a sample | means differ by, "
          "largest t of a tile |\n| --- | --- | --- | --- | --- | --- | --- |")
    all_agree = True
    for scene in names:
        for variant in arguments.variants.split(","):
            kinds = {"Mitsuba": Mitsuba(mi, arguments.archetypes / scene / efficiency.VARIANTS[variant],
                                        arguments.seconds)}
            for integrator in arguments.integrators.split(","):
                kinds[integrator] = Tyndall(arguments, scene, variant, integrator)
            runs = {name: [] for name in kinds}
            for seed in range(1, arguments.seeds + 1):
                for name, kind in kinds.items():
                    runs[name].append(kind.run(seed))
            all_agree &= print_rows(np, f"{scene} {variant}", runs)
    return int(not all_agree)


if __name__ == "__main__":
    sys.exit(main())

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
    return parser.parse_args()


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
        few, more = (self.render(n, 0)["cpu"] for n in (1, 9))
        self.spp = max(round(8 * (arguments.seconds - few) / max(more - few, 0.1 * more)), 1)

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


def row(np, name, runs, base):
    import efficiency
    mean = np.mean([run["mean"] for run in runs], axis=0)
    weight = 1 / (mean**2 + 0.01 * mean.mean()**2)
    between = np.var([run["mean"] for run in runs], axis=0, ddof=1)
    variance = efficiency.trimmed_mean(np.mean(between * weight, -1))
    cpu, spp = (float(np.mean([run[key] for run in runs])) for key in ("cpu", "spp"))
    result = {"cost": variance * cpu, "sample": variance * spp, "runs": runs}
    if base is None:
        base, agreement = result, ""
    else:
        t, limit, difference = largest_t(np, runs, base["runs"])
        agreement = f"{100 * difference:+.2f} %, {t:.1f} of {limit:.1f}"
        result["disagrees"] = t > limit
    cells = [name, f"{len(runs)} x {spp:.0f}", f"{cpu:.1f}", efficiency.pair(variance),
             efficiency.pair(base["cost"] / result["cost"]),
             efficiency.pair(base["sample"] / result["sample"]), agreement]
    print("| " + " | ".join(cells) + " |", flush=True)
    return result


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
    disagrees = False
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
            base = None
            for name in kinds:
                result = row(np, f"{scene} {variant} {name}", runs[name], base)
                base = base or result
                disagrees |= result.get("disagrees", False)
    return int(disagrees)


if __name__ == "__main__":
    sys.exit(main())

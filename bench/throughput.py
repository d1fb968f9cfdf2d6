#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Path samples per second of processor time of the integrators, and where the time goes.

Prints a table in Markdown: a row per archetype scene, a column per integrator, thousands of path
samples per second of processor time and, in brackets, the cost of a sample relative to the first
integrator. With --baseline a second program renders in turn with the first, and its speed is what
the brackets are relative to. Runs are interleaved; the fastest of --rounds counts, as other work on
the machine only ever slows things down.

--profile samples each run with Linux perf and prints shares of the time instead.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The first group whose pattern a symbol matches has its time; Embree itself is told by its library.
GROUPS = {
    "ray tracing": r"Intersector|intersect|occlude_user|drop_hit|starts_in_front|offset_origin"
                   r"|reconstruct|TriangleMesh|BilinearMesh|BilinearPatch|Leg::span|rtc[A-Z]",
    "tracking": r"sample_collision|ratio_tracking|estimate|passage|CellWalk|GridMedium|GridSpace"
                r"|glow",
    "lights": r"Light::|Sphere|Rectangle|sample_direction|sample_area|LightChoice"
              r"|LightProbabilities|Pivots|cone_from|point_of",
    "distances": r"ConnectionLeg|BinnedDistance|Equiangular|DoubleScattering|taps|Visibility"
                 r"|LightView|LegProxy|Linear(Table|Rows)|tail_densities|DirectionGuid|Mixture"
                 r"|DualDirection",
}


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/release/tyndall")
    parser.add_argument("--baseline", type=pathlib.Path, help="another build to compare with")
    parser.add_argument("--archetypes", type=pathlib.Path,
                        default=pathlib.Path(os.environ.get(
                            "TYNDALL_ARCHETYPES", ROOT.parent / "shared/scenes/archetypes")))
    parser.add_argument("--scenes", default="s01,s02,s04,s05,s06,s08", help="beginnings of names")
    parser.add_argument("--integrators", default="volpath,equiangular,jis,learned")
    parser.add_argument("--spp", type=int, default=16)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--profile", action="store_true")
    return parser.parse_args()


def render_command(program, scene, integrator, spp, folder):
    return [program, "render", scene / "scene.pbrt", "--integrator", integrator, "--spp", str(spp),
            "-t", "1", "--quiet", "--stats", "json", "-o", folder / "image.exr"]


def speed(program, scene, integrator, spp, folder):
    """Path samples per second of processor time."""
    output = subprocess.run(render_command(program, scene, integrator, spp, folder), check=True,
                            capture_output=True, text=True).stdout
    statistics = json.loads(output)
    return statistics["paths"] / statistics["cpu_seconds"]


def group_of(library, symbol):
    if "embree" in library:
        return "ray tracing"
    return next((name for name, pattern in GROUPS.items() if re.search(pattern, symbol)), "rest")


def shares(program, scene, integrator, spp, folder):
    """Of the processor time, by group."""
    data = folder / "perf.data"
    subprocess.run(["perf", "record", "-q", "-e", "cpu-clock", "-F", "1000", "-o", data,
                    *render_command(program, scene, integrator, spp, folder)], check=True,
                   capture_output=True)
    report = subprocess.run(["perf", "report", "-i", data, "--stdio", "--sort", "dso,symbol",
                             "--field-separator", "\t"], check=True, capture_output=True,
                            text=True).stdout
    sums = dict.fromkeys([*GROUPS, "rest"], 0.0)
    for line in report.splitlines():
        fields = line.split("\t")
        if len(fields) >= 3 and not line.startswith("#"):
            sums[group_of(fields[1], fields[2])] += float(fields[0].strip().rstrip("%"))
    return sums


def print_row(cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def print_header(cells):
    print_row(cells)
    print_row(["---"] * len(cells))


def print_speeds(arguments, scenes, integrators, folder):
    programs = [arguments.program] + ([arguments.baseline] if arguments.baseline else [])
    print_header(["scene", *integrators])
    for scene in scenes:
        best = {}
        for _ in range(arguments.rounds):
            for integrator in integrators:
                for program in programs:
                    key = integrator, program
                    best[key] = max(best.get(key, 0),
                                    speed(program, scene, integrator, arguments.spp, folder))
        cells = [scene.name]
        for integrator in integrators:
            mine = best[integrator, arguments.program]
            relative = (f"x{mine / best[integrator, arguments.baseline]:.2f}" if arguments.baseline
                        else f"{best[integrators[0], arguments.program] / mine:.1f}")
            cells.append(f"{mine / 1000:.0f} ({relative})")
        print_row(cells)


def print_profiles(arguments, scenes, integrators, folder):
    print_header(["scene", "integrator", *GROUPS, "rest"])
    for scene in scenes:
        for integrator in integrators:
            found = shares(arguments.program, scene, integrator, arguments.spp, folder)
            print_row([scene.name, integrator] + [f"{share:.0f} %" for share in found.values()])


def main():
    arguments = parse_arguments()
    beginnings = tuple(arguments.scenes.split(","))
    scenes = [s for s in sorted(arguments.archetypes.iterdir()) if s.name.startswith(beginnings)]
    if not scenes:
        sys.exit(f"no scenes in {arguments.archetypes}")
    with tempfile.TemporaryDirectory() as folder:
        show = print_profiles if arguments.profile else print_speeds
        show(arguments, scenes, arguments.integrators.split(","), pathlib.Path(folder))


if __name__ == "__main__":
    main()

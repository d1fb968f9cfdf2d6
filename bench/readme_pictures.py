#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes the pictures of README.md: docs/figures/hero.jpg, pair.jpg and error.svg.

Runs tools/demo.sh for longer and with several seeds: the hero picture is its reference, the pair
its two methods at equal time, and the plot their error over time. What it printed is kept in
docs/figures/pair.txt. JPEG files stay below 300 KB. Pillow is installed by pip (peers.py).
"""

import argparse
import io
import os
import pathlib
import shutil
import subprocess

import peers

LIMIT = 300_000


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", type=pathlib.Path,
                        default=peers.ROOT / "build/release/tyndall")
    parser.add_argument("--scene", default="scenes/lantern.pbrt")
    parser.add_argument("--picture-seconds", default="600", help="time of the hero picture [600]")
    parser.add_argument("--seconds", default="20", help="time of each run of the pair [20]")
    parser.add_argument("--seeds", default="5", help="runs of each method [5]")
    parser.add_argument("--work", type=pathlib.Path, default=peers.ROOT / "build/readme_pictures",
                        help="where the renders are kept")
    parser.add_argument("--output", type=pathlib.Path, default=peers.ROOT / "docs/figures")
    return parser.parse_args()


def jpeg(source, target):
    """The best quality below the limit."""
    from PIL import Image
    image = Image.open(source).convert("RGB")
    for quality in range(95, 20, -5):
        data = io.BytesIO()
        image.save(data, "JPEG", quality=quality, optimize=True, progressive=True)
        if len(data.getvalue()) < LIMIT:
            target.write_bytes(data.getvalue())
            print(f"{target}: quality {quality}, {len(data.getvalue()) // 1000} KB")
            return
    raise SystemExit(f"{source} does not fit into {LIMIT} bytes")


def main():
    arguments = parse_arguments()
    peers.use("pillow")
    work, output = arguments.work.resolve(), arguments.output.resolve()
    settings = {"DEMO_SCENE": arguments.scene, "DEMO_SECONDS": arguments.seconds,
                "DEMO_SEEDS": arguments.seeds, "DEMO_PICTURE_SECONDS": arguments.picture_seconds}
    subprocess.run([peers.ROOT / "tools/demo.sh", arguments.program.resolve(), work],
                   cwd=peers.ROOT, env={**os.environ, **settings}, check=True)
    output.mkdir(parents=True, exist_ok=True)
    jpeg(work / "demo.png", output / "hero.jpg")
    jpeg(work / "pair.png", output / "pair.jpg")
    name = pathlib.Path(arguments.scene).stem
    shutil.copy(work / f"{name}-time.svg", output / "error.svg")
    lines = (work / "bench.txt").read_text().splitlines(keepends=True)
    # Where the report lies is this machine's business.
    (output / "pair.txt").write_text("".join(x for x in lines if not x.startswith("see all")))


if __name__ == "__main__":
    main()

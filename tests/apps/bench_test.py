#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""End-to-end tests of `tyndall bench`: results, going on after a stop, messages."""

import json
import re
import shlex
import signal
import time
import unittest

import numpy as np

from program import ProgramTest

QUICK = ["--integrators", "volpath,jis", "--time", "0.05", "--seeds", "2", "--make-reference",
         "--reference-time", "0.2", "--no-flip", "-o", "out"]


class BenchTest(ProgramTest):
    def bench(self, *arguments, scene="fog.pbrt"):
        return self.run_program("bench", scene, *(arguments or QUICK))

    def results(self):
        return json.loads((self.folder / "out/results.json").read_text())

    def progress(self, result):
        return re.findall(r"^\[(\d)/4\] fog (\w+) seed (\d): ", result.stderr, re.MULTILINE)


class ResultsTest(BenchTest):
    def test_measures_in_turn_and_keeps_all(self):
        result = self.bench()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(result.stderr.startswith(
            "fog: rendering the reference for 0.2 s with volpath\n[1/4] fog volpath seed 0: "))
        self.assertEqual(self.progress(result), [
            ("1", "volpath", "0"), ("2", "jis", "0"), ("3", "volpath", "1"), ("4", "jis", "1")])
        self.assertRegex(result.stdout, r"^fog +runs +relMSE +trimmed +seconds +samples/pixel +times less time")
        self.assertRegex(result.stdout, r"\njis: the same error as volpath in \S+ times ")
        self.assertTrue(result.stdout.endswith(
            "see all of it: tyndall report out -o out/report.html\n"))
        self.assertEqual(sorted(p.name for p in (self.folder / "out").iterdir()), [
            "fog-jis-0.exr", "fog-jis-1.exr", "fog-reference.exr", "fog-volpath-0.exr",
            "fog-volpath-1.exr", "results.json"])

    def test_describes_the_conditions(self):
        self.bench()
        results = self.results()
        self.assertEqual((results["format"], results["version"]), ("tyndall-results", 1))
        self.assertEqual((results["time_limit"], results["epsilon"]), (0.05, 0.01))
        self.assertGreater(results["machine"]["cores"], 0)
        self.assertRegex(results["compiler"], r"^(gcc|clang) \d+")
        self.assertRegex(results["created"], r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ$")
        scene = results["scenes"][0]
        self.assertEqual((scene["name"], scene["width"], scene["height"]), ("fog", 16, 8))
        self.assertGreater(scene["reference_rel_mse"], 0)
        self.assertGreater(scene["reference_samples_per_pixel"], 0)

    def test_checkpoints_are_of_the_same_run(self):
        self.bench()
        for method in self.results()["scenes"][0]["methods"]:
            for run in method["runs"]:
                points = run["checkpoints"]
                seconds = [p["seconds"] for p in points]
                samples = [p["samples_per_pixel"] for p in points]
                self.assertEqual(seconds, sorted(seconds))
                self.assertEqual(samples, sorted(set(samples)))
                self.assertEqual(samples[-1], run["samples_per_pixel"])
                self.assertEqual(points[-1]["rel_mse"], run["errors"]["rel_mse"])
                self.assertEqual(seconds[-1], run["seconds"])
                self.assertGreater(run["peak_memory_bytes"], 1e6)
                self.assertGreaterEqual(run["seconds"], 0.025)  # half a pass may be missing

    def test_command_renders_the_same_image(self):
        self.bench(*QUICK, "--size", "12x6")
        run = self.results()["scenes"][0]["methods"][1]["runs"][1]
        words = shlex.split(run["command"])
        self.assertEqual(words[:3], ["tyndall", "render", "fog.pbrt"])
        result = self.run_program(*words[1:], "--half")
        self.assertEqual(result.returncode, 0, result.stderr)
        again, before = self.exr(run["image"]).channels(), self.exr("out/" + run["image"]).channels()
        for name in ("R", "G", "B", "variance.R", "spp.Y"):
            np.testing.assert_array_equal(again[name], before[name], err_msg=name)

    def test_reports(self):
        self.bench()
        result = self.run_program("report", "out")
        self.assertEqual(result.returncode, 0, result.stderr)


class GoingOnTest(BenchTest):
    def test_finished_runs_are_not_run_again(self):
        self.bench()
        before = (self.folder / "out/fog-jis-0.exr").stat().st_mtime_ns
        result = self.bench()
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual((self.folder / "out/fog-jis-0.exr").stat().st_mtime_ns, before)

    def test_missing_runs_are_run(self):
        self.bench()
        results = self.results()
        kept = results["scenes"][0]["methods"][0]["runs"].pop()
        (self.folder / "out/results.json").write_text(json.dumps(results))
        self.assertEqual(self.progress(self.bench()), [("3", "volpath", "1")])
        seeds = [run["seed"] for run in self.results()["scenes"][0]["methods"][0]["runs"]]
        self.assertEqual(seeds, [0, kept["seed"]])

    def test_stops_and_goes_on(self):
        slow = [w if w != "0.05" else "1.5" for w in QUICK]
        process = self.start_program("bench", "fog.pbrt", *slow)
        while "[1/4]" not in process.stderr.readline():
            self.assertIsNone(process.poll())
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        _, stderr = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 4)
        self.assertTrue(stderr.endswith(
            "stopped; the same command goes on with the runs that are missing\n"), stderr)
        self.assertEqual(len(self.results()["scenes"][0]["methods"][0]["runs"]), 1)
        self.assertEqual(self.progress(self.bench(*slow))[0], ("2", "jis", "0"))

    def test_other_conditions_are_refused(self):
        self.bench()
        now = [w if w != "0.05" else "0.07" for w in QUICK]
        result = self.bench(*now)
        self.assertEqual((result.returncode, result.stderr), (1, (
            "error: out/results.json was measured with time limit 0.05, now it is 0.07; "
            "give another --output\n")))
        result = self.bench(*QUICK, "--epsilon", "0.1")
        self.assertEqual(result.stderr, (
            "error: out/results.json was measured with epsilon 0.01, now it is 0.1; "
            "give another --output\n"))
        text = (self.folder / "fog.pbrt").read_text()
        self.write("fog.pbrt", text + "# changed\n")
        self.assertRegex(self.bench().stderr,
                         r"^error: out/results.json: scene fog was measured with contents "
                         r"[0-9a-f]{16}, now it is [0-9a-f]{16}; give another --output\n$")


class MessageTest(BenchTest):
    def check(self, code, message, *arguments, scene="fog.pbrt"):
        result = self.bench(*arguments, scene=scene)
        self.assertEqual((result.returncode, result.stderr.splitlines()[0]),
                         (code, "error: " + message))

    def test_reference(self):
        self.check(1, "fog.pbrt: no reference; give --reference FILE or --make-reference",
                   "-o", "out")
        self.check(1, "--reference and --make-reference exclude each other",
                   "--reference", "a.exr", "--make-reference")
        self.check(1, "--reference serves one scene; use --make-reference for several",
                   "fog.pbrt", "--reference", "a.exr")
        self.check(2, "a.exr: cannot read: No such file or directory", "--reference", "a.exr")
        self.render("-o", "a.exr", "--size", "4x4")
        self.check(2, "a.exr: the reference has 4 x 4 pixels, the picture 16 x 8",
                   "--reference", "a.exr")

    def test_numbers(self):
        self.check(1, "--seeds: must be a whole number from 1 to 2147483647, got '0'", "--seeds", "0")
        self.check(1, "--epsilon must be above 0, got 0", "--epsilon", "0")

    def test_integrators(self):
        self.check(1, "--integrators: must be integrators separated by commas; there is no "
                      "'volpaht'; did you mean volpath?", "--integrators", "jis,volpaht")
        self.check(1, "--integrators: must not name a method twice", "--integrators", "jis,jis")

    def test_scenes(self):
        self.check(1, "two scenes have the same name; measure them with separate commands",
                   "fog.pbrt", "--make-reference")
        self.check(2, 'cannot read "x.pbrt": No such file or directory', "--make-reference",
                   scene="x.pbrt")

    def test_folder(self):
        self.write("out", "a file")
        self.check(5, "out/put: cannot make the folder: Not a directory", "--make-reference",
                   "-o", "out/put")


if __name__ == "__main__":
    unittest.main()

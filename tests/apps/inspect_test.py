#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What tyndall inspect prints and draws, and what it says about files that it cannot read."""

import json
import re
import unittest

from program import FOG, ProgramTest

# A disk over the lamp keeps its light from much of the fog.
SHADED = FOG.replace("WorldBegin", "WorldBegin\nAttributeBegin\nRotate 90 1 0 0\n"
                     'Material "diffuse" "rgb reflectance" [.1 .1 .1]\n'
                     'Shape "disk" "float radius" 1 "float height" -.2\nAttributeEnd')


class InspectTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write("fog.pbrt", SHADED)
        self.render("--integrator", "learned", "--spp", "1", "-q", "-o", "a.exr",
                    "--dump-guiding", "a.guide")

    def inspect(self, *arguments):
        return self.run_program("inspect", *arguments)

    def test_statistics(self):
        result = self.inspect("a.guide")
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stdout.splitlines()
        self.assertRegex(lines[0], r"^time       \d+\.\d\d s, \d+\.\d % of it training$")
        self.assertRegex(lines[1], r"^light 0    visibility map \d+x\d+, [\d.]+ MB, floor ")
        self.assertRegex(lines[-1], r"^memory     \d+\.\d\d MB of records and mixtures; a render holds "
                                    "samples too$")
        self.assertEqual(self.files(), ["a.exr", "a.guide", "fog.pbrt"])

    def test_pictures(self):
        result = self.inspect("a.guide", "-o", "map.png")
        self.assertEqual(result.returncode, 0, result.stderr)
        result = self.inspect("a.guide", "--scene", "fog.pbrt", "--pixel", "8,4", "-o", "d.png")
        self.assertEqual(result.returncode, 0, result.stderr)
        learned, without = map(float, re.search(
            r"^light 0: distances: relative variance ([\d.e-]+) learned, ([\d.e-]+) without ",
            result.stdout, re.MULTILINE).groups())
        self.assertLess(learned, without)
        result = self.inspect("a.guide", "--scene", "fog.pbrt", "--pixel", "8,4", "--at", "3",
                              "-o", "w.png")
        self.assertEqual(result.returncode, 0, result.stderr)
        learned, joint = map(float, re.search(
            r"^light 0: directions: relative variance ([\d.e-]+) learned, ([\d.e-]+) by joint ",
            result.stdout, re.MULTILINE).groups())
        self.assertGreater(learned, 0)
        self.assertGreater(joint, 0)
        for name in ("map.png", "d.png", "w.png"):
            self.assertEqual((self.folder / name).read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_wrong_files(self):
        data = (self.folder / "a.guide").read_bytes()
        cases = [(data[:-1], "it is cut off"), (data[:6], "it is cut off"),
                 (data[:8], "it is cut off"), (data[:36], "it is cut off"),
                 (data[:-12], "it is cut off"), (data + b"\0", "something follows its end"),
                 (b"", "it is no file of --dump-guiding"),
                 (data[:4] + b"\1" + data[5:],
                  "its format has version 1, this program reads version 3")]
        for content, message in cases:
            (self.folder / "b.guide").write_bytes(content)
            result = self.inspect("b.guide")
            self.assertEqual((result.returncode, result.stderr),
                             (2, f"error: b.guide: {message}\n"))

    def test_another_scene(self):
        lamp = 'LightSource "point" "rgb I" [8 8 8]'
        for name, text, how in (
                ("lamps", SHADED.replace(lamp, lamp + "\n" + lamp), "which has 2 lights, not 1"),
                ("small", SHADED.replace('radius" 30', 'radius" 20'),
                 "which reaches from (-20, -20, -20) to (20, 20, 20), not from (-30, -30, -30) to "
                 "(30, 30, 30)"),
                ("moved", SHADED.replace("LookAt 0 0 -5", "LookAt 0 0 -6"),
                 "whose camera stands at (0, 0, -6), not (0, 0, -5)")):
            self.write(f"{name}.pbrt", text)
            result = self.inspect("a.guide", "--scene", f"{name}.pbrt", "--pixel", "8,4", "-o",
                                  "d.png")
            self.assertEqual((result.returncode, result.stderr),
                             (2, f"error: a.guide: it was learned in another scene than {name}.pbrt, "
                                 f"{how}\n"))
            self.assertNotIn("d.png", self.files())

    def test_wrong_arguments(self):
        for arguments, message in (
                (["--pixel", "1,1", "-o", "d.png"], "--pixel needs --scene"),
                (["--scene", "fog.pbrt", "-o", "d.png"], "--scene needs --pixel"),
                (["--at", "2", "-o", "d.png"], "--at needs --pixel"),
                (["--light", "0"], "a picture needs -o FILE"),
                (["--light", "7", "-o", "d.png"], "--light: there is no map of light 7"),
                (["--scene", "fog.pbrt", "--pixel", "16,0", "-o", "d.png"],
                 "--pixel: 16,0 lies outside the 16x8 picture")):
            result = self.inspect("a.guide", *arguments)
            self.assertEqual(result.returncode, 1, arguments)
            self.assertTrue(result.stderr.startswith(f"error: {message}\n"), result.stderr)

    def test_scenes_that_give_no_reason_to_learn(self):
        self.write("open.pbrt", FOG)
        result = self.run_program("render", "open.pbrt", "-o", "b.exr", "--integrator", "learned",
                                  "--spp", "1", "--dump-guiding", "b.guide", "--stats", "json")
        self.assertEqual(result.returncode, 0, result.stderr)
        note = ("neither distances nor directions were learned: surfaces hide 0 % of the light "
                "from what the picture shows, and below 30 % learning gains less than it costs")
        self.assertEqual(json.loads(result.stdout)["notes"], [note])
        self.assertIn(f"note: {note}\n", result.stderr)
        result = self.inspect("b.guide")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertEqual(result.stdout.splitlines()[1:],
                         ["nothing    was learned: no visibility maps, no trained mixtures"])
        result = self.inspect("b.guide", "-o", "map.png")
        self.assertEqual((result.returncode, result.stderr),
                         (2, "error: b.guide: it holds no visibility maps\n"))
        result = self.inspect("b.guide", "--scene", "open.pbrt", "--pixel", "8,4", "-o", "d.png")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_integrators_that_learn_nothing(self):
        result = self.run_program("render", "fog.pbrt", "-q", "-o", "b.exr", "--integrator",
                                  "volpath", "--dump-guiding", "b.guide")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr, 'error: integrator "volpath" learns nothing that could '
                                        "be dumped\n")
        self.assertNotIn("b.exr", self.files())


if __name__ == "__main__":
    unittest.main()

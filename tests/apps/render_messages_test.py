#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`tyndall render`: arguments, exit codes, messages."""

import json
import os
import unittest

from program import FOG, ProgramTest

SEE = "See 'tyndall render --help'.\n"


class EnvironmentTest(ProgramTest):
    def test_twins(self):
        result = self.render("--stats", "json", TYNDALL_SPP="3", TYNDALL_SIZE="4x2",
                             TYNDALL_SEED="9", TYNDALL_QUIET="1", TYNDALL_OUTPUT="x.exr",
                             TYNDALL_THREADS="1", TYNDALL_MAXDEPTH="2")
        statistics = json.loads(result.stdout)
        self.assertEqual((statistics["samples_per_pixel"], statistics["resolution"],
                          statistics["seed"], statistics["threads"], statistics["max_depth"]),
                         (3, [4, 2], 9, 1, 2))
        self.assertEqual(self.files(), ["fog.pbrt", "x.exr"])
        self.assertEqual(result.stderr, "")

    def test_every_option_has_one(self):
        """A value that no option can have is blamed on the variable."""
        for option in ("SPP", "TIME", "INTEGRATOR", "MAXDEPTH", "ORDERS", "SAMPLER", "SEED",
                       "SIZE", "CROP", "PIXEL", "EXPOSURE", "TONE", "THREADS", "PROGRESS", "STATS"):
            result = self.run_program("render", "fog.pbrt", **{f"TYNDALL_{option}": "?!"})
            self.assertEqual(result.returncode, 1, option)
            self.assertTrue(result.stderr.startswith(f"error: TYNDALL_{option}: must "), result.stderr)

    def test_command_line_wins(self):
        result = self.render("--spp", "2", "--stats", "json", TYNDALL_SPP="3")
        self.assertEqual(json.loads(result.stdout)["samples_per_pixel"], 2)


class UsageTest(ProgramTest):
    def check(self, arguments, message):
        result = self.run_program("render", *arguments)
        self.assertEqual((result.returncode, result.stderr), (1, message))
        self.assertEqual(self.files(), ["fog.pbrt"])

    def test_messages(self):
        self.check([], "error: SCENE is required\n" + SEE)
        self.check(["fog.pbrt", "--ssp", "4"],
                   "error: unknown argument '--ssp'; did you mean --spp?\n" + SEE)
        self.check(["fog.pbrt", "--spp", "0"], "error: --spp: must be a whole number from 1 to 4294967295, got '0'\n" + SEE)
        self.check(["fog.pbrt", "--spp", "x"],
                   "error: --spp: must be a whole number from 1 to 4294967295, got 'x'\n" + SEE)
        self.check(["fog.pbrt", "--half", "--float"], "error: --half and --float exclude each other\n")
        self.check(["fog.pbrt", "-o", "a.exr", "-o", "a.gif"],
                   'error: a.gif: unknown image extension ".gif"; known are .exr, .hdr, .pfm and '
                   '.png\n')
        self.check(["fog.pbrt", "--size", "0x0"],
                   "error: --size: must be a width and a height of at least 1, such as 640x360, "
                   "got '0x0'\n" + SEE)
        self.check(["fog.pbrt", "--pixel", "16,0"],
                   "error: --pixel: 16,0 lies outside the 16x8 picture\n")
        self.check(["fog.pbrt", "--crop", "20,0,30,8"],
                   "error: --crop: the window holds no pixel of the 16x8 picture\n")
        same = "are the same file: one would overwrite the other\n"
        self.check(["fog.pbrt", "-o", "a.exr", "-o", "a.exr"], f"error: a.exr and a.exr {same}")
        self.check(["fog.pbrt", "-o", "a.exr", "--dump-guiding", "./a.exr"],
                   f"error: a.exr and ./a.exr {same}")
        self.check(["fog.pbrt", "--dump-guiding", "fog.exr"],
                   f"error: fog.exr and fog.exr {same}")
        self.check(["fog.pbrt", "--dump-guiding", "x/../fog.pbrt"],
                   f"error: fog.pbrt and x/../fog.pbrt {same}")
        self.check(["fog.pbrt", "--set", "x"],
                   "error: --set: must be name=value, got 'x'\n" + SEE)

    def test_unknown_option_of_the_integrator(self):
        result = self.run_program("render", "fog.pbrt", "--set", "no.such=1")
        self.assertEqual((result.returncode, result.stderr),
                         (1, 'error: integrator "learned" has no option "no.such"; there are: '
                             "learned.direction, learned.distance, learned.lit_surfaces, "
                             "learned.memory, learned.pretraining, learned.product, learned.roulette, learned.sky, "
                             "particles\n"))

    def test_help_and_version(self):
        result = self.run_program("render", "--help")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        for word in ("--spp", "--outfile", "Exit status:", "Ctrl-C"):
            self.assertIn(word, result.stdout)
        self.assertLessEqual(max(map(len, result.stdout.splitlines())), 100)
        result = self.run_program("--version")
        self.assertRegex(result.stdout, r"^tyndall \d+\.\d+\.\d+\ncompiler   .*\nlibraries  Embree 3")


class OutputErrorTest(ProgramTest):
    """Found before rendering: with this many samples nothing else ends in time."""

    def check(self, output, message):
        result = self.run_program("render", "fog.pbrt", "--spp", "100000000", "-o", output)
        self.assertEqual(result.returncode, 5, result.stderr)
        self.assertIn(message, result.stderr)
        self.assertEqual(result.stderr.count("\n"), 1)

    def test_no_such_folder(self):
        self.check("nowhere/a.exr", "nowhere")

    def test_folder_in_the_way(self):
        (self.folder / "a.exr").mkdir()
        self.check("a.exr", "a.exr")

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_no_permission(self):
        (self.folder / "closed").mkdir(mode=0o500)
        self.check("closed/a.exr", "closed")

    def test_one_bad_output_of_two(self):
        result = self.run_program("render", "fog.pbrt", "--spp", "100000000", "-o", "a.exr", "-o",
                                  "nowhere/b.exr")
        self.assertEqual(result.returncode, 5)
        self.assertEqual(self.files(), ["fog.pbrt"])

    def test_default_output(self):
        self.write("fog.pbrt", FOG.replace("fog.exr", "nowhere/fog.exr"))
        result = self.run_program("render", "fog.pbrt", "--spp", "100000000")
        self.assertEqual(result.returncode, 5)

    def test_default_output_of_unknown_kind(self):
        self.write("fog.pbrt", FOG.replace("fog.exr", "fog.tif"))
        result = self.run_program("render", "fog.pbrt", "--spp", "100000000")
        self.assertEqual((result.returncode, result.stderr), (
            2, 'error: fog.pbrt: the Film\'s filename: fog.tif: unknown image extension ".tif"; '
            "known are .exr, .hdr, .pfm and .png\n"))
        self.assertEqual(self.render("-o", "a.exr").returncode, 0)


class SceneErrorTest(ProgramTest):
    def check(self, text, *messages, code=2):
        self.write("bad.pbrt", text)
        result = self.run_program("render", "bad.pbrt", "-o", "a.exr")
        self.assertEqual(result.returncode, code, result.stderr)
        for message in messages:
            self.assertIn(message, result.stderr)
        self.assertEqual(self.files(), ["bad.pbrt", "fog.pbrt"])

    def test_no_file(self):
        result = self.run_program("render", "nothing.pbrt", "-o", "a.exr")
        self.assertEqual(result.returncode, 2)
        self.assertIn("nothing.pbrt", result.stderr)
        self.assertIn("No such file or directory", result.stderr)

    def test_no_text(self):
        self.render("-o", "picture.exr")
        result = self.run_program("render", "picture.exr", "-o", "a.exr")
        self.assertEqual((result.returncode, result.stderr),
                         (2, 'error: cannot read "picture.exr": it is not a text file\n'))

    def test_a_folder(self):
        result = self.run_program("render", ".", "-o", "a.exr")
        self.assertEqual(result.returncode, 2)

    def test_wrong_type(self):
        self.check(FOG.replace('"float fov" 50', '"float fov" "wide"'), "bad.pbrt:8:", "error: ",
                   "fov")

    def test_out_of_range(self):
        self.check(FOG.replace('[0 0 0]\nLook', '[0 0 0] "float g" 1.5\nLook'), "bad.pbrt:5:", "1.5")

    def test_no_camera(self):
        self.check(FOG.replace('Camera "perspective" "float fov" 50\n', ""), "amera")

    def test_empty_film(self):
        self.check(FOG.replace('"integer xresolution" 16', '"integer xresolution" 0'), "bad.pbrt:1:",
                   "xresolution")

    def test_huge_film(self):
        huge = '"integer xresolution" 2000000 "integer yresolution" 2000000'
        self.check(FOG.replace('"integer xresolution" 16 "integer yresolution" 8', huge),
                   "bad.pbrt:1:", "2000000 x 2000000 pixels is too large")
        result = self.run_program("render", "fog.pbrt", "--size", "2000000x2000000", "-o", "a.exr")
        self.assertEqual(result.returncode, 3)
        self.assertRegex(result.stderr, r"^error: a film of 2000000x2000000 pixels needs \d+ GB, "
                         r"more than the \d+ GB of memory here; see --size and --crop\n$")

    def test_no_light(self):
        self.check(FOG.replace('LightSource "point" "rgb I" [8 8 8]\n', ""),
                   "error: the scene has no lights: the picture would be black")

    def test_unsupported_is_a_warning_or_under_strict_an_error(self):
        self.write("odd.pbrt", FOG.replace("WorldBegin\n",
                                           'WorldBegin\nLightSource "goniometric"\n'))
        where = 'odd.pbrt:10:1: {}: LightSource "goniometric": not supported yet'
        result = self.run_program("render", "odd.pbrt", "-o", "a.exr")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stderr.count(where.format("warning")), 1, result.stderr)
        self.assertEqual(self.run_program("render", "odd.pbrt", "-q", "-o", "a.exr").stderr, "")
        (self.folder / "a.exr").unlink()
        result = self.run_program("render", "odd.pbrt", "--strict", "-o", "a.exr")
        self.assertEqual(result.returncode, 2)
        self.assertIn(where.format("error"), result.stderr)
        self.assertEqual(self.files(), ["fog.pbrt", "odd.pbrt"])


if __name__ == "__main__":
    unittest.main()

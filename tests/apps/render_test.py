#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""End-to-end tests of `tyndall render`: its files and what is in them."""

import json
import unittest

import numpy as np

from program import FOG, ROOT, ProgramTest


class OutputTest(ProgramTest):
    def test_goes_where_the_scene_says(self):
        self.render()
        self.assertEqual(self.files(), ["fog.exr", "fog.pbrt"])

    def test_several_outputs(self):
        result = self.render("-o", "a.exr", "--outfile", "b.png", "--output=c.pfm")
        self.assertEqual(self.files(), ["a.exr", "b.png", "c.pfm", "fog.pbrt"])
        self.assertTrue(result.stderr.endswith("wrote a.exr\nwrote b.png\nwrote c.pfm\n"))
        self.assertEqual((self.folder / "b.png").read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_layers(self):
        self.render("-o", "a.exr")
        channels = self.exr("a.exr").channels()
        self.assertEqual(sorted(channels), [
            "B", "G", "R", "albedo.B", "albedo.G", "albedo.R", "depth.Z", "normal.X", "normal.Y",
            "normal.Z", "spp.Y", "variance.B", "variance.G", "variance.R"])
        self.assertEqual({c.shape for c in channels.values()}, {(8, 16)})
        self.assertTrue((channels["spp.Y"] == 4).all())
        self.assertTrue((channels["R"] >= 0).all() and channels["R"].max() > 0)

    def test_half_and_float(self):
        self.render("-o", "half.exr", "--half")
        types = self.exr("half.exr").channel_types()
        self.assertEqual((types["R"], types["depth.Z"], types["spp.Y"]), ("<f2", "<f4", "<f4"))
        self.render("-o", "float.exr", "--float")
        self.assertEqual(self.exr("float.exr").channel_types()["R"], "<f4")
        self.render("-o", "float.exr", "--float", TYNDALL_HALF="1")
        self.assertEqual(self.exr("float.exr").channel_types()["R"], "<f4")
        self.render("-o", "half.exr", "--half", TYNDALL_FLOAT="1")
        self.assertEqual(self.exr("half.exr").channel_types()["R"], "<f2")

    def test_metadata(self):
        self.render("-o", "a.exr", "--seed", "18446744073709551615", "--spp", "3")
        file = self.exr("a.exr")
        self.assertRegex(file["software"], r"^tyndall \d+\.\d+\.\d+$")
        self.assertEqual(file["seed"], "18446744073709551615")
        self.assertEqual(file["integrator"], "learned")
        self.assertEqual(file["samplesPerPixel"], 3)
        self.assertEqual(file["rejectedSamples"], 0)
        self.assertGreater(file["renderTimeSeconds"], 0)
        self.assertTrue(file["commandLine"].endswith(
            "render fog.pbrt -o a.exr --seed 18446744073709551615 --spp 3"))
        # The camera stands at z = -5: the lamp at the origin is 5 in front of it.
        at_lamp = file["worldToCamera"] @ [0, 0, 0, 1]
        np.testing.assert_allclose(at_lamp, [0, 0, 5, 1], atol=1e-5)
        ndc = file["worldToNDC"] @ [0, 0, 0, 1]
        np.testing.assert_allclose(ndc[:2] / ndc[3], [0.5, 0.5], atol=1e-5)

    def test_a_link_is_the_file_that_it_leads_to(self):
        (self.folder / "b.guide").symlink_to("a.exr")
        for arguments in (["-o", "a.exr", "--dump-guiding", "b.guide"],
                          ["-o", str(self.folder / "a.exr"), "--dump-guiding", "b.guide"]):
            result = self.run_program("render", "fog.pbrt", *arguments)
            self.assertEqual((result.returncode, result.stderr),
                             (1, f"error: {arguments[1]} and b.guide are the same file: one would "
                                 "overwrite the other\n"))

    def test_older_file_survives_an_error(self):
        self.write("a.exr", "precious")
        self.assertEqual(self.run_program("render", "nothing.pbrt", "-o", "a.exr").returncode, 2)
        self.assertEqual((self.folder / "a.exr").read_text(), "precious")

    def test_dry_run_writes_nothing(self):
        result = self.render("--dry-run", "-o", "a.exr")
        self.assertEqual(self.files(), ["fog.pbrt"])
        self.assertEqual(result.stderr, "fog.pbrt: ready to render, 0 warnings\n")

    def test_statistics(self):
        result = self.render("--stats", "json", "-q", "--spp", "2")
        statistics = json.loads(result.stdout)
        self.assertEqual(statistics["samples_per_pixel"], 2)
        self.assertEqual(statistics["resolution"], [16, 8])
        self.assertEqual(statistics["paths"], 16 * 8 * 2)
        self.assertEqual(statistics["rejected"], {"not_a_number": 0, "infinite": 0, "negative": 0})
        self.assertEqual(statistics["outputs"], ["fog.exr"])
        result = self.render("--stats", "json", "-q", "--spp", "1", "--integrator", "learned",
                             "-o", "a.exr", "--dump-guiding", "a.guide")
        self.assertEqual(json.loads(result.stdout)["outputs"], ["a.exr", "a.guide"])
        self.assertIs(statistics["stopped_early"], False)
        self.assertEqual(result.stderr, "")

    def test_memory_of_guiding(self):
        disk = ('WorldBegin\nMaterial "diffuse"\nAttributeBegin\nRotate 90 1 0 0\n'
                'Shape "disk" "float radius" 1 "float height" -.2\nAttributeEnd')
        self.write("fog.pbrt", FOG.replace("WorldBegin", disk))
        used = {}
        for memory in ("1", "128"):
            result = self.render("--stats", "json", "-q", "--size", "64x32", "--spp", "16",
                                 "--set", f"learned.memory={memory}")
            used[memory] = json.loads(result.stdout)["counters"]["guiding.memory_bytes"]
        self.assertLess(used["1"], 1e6)
        self.assertGreater(used["128"], 1e6)
        result = self.run_program("render", "fog.pbrt", "--set", "learned.memory=0")
        self.assertEqual((result.returncode, result.stderr),
                         (1, 'error: option "learned.memory" is a positive number of MB, not "0"\n'))

    def test_quiet(self):
        result = self.render("--quiet")
        self.assertEqual((result.stdout, result.stderr), ("", ""))


class PictureTest(ProgramTest):
    def pixels(self, *arguments):
        self.render("-o", "a.exr", *arguments)
        channels = self.exr("a.exr").channels()
        return np.stack([channels[c] for c in "RGB"], axis=-1)

    def test_furnace_is_white(self):
        self.run_program("render", str(ROOT / "scenes/furnace.pbrt"), "-o", "a.exr")
        channels = self.exr("a.exr").channels()
        error = np.sqrt(channels["variance.G"].sum()) / channels["G"].size
        self.assertLess(abs(channels["G"].mean() - 1), 4 * error + 1e-5)

    def test_same_picture_with_any_number_of_threads(self):
        one = self.pixels("-t", "1", "--spp", "5")
        for threads in ("2", "7"):
            np.testing.assert_array_equal(self.pixels("-t", threads, "--spp", "5"), one)

    def test_seed_changes_the_picture(self):
        self.assertTrue((self.pixels("--seed", "1") != self.pixels("--seed", "2")).any())

    def test_sampler_changes_the_picture(self):
        self.assertTrue((self.pixels("--sampler", "sobol") !=
                         self.pixels("--sampler", "independent")).any())

    # Integrators that learn, learn from the pixels that they render.
    def test_crop_is_a_window_of_the_picture(self):
        walk = ("--integrator", "volpath")
        whole = self.pixels(*walk)
        part = self.pixels(*walk, "--crop", "4,2,12,6")
        self.assertEqual(self.exr("a.exr")["dataWindow"], (4, 2, 11, 5))
        self.assertEqual(self.exr("a.exr")["displayWindow"], (0, 0, 15, 7))
        np.testing.assert_array_equal(part, whole[2:6, 4:12])
        np.testing.assert_array_equal(self.pixels(*walk, "--crop", "0.25,0.25,0.75,0.75"), part)

    def test_size(self):
        self.assertEqual(self.pixels("--size", "12x20").shape, (20, 12, 3))

    def test_pixel_is_printed_and_leaves_files_alone(self):
        whole = self.pixels("--integrator", "volpath")
        self.assertEqual(self.files(), ["a.exr", "fog.pbrt"])
        text = self.render("--integrator", "volpath", "--pixel", "7,3").stdout
        self.assertEqual(self.files(), ["a.exr", "fog.pbrt"])
        words = text.split()
        self.assertEqual(words[:2], ["pixel", "7,3:"])
        np.testing.assert_allclose([float(w) for w in words[2:5]], whole[3, 7], rtol=1e-5)

    def test_orders_add_up(self):
        def mean(orders):
            """The picture's mean and its standard error."""
            self.render("-o", "a.exr", "--spp", "512", "--orders", orders)
            channels = self.exr("a.exr").channels()
            return (channels["G"].mean(),
                    np.sqrt(channels["variance.G"].sum()) / channels["G"].size)
        (one, error_1), (two, error_2), (both, error_12) = mean("1"), mean("2"), mean("1-2")
        self.assertLess(abs(one + two - both), 4 * np.sqrt(error_1**2 + error_2**2 + error_12**2))
        self.assertGreater(one, 10 * error_1)
        self.assertGreater(two, 4 * error_2)

    def test_exposure_brightens_png_only(self):
        self.render("-o", "dark.png", "-o", "dark.exr", "--exposure", "-3")
        self.render("-o", "bright.png", "-o", "bright.exr", "--exposure", "3")
        self.assertNotEqual((self.folder / "dark.png").read_bytes(),
                            (self.folder / "bright.png").read_bytes())
        np.testing.assert_array_equal(self.exr("dark.exr").channels()["R"],
                                      self.exr("bright.exr").channels()["R"])


# A lamp and what hides it, in fog; {there} and {back} move everything.
MOVED = """Film "rgb" "integer xresolution" 24 "integer yresolution" 16
Sampler "independent" "integer pixelsamples" 16
PixelFilter "box"
Integrator "volpath" "integer maxdepth" 4
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [.2 .2 .2] "rgb sigma_a" [0 0 0]
LookAt 0.3 0.2 -5  0 0 0  0 1 0
Translate {back}
MediumInterface "" "fog"
Camera "perspective" "float fov" 50
WorldBegin
Translate {there}
MediumInterface "fog" "fog"
Material "diffuse" "rgb reflectance" [.5 .5 .5]
Shape "sphere" "float radius" 9
Shape "trianglemesh" "point3 P" [-.5 -.6 -.3 .5 -.6 -.2 .4 .1 -.3] "integer indices" [0 1 2]
AreaLightSource "diffuse" "rgb L" [200 200 200] Translate 0 0 .1 Shape "sphere" "float radius" .05
"""


class MovedSceneTest(ProgramTest):
    """A scene far from the origin looks as it does at the origin."""

    def picture(self, integrator, there, back):
        self.write("moved.pbrt", MOVED.format(there=there, back=back))
        result = self.run_program("render", "moved.pbrt", "--integrator", integrator, "--float",
                                  "-q", "-o", "moved.exr")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.last = self.exr("moved.exr")
        channels = self.last.channels()
        return np.stack([channels[c] for c in "RGB"]).astype(float)

    def test_pictures_are_the_same(self):
        # Coordinates may differ in their last bits, so that a path here and there does another
        # thing; what is learned from it is in all pixels.
        for integrator, share, most in (("volpath", 0.9, 1e-5), ("jis", 0.9, 1e-5),
                                        ("learned", 0.5, 1e-3)):
            here = self.picture(integrator, "0 0 0", "0 0 0")
            moved = self.picture(integrator, "30000.3 -30000 0", "-30000.3 30000 0")
            self.assertLess(np.quantile(abs(moved - here) / here, share), most, integrator)

    def test_matrices_are_of_the_scenes_world(self):
        self.picture("volpath", "3000 -2000 0", "-3000 2000 0")
        for name in ("worldToCamera", "worldToNDC"):
            eye, target = (self.last[name] @ p for p in ([3000.3, -1999.8, -5, 1],
                                                         [3000, -2000, 0, 1]))
            np.testing.assert_allclose(eye[[0, 1]], [0, 0], atol=1e-3)
            expected = [0, 0] if name == "worldToCamera" else [0.5, 0.5]
            scale = 1 if name == "worldToCamera" else target[3]
            np.testing.assert_allclose(target[:2] / scale, expected, atol=1e-3)


if __name__ == "__main__":
    unittest.main()

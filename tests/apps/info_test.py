#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`tyndall info` for volume files and scenes."""

import json
import unittest

from program import ROOT, ProgramTest

VDB = ROOT / "../shared/scenes/data/vdb"


class SceneInfo(ProgramTest):
    def test_text(self):
        result = self.run_program("info", "fog.pbrt")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout, "\n".join([
            "fog.pbrt",
            "  picture   16x8, 4 spp, at most 3 scattering vertices, to fog.exr",
            "  shapes    1 sphere",
            "  lights    1 and 0 shapes that shine",
            "  media     homogeneous", ""]))

    def test_json(self):
        self.write("grid.pbrt", 'LookAt 1.1 2.2 3.3 0 0 0 0 1 0 Camera "perspective"\n'
                   'WorldBegin MakeNamedMedium "g" "string type" "uniformgrid" '
                   '"float density" 1 "rgb Le" [1 2 3]\nLightSource "infinite" Shape "trianglemesh" "point3 P" [0 0 0 1 0 0 0 1 0]')
        result = self.run_program("info", "--json", "fog.pbrt", "grid.pbrt")
        self.assertEqual(result.returncode, 0, result.stderr)
        fog, grid = json.loads(result.stdout)
        self.assertEqual(fog["shapes"], {"sphere": 1})
        self.assertEqual(fog["media"][0]["bounds"], None)
        self.assertEqual(grid["shapes"], {"triangle mesh": 1})
        self.assertEqual(grid["triangles"], 1)
        medium = grid["media"][0]
        self.assertEqual((medium["kind"], medium["glows"], medium["is_grey"]), ("grid", True, True))
        self.assertEqual(medium["bounds"], [[0, 0, 0], [1, 1, 1]])
        self.assertGreater(medium["memory_bytes"], 1000)

    def test_what_is_missing(self):
        result = self.run_program("info", "nowhere.vdb")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr, "error: nowhere.vdb: No such file or directory\n")
        self.write("text.vdb", "hello")
        result = self.run_program("info", "text.vdb")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stderr,
                         "error: text.vdb: it is neither an OpenVDB nor a NanoVDB file\n")
        result = self.run_program("info")
        self.assertEqual(result.returncode, 1)


@unittest.skipUnless(VDB.exists(), "no ../shared")
class VolumeInfo(ProgramTest):
    def info(self, *arguments):
        result = self.run_program("info", *arguments)
        if "TYNDALL_OPENVDB is off" in result.stderr:
            self.skipTest("no OpenVDB")
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def describe(self, *names):
        return json.loads(self.info("--json", *[VDB / name for name in names]))

    def test_vdb(self):
        smoke, = self.describe("ovdb_smoke1.vdb")
        self.assertEqual(smoke["kind"], "volume")
        grid, = smoke["grids"]
        self.assertEqual((grid["name"], grid["type"], grid["voxels"]),
                         ("density", "float", [111, 222, 112]))
        self.assertAlmostEqual(grid["voxel_size"][0], 0.47619, places=4)
        self.assertAlmostEqual(grid["max"], 5.71, delta=0.01)
        self.assertEqual(grid["compression"], "none")
        self.assertGreater(grid["memory_bytes"], 4 * grid["active_voxels"])

    def test_nvdb_agrees(self):
        vdb, nvdb = self.describe("ovdb_smoke1.vdb", "fvdb_smoke-blosc.nvdb")
        a, b = vdb["grids"][0], nvdb["grids"][0]
        self.assertEqual(b["name"], "")
        self.assertEqual(b["compression"], "blosc")
        self.assertEqual(a["voxels"], b["voxels"])
        self.assertAlmostEqual(a["max"], b["max"], places=5)

    def test_all_grids_and_empty_ones(self):
        fire, empty = self.describe("usd_densityAndHeat.vdb", "usd_smoke_000001.vdb")
        self.assertEqual({g["compression"] for g in fire["grids"]}, {"blosc"})
        self.assertEqual({g["name"] for g in fire["grids"]} & {"density", "heat"},
                         {"density", "heat"})
        density = next(g for g in empty["grids"] if g["name"] == "density")
        self.assertEqual((density["bounds"], density["min"], density["active_voxels"]),
                         (None, None, 0))

    def test_text(self):
        text = self.info(VDB / "oiio_sphereCd.vdb", VDB / "arnold_torus01.vdb")
        self.assertIn("vec3s, which cannot be a density or a temperature", text)
        self.assertRegex(text, r'(?m)^  "voxel_fog_density": float$')
        self.assertRegex(text, r"(?m)^    voxels    \d+ active in 22 x 9 x 22$")


if __name__ == "__main__":
    unittest.main()

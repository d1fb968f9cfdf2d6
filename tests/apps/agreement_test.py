# SPDX-License-Identifier: Apache-2.0
"""bench/agreement.py, end to end on a tiny scene: it agrees with itself, and sees a difference."""

import subprocess
import sys
import unittest

from program import PROGRAM, ROOT, ProgramTest, environment

# A ball of smoke under a bright sky, 16x16 pixels: what varies does so everywhere alike.
CLOUD = """Film "rgb" "integer xresolution" 16 "integer yresolution" 16 "string filename" "fog.exr"
Sampler "independent" "integer pixelsamples" 4
PixelFilter "box"
Integrator "volpath" "integer maxdepth" 2
MakeNamedMedium "smoke" "string type" "homogeneous" "rgb sigma_s" [.5 .5 .5] "rgb sigma_a" [.2 .2 .2]
LookAt 0 0 -5  0 0 0  0 1 0
Camera "perspective" "float fov" 30
WorldBegin
LightSource "infinite" "rgb L" [1 1 1]
Material "interface"
MediumInterface "smoke" ""
Shape "sphere" "float radius" 2
"""


class AgreementTest(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "scenes/fog").mkdir(parents=True)
        self.write_scene("[1 1 1]")

    def write_scene(self, radiance):
        self.write("scenes/fog/scene.pbrt", CLOUD.replace("[1 1 1]", radiance))

    def compare(self, integrators):
        return subprocess.run(
            [sys.executable, ROOT / "bench/agreement.py", "--program", PROGRAM, "--archetypes",
             "scenes", "--variants", "scene", "--integrators", integrators, "--output", "out",
             "--spp", "256"],
            cwd=self.folder, capture_output=True, text=True, timeout=120, env=environment())

    def test_sees_agreement_and_difference(self):
        result = self.compare("volpath,jis")
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        row = [cell.strip() for cell in result.stdout.splitlines()[2].split("|")[1:-1]]
        self.assertEqual(row[:4], ["fog", "scene", "volpath", "jis"])
        self.assertEqual(row[7], "1")
        self.assertLess(abs(float(row[4])), 4)

        # Pictures that are there stay; that of a brighter sky is another.
        self.write_scene("[1.1 1.1 1.1]")
        result = self.compare("volpath,equiangular")
        self.assertEqual(result.returncode, 1, result.stdout + result.stderr)
        self.assertIn("the least p of these", result.stdout)


if __name__ == "__main__":
    unittest.main()

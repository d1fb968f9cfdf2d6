# SPDX-License-Identifier: Apache-2.0
"""bench/efficiency.py, end to end on a tiny scene: it measures, goes on, and knows a gain."""

import subprocess
import sys
import unittest

from program import FOG, PROGRAM, ROOT, ProgramTest, environment

BEGIN, END = "<!-- efficiency.py: begin -->", "<!-- efficiency.py: end -->"


class EfficiencyTest(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "scenes/fog").mkdir(parents=True)
        self.write("scenes/fog/scene.pbrt", FOG)

    def measure(self, *arguments):
        return subprocess.run(
            [sys.executable, ROOT / "bench/efficiency.py", "--program", PROGRAM, "--archetypes",
             "scenes", "--variants", "full", "--integrators", "volpath,jis", "--output", "runs",
             "--seconds", "0.05", *arguments],
            cwd=self.folder, capture_output=True, text=True, timeout=120, env=environment())

    def test_measures_and_goes_on(self):
        result = self.measure("--seeds", "1")
        self.assertEqual(result.returncode, 0, result.stderr)
        first = {p: p.stat().st_mtime_ns for p in (self.folder / "runs").glob("*.npz")}
        self.assertEqual(len(first), 2)

        self.write("page.md", f"before\n{BEGIN}\nold\n{END}\nafter\n")
        result = self.measure("--seeds", "3", "--docs", "page.md")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(list((self.folder / "runs").glob("*.npz"))), 6)
        for path, time in first.items():
            self.assertEqual(path.stat().st_mtime_ns, time)

        rows = [[cell.strip() for cell in line.split("|")[1:-1]]
                for line in result.stdout.splitlines()[2:]]
        self.assertEqual([row[1] for row in rows], ["volpath", "jis"])
        # At equal samples, near a lamp in fog: a factor of tens.
        gain = float(rows[1][6].split("/")[0])
        self.assertGreater(gain, 2)

        page = (self.folder / "page.md").read_text()
        self.assertTrue(page.startswith(f"before\n{BEGIN}\nCommit "))
        self.assertTrue(page.endswith(f"{END}\nafter\n"))
        self.assertIn(result.stdout.strip(), page)

    def test_other_conditions(self):
        self.assertEqual(self.measure("--seeds", "1").returncode, 0)
        result = self.measure("--seeds", "1", "--threads", "1")
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stderr, "runs holds runs of another program, --seconds or "
                                        "--threads: remove it, or give another --output\n")


if __name__ == "__main__":
    unittest.main()

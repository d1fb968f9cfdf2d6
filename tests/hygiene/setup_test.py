#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs tools/setup.sh with false dpkg-query, apt-get, sudo and id, and reads what it did."""

import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SETUP = pathlib.Path(__file__).resolve().parents[2] / "tools" / "setup.sh"
REAL = ("bash", "dirname", "sed", "tr", "grep", "env")


class SetupTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "tools").mkdir()
        shutil.copy(SETUP, self.root / "tools")
        (self.root / "tools/debian-packages.txt").write_text("# list\n[build]\ng++\n\n[test]\nlibfmt-dev  # text\n")
        self.bin = self.root / "bin"
        self.bin.mkdir()
        for name in REAL:
            (self.bin / name).symlink_to(shutil.which(name))
        self.log = self.root / "log"

    def fake(self, name, script):
        path = self.bin / name
        path.write_text(f"#!/bin/bash\n{script}\n")
        path.chmod(0o755)

    def machine(self, installed, user, sudo=None, apt_status=0):
        lines = "".join(f"echo installed {name}\n" for name in installed)
        self.fake("dpkg-query", lines + "exit 1")  # it fails where a package is unknown
        self.fake("id", f"echo {user}")
        self.fake("apt-get", f'echo "$DEBIAN_FRONTEND apt-get $*" >> {self.log}; exit {apt_status}')
        if sudo is not None:
            self.fake("sudo", f'[ "$1" = -n ] && exit {sudo}; echo sudo >> {self.log}; exec "$@"')

    def run_setup(self, *groups):
        result = subprocess.run([self.root / "tools/setup.sh", *groups], env={"PATH": str(self.bin)},
                                stdin=subprocess.DEVNULL, capture_output=True, text=True)
        return result, self.log.read_text() if self.log.exists() else ""

    def test_nothing_to_do(self):
        self.machine(["g++", "libfmt-dev:amd64"], user=0)
        result, log = self.run_setup()
        self.assertEqual((result.returncode, result.stdout, result.stderr, log), (0, "", "", ""))

    def test_root_installs_only_what_is_missing(self):
        self.machine(["g++"], user=0)
        result, log = self.run_setup()
        self.assertEqual(result.returncode, 0, result.stderr)
        options = "-o Dpkg::Use-Pty=0 -qq"
        self.assertEqual(log, f"noninteractive apt-get {options} update\nnoninteractive apt-get "
                              f"{options} install -y --no-install-recommends libfmt-dev\n")

    def test_one_group_only(self):
        self.machine([], user=0)
        self.assertTrue(self.run_setup("build")[1].endswith(" --no-install-recommends g++\n"))

    def test_a_package_whose_name_only_begins_alike_does_not_count(self):
        self.machine(["g++", "libfmt-dev-extra"], user=0)
        self.assertIn("libfmt-dev", self.run_setup()[1])

    def test_sudo(self):
        self.machine(["g++"], user=1000, sudo=0)
        result, log = self.run_setup()
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("sudo\nnoninteractive apt-get", log)

    def check_refusal(self, reason):
        result, _ = self.run_setup()
        self.assertEqual(result.returncode, 1)
        self.assertEqual(
            result.stderr,
            f"setup: {reason}\nMissing Debian packages: libfmt-dev\nAs root: apt-get update && "
            "apt-get install --no-install-recommends libfmt-dev\n")

    def test_neither_root_nor_sudo(self):
        reason = "cannot install packages: not root, and sudo is not there or wants a password"
        self.machine(["g++"], user=1000)
        self.check_refusal(reason)
        self.machine(["g++"], user=1000, sudo=1)
        self.check_refusal(reason)

    def test_failing_apt(self):
        self.machine(["g++"], user=0, apt_status=100)
        self.check_refusal("apt-get update failed")

    def test_another_system(self):
        result, _ = self.run_setup()
        self.assertEqual(result.returncode, 0)
        self.assertEqual(result.stderr, "setup: this is not a Debian system; install what these "
                                        "packages hold yourself:\n  g++ libfmt-dev\n")


if __name__ == "__main__":
    unittest.main()

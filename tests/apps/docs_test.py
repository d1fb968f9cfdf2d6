#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every command of README.md and docs/*.md, and compares docs/cli.md with --help.

A fenced block that begins with ```sh is run, line by line, in a folder where `tyndall` and the
scenes are; one that begins with ```sh norun is only read: its make targets, presets and scripts
must exist. `docs_test.py --update` writes the help texts into docs/cli.md.
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

from program import PROGRAM, ROOT, environment

DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]
BLOCK = re.compile(r"^```(sh[^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
HELP = re.compile(r"(<!-- help: ([^>]*) -->\n```text\n).*?(^```$)", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)#:\s]+)(?:#[^)]*)?\)")


def blocks(is_run):
    """(document, command lines) of the blocks that are run, or of those that are not."""
    for document in DOCUMENTS:
        for kind, text in BLOCK.findall(document.read_text()):
            if (kind == "sh") == is_run:
                yield document.name, text.replace("\\\n", " ").splitlines()


def help_text(arguments):
    # TYNDALL_* defaults would show in help.
    return subprocess.run([PROGRAM, *arguments.split()], capture_output=True, text=True,
                          env=environment(), check=True).stdout.rstrip() + "\n"


def with_help(text):
    return HELP.sub(lambda m: m.group(1) + help_text(m.group(2)) + m.group(3), text)


class DocsTest(unittest.TestCase):
    def test_commands_run(self):
        count = 0
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "bin").mkdir()
            (folder / "bin/tyndall").symlink_to(PROGRAM.resolve())
            (folder / "scenes").symlink_to(ROOT / "scenes")
            # Small pictures: what is tested is the command, not the renderer.
            env = environment(PATH=f"{folder}/bin:{os.environ['PATH']}", TYNDALL_SIZE="32x18",
                              TYNDALL_SPP="2")
            for document, lines in blocks(is_run=True):
                for line in filter(None, (l.split(" #")[0].strip() for l in lines)):
                    with self.subTest(document=document, line=line):
                        result = subprocess.run(["bash", "-c", line], cwd=folder, env=env,
                                                capture_output=True, text=True, timeout=120)
                        self.assertIn(result.returncode, (0, 4), result.stderr)
                        count += 1
        self.assertGreater(count, 0)

    def test_other_commands_exist(self):
        makefile = (ROOT / "Makefile").read_text()
        presets = json.loads((ROOT / "CMakePresets.json").read_text())
        names = {p["name"] for kind in ("configurePresets", "testPresets") for p in presets[kind]}
        for document, lines in blocks(is_run=False):
            for line in lines:
                with self.subTest(document=document, line=line):
                    for target in re.findall(r"\bmake (\w+)", line):
                        self.assertRegex(makefile, rf"(?m)^{target}:")
                    for preset in re.findall(r"--preset (\w+)", line):
                        self.assertIn(preset, names)
                    for path in re.findall(r"\b(?:tools|bench|tests|scenes)/[\w./]+", line):
                        self.assertTrue((ROOT / path).exists(), path)

    def test_links_lead_somewhere(self):
        for document in [*DOCUMENTS, ROOT / "CHANGELOG.md", ROOT / "scenes/README.md"]:
            for target in LINK.findall(document.read_text()):
                with self.subTest(document=document.name, target=target):
                    self.assertTrue((document.parent / target).exists())

    def test_scene_format_names_everything(self):
        page = (ROOT / "docs/scene-format.md").read_text()
        source = ROOT / "src/tyndall/loader"
        names = re.findall(r'Directive\{"(\w+)"', (source / "directives.cpp").read_text())
        for file, table in (("light", "Light"), ("material", "Material"), ("medium", "Medium"),
                            ("shape", "Shape")):
            text = (source / f"make_{file}.cpp").read_text()
            names += re.findall(rf'{table}Type\{{"(\w+)", make_\w+\}}', text)
        self.assertGreater(len(names), 50)
        for name in set(names) - {"hair", "none"}:
            with self.subTest(name=name):
                self.assertIn(f"`{name}`", page)

    def test_help_is_up_to_date(self):
        text = (ROOT / "docs/cli.md").read_text()
        self.assertTrue(HELP.search(text))
        self.assertEqual(text, with_help(text), "run tests/apps/docs_test.py --update")


if __name__ == "__main__":
    if sys.argv[1:] == ["--update"]:
        page = ROOT / "docs/cli.md"
        page.write_text(with_help(page.read_text()))
    else:
        unittest.main()

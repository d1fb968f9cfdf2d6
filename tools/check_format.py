#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that sources are formatted as .clang-format says; with --fix, formats them.

Only clang-format 14 (Debian 12) counts, since versions differ. Exit status 77 if it is not here.
"""

import re
import shutil
import subprocess
import sys

import check_program

FOLDERS = ("src", "apps", "tests", "bench", "python")
VERSION = "14"


def find_clang_format():
    for name in (f"clang-format-{VERSION}", "clang-format"):
        path = shutil.which(name)
        if path:
            text = subprocess.run([path, "--version"], capture_output=True, text=True).stdout
            if re.search(rf"version {VERSION}\.", text):
                return path
    return None


def main():
    parser = check_program.argument_parser(__doc__)
    parser.add_argument("--fix", action="store_true", help="format the files")
    arguments = parser.parse_args()
    clang_format = find_clang_format()
    if clang_format is None:
        print(f"format: skipped, clang-format {VERSION} is not installed")
        return 77
    files = [path for folder in FOLDERS for path in sorted((arguments.root / folder).rglob("*"))
             if path.suffix in (".h", ".cpp")]
    if not files:
        print("format: no files")
        return 0
    mode = ["-i"] if arguments.fix else ["--dry-run", "-Werror"]
    return subprocess.run([clang_format, "--style=file", *mode, *files]).returncode


if __name__ == "__main__":
    sys.exit(main())

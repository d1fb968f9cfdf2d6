#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks what a formatter does not: license lines, sizes, leftovers, paths of somebody's machine."""

import re
import sys

import check_program

FOLDERS = ("src", "apps", "tests", "bench", "tools", "python", "docs", "scenes", "cmake")
LICENSED = (".h", ".cpp", ".py", ".sh")
TEXT = LICENSED + (".md", ".txt", ".cmake", ".pbrt", ".bib", ".in")
MAX_FILE, MAX_FUNCTION = 600, 100  # lines

# Written in two parts so that this file does not complain about itself.
LEFTOVERS = re.compile(r"\b(TO" + r"DO|FIX" + r"ME|XX" + r"X|HA" + r"CK)\b(?!\s*\(?#\d+)")
MACHINE_PATHS = re.compile(r"(?<![\w.])/(ho" + r"me|ro" + r"ot|wo" + r"rk|Us" + r"ers|mn" + r"t)/\w")
NOT_A_FUNCTION = re.compile(r"(namespace|class|struct|enum|union|extern|using|template|#|//|\})")


def long_functions(lines):
    """Yields (line number, length) of functions that are too long, by where braces close."""
    start = None
    for number, line in enumerate(lines, 1):
        if start is None and re.match(r"\S", line) and not NOT_A_FUNCTION.match(line):
            start = number
        if start is not None and (line == "}" or re.match(r"\S.*;$", line)):
            if number - start + 1 > MAX_FUNCTION:
                yield start, number - start + 1
            start = None


def check_lines(lines):
    for number, line in enumerate(lines, 1):
        if LEFTOVERS.search(line):
            yield number, "an open end without an issue number"
        if MACHINE_PATHS.search(line):
            yield number, "a path of somebody's machine"
        if line.rstrip() != line:
            yield number, "spaces at the end of the line"
        if "\t" in line:
            yield number, "a tab"


def check_source(lines, suffix):
    if suffix in LICENSED and not any("SPDX-License-Identifier: Apache-2.0" in l for l in lines[:2]):
        yield 1, "no SPDX-License-Identifier in the first two lines"
    if len(lines) > MAX_FILE and suffix in LICENSED:
        yield 1, f"{len(lines)} lines, at most {MAX_FILE}"
    if suffix == ".cpp":
        for number, length in long_functions(lines):
            yield number, f"a function of {length} lines, at most {MAX_FUNCTION}"
    if suffix in (".h", ".cpp"):
        for number, line in enumerate(lines, 1):
            if re.match(r"#\s*if\s+0\b", line):
                yield number, "code that is switched off"
    if suffix == ".h" and "#pragma once" not in lines[:4]:
        yield 1, "no #pragma once"


def check(root):
    """All complaints about the tree at `root`."""
    complaints = []
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in TEXT or not path.is_file():
                continue
            text = path.read_text()
            lines = text.splitlines()
            found = list(check_lines(lines)) + list(check_source(lines, path.suffix))
            if text and not text.endswith("\n"):
                found.append((len(lines), "no newline at the end"))
            complaints += [f"{path.relative_to(root)}:{n}: {what}" for n, what in sorted(found)]
    return complaints


if __name__ == "__main__":
    sys.exit(check_program.run("style", __doc__, check))

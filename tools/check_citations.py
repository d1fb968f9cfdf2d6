#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that comments and docs cite keys of docs/references.bib, and that each key is cited.

A citation is a key in square brackets, with a place or not: [KF12], [PBRT4, Sec. 11.3],
[KF12; GKH13]. Keys are an author's name or initials and the year's last digits.
"""

import re
import sys

import check_program

KEY = re.compile(r"[A-Z][A-Za-z]*\d{1,2}[a-z]?$")
BRACKETS = re.compile(r"\[([^\[\]]+)\](?![(\[])")
ENTRY = re.compile(r"^@\w+\{([^,\s]+),", re.MULTILINE)
FOLDERS = ("src", "apps", "tests", "bench", "python", "docs")
COMMENT = {".h": "//", ".cpp": "//", ".py": "#", ".txt": "#", ".cmake": "#", ".md": ""}


def comment_of(line, marker):
    """The part of a line that is a comment; all of it where the marker is empty."""
    return line[line.index(marker):] if marker in line else ""


def cited_keys(text):
    """The keys that one piece of prose cites."""
    for inside in BRACKETS.findall(text):
        for part in inside.split(";"):
            first = part.split(",")[0].strip()
            if KEY.match(first):
                yield first


def citations(root):
    """Yields (file, line number, key)."""
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            marker = COMMENT.get(path.suffix)
            if marker is None or not path.is_file():
                continue
            # A citation may be broken over two lines; keys may not.
            for number, line in enumerate(path.read_text().splitlines(), 1):
                for key in cited_keys(comment_of(line, marker)):
                    yield path.relative_to(root), number, key


def check(root):
    """All complaints about the tree at `root`."""
    entries = ENTRY.findall((root / "docs" / "references.bib").read_text())
    complaints = [f"docs/references.bib: {key} stands there twice"
                  for key in sorted(set(entries)) if entries.count(key) > 1]
    cited = set()
    for path, number, key in citations(root):
        cited.add(key)
        if key not in entries:
            complaints.append(f"{path}:{number}: [{key}] is not in docs/references.bib")
    complaints += [f"docs/references.bib: nothing cites [{key}]"
                   for key in entries if key not in cited]
    return complaints


if __name__ == "__main__":
    sys.exit(check_program.run("citations", __doc__, check))

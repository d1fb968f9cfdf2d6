# SPDX-License-Identifier: Apache-2.0
"""What the check_*.py programs share: their arguments, their output and their exit status."""

import argparse
import pathlib


def argument_parser(documentation):
    """A parser that takes the tree to check, this one by default."""
    parser = argparse.ArgumentParser(description=documentation.splitlines()[0])
    parser.add_argument("root", nargs="?", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent.parent)
    return parser


def run(name, documentation, check):
    """Prints the complaints that check(root) returns; the exit status is 1 if there are any."""
    complaints = check(argument_parser(documentation).parse_args().root)
    print("\n".join(complaints) or f"{name}: no complaints")
    return 1 if complaints else 0

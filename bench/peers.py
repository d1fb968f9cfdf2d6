# SPDX-License-Identifier: Apache-2.0
"""Other people's implementations to compare with: a virtual environment that scripts install.

A script calls use("mitsuba", ...) first; the function returns inside of an environment that has
those packages, or ends the script with 77, which test runners take for "skipped".
"""

import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Versions that the tests were written against.
VERSIONS = {"mitsuba": "3.9.1", "flip-evaluator": "1.7", "pillow": None, "numpy": None}
MODULES = {"flip-evaluator": "flip_evaluator", "pillow": "PIL"}
STARTED = "TYNDALL_PEERS_STARTED"


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def has(python, packages):
    imports = "; ".join(f"import {MODULES.get(p, p)}" for p in packages)
    return subprocess.run([python, "-c", imports], capture_output=True).returncode == 0


def install(python, venv, packages):
    requirements = [p + (f"=={VERSIONS[p]}" if VERSIONS[p] else "") for p in packages]
    try:
        if not python.exists():
            subprocess.run([sys.executable, "-m", "venv", venv], check=True, capture_output=True,
                           text=True)
        subprocess.run([python, "-m", "pip", "install", "-q", "--only-binary", ":all:",
                        *requirements], check=True, capture_output=True, text=True, timeout=600)
    except (subprocess.SubprocessError, OSError) as error:
        text = getattr(error, "stderr", None) or str(error)
        skip(f"cannot install {', '.join(packages)}: {text.strip().splitlines()[-1]}")


def use(*packages):
    """Goes on in an environment that has the packages: this script starts again if need be."""
    if STARTED in os.environ:
        return
    venv = pathlib.Path(os.environ.get("TYNDALL_PEERS", ROOT / "build" / "peers"))
    python = venv / "bin" / "python"
    if not (python.exists() and has(python, packages)):
        install(python, venv, packages)
    os.execve(python, [str(python), *sys.argv], {**os.environ, STARTED: "1"})

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Installs what the comparisons with other implementations need, once for all of them."""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "bench"))
import peers  # noqa: E402

peers.use("mitsuba", "numpy", "flip-evaluator")
print(sys.prefix)

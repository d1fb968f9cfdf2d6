# SPDX-License-Identifier: Apache-2.0
"""What the end-to-end tests share: the program under test, small scenes, EXR files."""

import os
import pathlib
import struct
import subprocess
import tempfile
import unittest
import zlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(os.environ.get("PROGRAM_UNDER_TEST", ROOT / "build/release/tyndall"))

# A lamp in fog, 16x8 pixels.
FOG = """Film "rgb" "integer xresolution" 16 "integer yresolution" 8 "string filename" "fog.exr"
Sampler "independent" "integer pixelsamples" 4
PixelFilter "box"
Integrator "volpath" "integer maxdepth" 3
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [.2 .2 .2] "rgb sigma_a" [0 0 0]
LookAt 0 0 -5  0 0 0  0 1 0
MediumInterface "" "fog"
Camera "perspective" "float fov" 50
WorldBegin
LightSource "point" "rgb I" [8 8 8]
Material "diffuse" "rgb reflectance" [0 0 0]
MediumInterface "fog" "fog"
Shape "sphere" "float radius" 30
"""


def environment(**variables):
    """The environment without anything that changes what the program does."""
    kept = {k: v for k, v in os.environ.items() if not k.startswith("TYNDALL_")}
    return {**kept, **variables}


def write_pfm(path, image):
    """Writes a color image (height, width, 3), row 0 on top."""
    height, width, _ = image.shape
    path.write_bytes(b"PF\n%d %d\n-1.0\n" % (width, height) + image[::-1].astype("<f4").tobytes())


class ProgramTest(unittest.TestCase):
    """Runs the program in an empty folder that holds fog.pbrt."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.write("fog.pbrt", FOG)

    def write(self, name, text):
        (self.folder / name).write_text(text)

    def run_program(self, *arguments, **variables):
        return subprocess.run([PROGRAM, *arguments], cwd=self.folder, capture_output=True,
                              text=True, timeout=120, env=environment(**variables))

    def start_program(self, *arguments):
        return subprocess.Popen([PROGRAM, *arguments], cwd=self.folder, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, env=environment())

    def render(self, *arguments, **variables):
        """Renders fog.pbrt and expects success."""
        result = self.run_program("render", "fog.pbrt", *arguments, **variables)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def exr(self, name):
        return ExrFile(self.folder / name)


class ExrFile:
    """Attributes and channels of a scanline EXR file with ZIP compression or none."""

    def __init__(self, path):
        self.data = path.read_bytes()
        assert struct.unpack_from("<ii", self.data) == (20000630, 2), "not a scanline EXR file"
        self.types, self.raw = {}, {}
        self.position = 8
        while self.data[self.position]:
            name, kind = self._string(), self._string()
            size = self._unpack("<i")
            self.types[name] = kind
            self.raw[name] = self.data[self.position:self.position + size]
            self.position += size
        self.position += 1

    def _string(self):
        end = self.data.index(0, self.position)
        text = self.data[self.position:end].decode()
        self.position = end + 1
        return text

    def _unpack(self, form):
        value = struct.unpack_from(form, self.data, self.position)[0]
        self.position += struct.calcsize(form)
        return value

    def __contains__(self, name):
        return name in self.raw

    def __getitem__(self, name):
        raw = self.raw[name]
        return {"string": lambda: raw.decode(),
                "float": lambda: struct.unpack("<f", raw)[0],
                "int": lambda: struct.unpack("<i", raw)[0],
                "m44f": lambda: np.frombuffer(raw, "<f4").reshape(4, 4),
                "box2i": lambda: struct.unpack("<4i", raw)}[self.types[name]]()

    def channel_types(self):
        """Channel names, in the file's order, with their NumPy types."""
        raw, result = self.raw["channels"], {}
        position = 0
        while raw[position]:
            end = raw.index(0, position)
            kind = struct.unpack_from("<i", raw, end + 1)[0]
            result[raw[position:end].decode()] = {0: "<u4", 1: "<f2", 2: "<f4"}[kind]
            position = end + 1 + 16
        return result

    def channels(self):
        """Channels by name, (height, width)."""
        x0, y0, x1, y1 = self["dataWindow"]
        width, height = x1 - x0 + 1, y1 - y0 + 1
        compression = self.raw["compression"][0]
        lines = {0: 1, 2: 1, 3: 16}[compression]
        blocks = -(-height // lines)
        offsets = struct.unpack_from(f"<{blocks}Q", self.data, self.position)
        types = self.channel_types()
        result = {name: np.empty((height, width), kind) for name, kind in types.items()}
        for offset in offsets:
            y, size = struct.unpack_from("<ii", self.data, offset)
            rows = min(lines, y1 - y + 1)
            expected = rows * width * sum(np.dtype(kind).itemsize for kind in types.values())
            block = decompress(self.data[offset + 8:offset + 8 + size], expected)
            position = 0
            for row in range(y - y0, y - y0 + rows):
                for name, kind in types.items():
                    result[name][row] = np.frombuffer(block, kind, width, position)
                    position += width * np.dtype(kind).itemsize
        return result


def decompress(block, expected):
    """Undoes EXR's ZIP: deflate, then differences of bytes, then two interleaved halves."""
    if len(block) == expected:
        return block
    data = np.frombuffer(zlib.decompress(block), np.uint8).astype(np.int64)
    data[1:] -= 128
    data = np.cumsum(data).astype(np.uint8)
    half = (expected + 1) // 2
    result = np.empty(expected, np.uint8)
    result[0::2], result[1::2] = data[:half], data[half:]
    return result.tobytes()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the library's folders include only what lies below them.

LAYERS is the table of layers: a folder of src/tyndall/ may include its own files and folders with
a lower number. Third-party headers stay out of our headers, and each library stays in the folder
and within the number of .cpp files that LIBRARIES grants it.
"""

import re
import sys

import check_program

LAYERS = {
    "math": 1,
    "sampling": 2,
    "geometry": 3,
    "media": 4,
    "materials": 4,
    "lights": 4,
    "image": 4,
    "scene": 5,
    "techniques": 6,
    "guiding": 7,
    "integrators": 8,
    "loader": 9,
}

# Library: (pattern of its headers, folders that may include it, most .cpp files that do).
LIBRARIES = {
    "Embree": (r"embree\d*/", {"geometry"}, 2),
    "oneTBB": (r"(one)?api/tbb|tbb/", {"math", "image", "integrators"}, 4),
    "OpenEXR": (r"Imf|Iex|Imath|OpenEXR/|half\.h", {"image"}, 2),
    "libpng": (r"png\.h", {"image"}, 1),
    "zlib": (r"zlib\.h", {"loader", "image", "media"}, 3),
    "OpenVDB": (r"openvdb/", {"media"}, 1),
    "Blosc": (r"blosc\.h", {"media"}, 1),
    "Boost": (r"boost/", {"geometry", "media", "lights", "scene", "integrators", "techniques", "guiding"}, 10),
    "NanoVDB": (r"nanovdb/", {"media"}, 2),
    "fast_float": (r"fast_float/", {"loader"}, 2),
    "fmt": (r"fmt/", set(LAYERS), 1000),
    "Eigen": (r"Eigen/", {"guiding"}, 2),
}

# A container that stands in for std::vector may stand in headers too.
VOCABULARY = {"boost/container/small_vector.hpp"}

# Learning is testable without a scene: these files know mathematics and sampling only.
PURE = re.compile(r"tyndall/guiding/(gaussian_mixture|online_em|vector_exp|byte_stream)")

STANDARD = re.compile(r"[a-z_0-9]+$|(sys|unistd|fcntl|sched|dlfcn)(/[a-z]+)?\.h$|[a-z0-9]+intrin\.h$")
INCLUDE = re.compile(r'^\s*#\s*include\s+([<"])([^>"]+)[>"]')


def includes(path):
    """Yields (line number, '<' or '"', name) for each #include of a file."""
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1), match.group(2)


def check_own_include(source, folder, name, root):
    """The complaint about an include of one of our own headers, or None."""
    parts = name.split("/")
    if parts[0] != "tyndall" or len(parts) < 3:
        return f'"{name}" is not a full path that begins with tyndall/'
    if not (source / name).is_file():
        return f'"{name}" does not exist'
    if parts[1] not in LAYERS:
        return f'"{name}": {parts[1]} is not a layer'
    if parts[1] != folder and LAYERS[parts[1]] >= LAYERS[folder]:
        return f'{folder} ({LAYERS[folder]}) must not include {parts[1]} ({LAYERS[parts[1]]})'
    relative = str(root)
    if PURE.match(relative) and parts[1] not in ("math", "sampling") and not PURE.match(name):
        return f'"{name}": mixtures and their training know only math and sampling'
    return None


def library_of(name):
    for library, (pattern, _, _) in LIBRARIES.items():
        if re.match(pattern, name):
            return library
    return None


def check_system_include(folder, path, name, users):
    """The complaint about an include in angle brackets, or None; notes who uses what."""
    if STANDARD.match(name):
        return None
    library = library_of(name)
    if library is None:
        return f"<{name}> belongs to no library in the table of tools/check_layers.py"
    if path.suffix == ".h" and name not in VOCABULARY:
        return f"<{name}>: a header must not include {library}"
    if folder not in LIBRARIES[library][1]:
        return f"<{name}>: {folder} must not include {library}"
    users.setdefault(library, set()).add(path)
    return None


def check(root):
    """All complaints about the tree at `root`."""
    source = root / "src"
    complaints, users = [], {}
    for path in sorted((source / "tyndall").rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        relative = path.relative_to(source)
        folder = relative.parts[1]
        if folder not in LAYERS:
            complaints.append(f"src/{relative}: {folder} is not a layer")
            continue
        if not is_listed(path):
            complaints.append(f"src/{relative}: not listed in the CMakeLists.txt of its folder")
        for number, quote, name in includes(path):
            complaint = (check_own_include(source, folder, name, relative) if quote == '"'
                         else check_system_include(folder, path, name, users))
            if complaint:
                complaints.append(f"src/{relative}:{number}: {complaint}")
    for library, paths in users.items():
        most = LIBRARIES[library][2]
        if len(paths) > most:
            names = ", ".join(sorted(p.name for p in paths))
            complaints.append(f"{library} is included by {len(paths)} files, at most {most}: {names}")
    return complaints + check_command_line(root)


def is_listed(path):
    lists = path.parent / "CMakeLists.txt"
    return lists.is_file() and re.search(rf"\b{re.escape(path.name)}\b", lists.read_text())


def check_command_line(root):
    """CLI11 is slow to compile: one file includes it."""
    complaints = []
    for path in sorted((root / "apps").rglob("*")):
        if path.suffix not in (".h", ".cpp") or path.name == "arguments.cpp":
            continue
        complaints += [f"{path.relative_to(root)}:{number}: only arguments.cpp includes CLI11"
                       for number, _, name in includes(path) if name.startswith("CLI/")]
    return complaints


if __name__ == "__main__":
    sys.exit(check_program.run("layers", __doc__, check))

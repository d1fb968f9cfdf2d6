#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the geometry and the density grid of the scenes in scenes/, which are CC0.

Units are meters; y is up. The hall has pointed windows on its right side, columns, and a tiled
floor; the lantern is a pierced ball; the plume is the smoke of a small fire.
"""

import argparse
import math
import pathlib

import numpy as np

# The hall: x from -HALF_WIDTH to HALF_WIDTH, z from 0 to LENGTH.
HALF_WIDTH, HEIGHT, LENGTH, WALL = 4.0, 7.0, 26.0, 0.5
BAYS = 6
WINDOW_WIDTH, SILL, SPRING = 1.5, 1.6, 3.9  # the arch begins at height SPRING


class Mesh:
    """Quads and triangles, written as one trianglemesh."""

    def __init__(self):
        self.points, self.triangles = [], []

    def quad(self, a, b, c, d):
        first = len(self.points)
        self.points += [a, b, c, d]
        self.triangles += [(first, first + 1, first + 2), (first, first + 2, first + 3)]

    def box(self, low, high):
        (x0, y0, z0), (x1, y1, z1) = low, high
        for x in (x0, x1):
            self.quad((x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1))
        for y in (y0, y1):
            self.quad((x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))
        for z in (z0, z1):
            self.quad((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))

    def ring(self, profile, x, z, sides=24):
        """A surface of revolution about the vertical axis through (x, z): (radius, y) pairs."""
        def at(radius, y, i):
            angle = 2 * math.pi * i / sides
            return (x + radius * math.cos(angle), y, z + radius * math.sin(angle))
        for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
            for i in range(sides):
                self.quad(at(r0, y0, i), at(r0, y0, i + 1), at(r1, y1, i + 1), at(r1, y1, i))

    def text(self):
        numbers = "\n".join("  " + " ".join(f"{v:.4g}" for v in p) for p in self.points)
        indices = "\n".join("  " + " ".join(map(str, t)) for t in self.triangles)
        return (f'Shape "trianglemesh" "point3 P" [\n{numbers}\n]\n'
                f'"integer indices" [\n{indices}\n]\n')


def arch(z, steps=12):
    """The outline of a pointed window around z, from the right sill over the top to the left:
    two arcs, each centered on the other's foot."""
    half = WINDOW_WIDTH / 2
    arc = [(half - WINDOW_WIDTH + WINDOW_WIDTH * math.cos(a), WINDOW_WIDTH * math.sin(a))
           for a in np.linspace(0, math.pi / 3, steps)]
    right = [(half, SILL)] + [(dz, SPRING + dy) for dz, dy in arc]
    left = [(-dz, y) for dz, y in reversed(right[:-1])]
    return [(z + dz, y) for dz, y in right + left]


def window_wall(mesh):
    """The wall with windows, with its inner and outer face and the reveals between them."""
    bay = LENGTH / BAYS
    for i in range(BAYS):
        z0, z1, middle = i * bay, (i + 1) * bay, (i + 0.5) * bay
        outline = arch(middle)
        right, left = outline[0][0], outline[-1][0]
        for x in (HALF_WIDTH, HALF_WIDTH + WALL):
            mesh.quad((x, 0, z0), (x, HEIGHT, z0), (x, HEIGHT, left), (x, 0, left))
            mesh.quad((x, 0, right), (x, HEIGHT, right), (x, HEIGHT, z1), (x, 0, z1))
            mesh.quad((x, 0, left), (x, SILL, left), (x, SILL, right), (x, 0, right))
            for (za, ya), (zb, yb) in zip(outline[1:-1], outline[2:-1]):
                mesh.quad((x, ya, za), (x, HEIGHT, za), (x, HEIGHT, zb), (x, yb, zb))
        for (za, ya), (zb, yb) in zip(outline, outline[1:] + outline[:1]):
            mesh.quad((HALF_WIDTH, ya, za), (HALF_WIDTH + WALL, ya, za),
                      (HALF_WIDTH + WALL, yb, zb), (HALF_WIDTH, yb, zb))


def shell(mesh):
    """The other walls, the ceiling and its beams."""
    w, h, end, out = HALF_WIDTH, HEIGHT, LENGTH, HALF_WIDTH + WALL
    mesh.quad((-w, 0, 0), (-w, h, 0), (-w, h, end), (-w, 0, end))
    mesh.quad((-w, h, 0), (out, h, 0), (out, h, end), (-w, h, end))
    for z in (0, end):
        mesh.quad((-w, 0, z), (out, 0, z), (out, h, z), (-w, h, z))
    for i in range(1, BAYS):
        z = i * LENGTH / BAYS
        mesh.box((-w, h - 0.4, z - 0.15), (w, h, z + 0.15))


def columns(mesh):
    profile = [(0.42, 0), (0.42, 0.25), (0.34, 0.35), (0.26, 0.5), (0.24, 5.9), (0.3, 6.0),
               (0.42, 6.25), (0.46, 6.6)]
    for i in range(1, BAYS):
        for x in (-1.9, 1.9):
            mesh.ring(profile, x, i * LENGTH / BAYS)


def floor_tiles(light, dark, size=1.0):
    columns_of_tiles = round((2 * HALF_WIDTH + WALL) / size + 0.5)
    for i in range(columns_of_tiles):
        for j in range(round(LENGTH / size)):
            x0, z0 = -HALF_WIDTH + i * size, j * size
            x1 = min(x0 + size, HALF_WIDTH + WALL)
            mesh = light if (i + j) % 2 == 0 else dark
            mesh.quad((x0, 0, z0), (x1, 0, z0), (x1, 0, z0 + size), (x0, 0, z0 + size))


def hall():
    """The include file of the hall: one named material before each mesh."""
    walls, stone, light, dark = Mesh(), Mesh(), Mesh(), Mesh()
    window_wall(walls)
    shell(walls)
    columns(stone)
    floor_tiles(light, dark)
    parts = [("wall", walls), ("stone", stone), ("light tile", light), ("dark tile", dark)]
    return "# Written by tools/make_scenes.py.\n" + "".join(
        f'NamedMaterial "{name}"\n{mesh.text()}' for name, mesh in parts)


def on_sphere(radius, latitude, longitude):
    """A point on a sphere around the origin; angles in radians."""
    return (radius * math.cos(latitude) * math.cos(longitude), radius * math.sin(latitude),
            radius * math.cos(latitude) * math.sin(longitude))


def pierced_cell(mesh, radius, latitude, longitude, half_height, half_width, hole):
    """A patch of a sphere with a round hole of `hole` radians: a ring of quads between both."""
    corners = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]
    outer = [on_sphere(radius, latitude + half_height * v, longitude + half_width * u)
             for u, v in corners]
    inner = [on_sphere(radius, latitude + hole * math.sin(a),
                       longitude + hole * math.cos(a) / math.cos(latitude))
             for a in (k * math.pi / 4 for k in range(8))]
    for k in range(8):
        mesh.quad(outer[k], outer[k - 1], inner[k - 1], inner[k])


def lantern(radius=0.4, rings=5, cells=12):
    """The include file of the lantern: a ball with round holes in rings, around the origin."""
    mesh = Mesh()
    reach = math.radians(62)
    half = reach / rings
    for i in range(rings):
        latitude = -reach + (2 * i + 1) * half
        hole = 0.105 if i % 2 == 0 else 0.075
        for j in range(cells):
            longitude = 2 * math.pi * (j + 0.5 * (i % 2)) / cells
            pierced_cell(mesh, radius, latitude, longitude, half, math.pi / cells, hole)
    for sign in (-1, 1):
        for j in range(2 * cells):
            a, b = math.pi * j / cells, math.pi * (j + 1) / cells
            pole = (0, sign * radius, 0)
            mesh.quad(on_sphere(radius, sign * reach, a), on_sphere(radius, sign * reach, b), pole,
                      pole)
    return "# Written by tools/make_scenes.py.\n" + mesh.text()


def smooth_noise(shape, cells, random):
    """Trilinear interpolation, smoothed, of random numbers on a lattice of `cells` cells."""
    lattice = random.standard_normal([c + 1 for c in cells])
    for axis, (n, c) in enumerate(zip(shape, cells)):
        x = (np.arange(n) + 0.5) / n * c
        i = np.minimum(x.astype(int), c - 1)
        f = x - i
        f = f * f * (3 - 2 * f)
        low, high = np.take(lattice, i, axis), np.take(lattice, i + 1, axis)
        f = f.reshape([-1 if k == axis else 1 for k in range(3)])
        lattice = low * (1 - f) + high * f
    return lattice


def turbulence(shape, cells, octaves, random):
    return sum(smooth_noise(shape, [c << k for c in cells], random) * 0.55**k
               for k in range(octaves))


def plume_density(nx=44, ny=72, nz=44, seed=7):
    """Smoke in [0, 1], indices (z, y, x): a column that widens, leans and breaks up as it rises."""
    random = np.random.default_rng(seed)
    shape = (nz, ny, nx)
    z, y, x = np.meshgrid(*[(np.arange(n) + 0.5) / n for n in shape], indexing="ij")
    sway = [turbulence(shape, (2, 3, 2), 3, random) for _ in range(2)]
    x = x - 0.5 - (0.10 * sway[0] + 0.05) * y
    z = z - 0.5 - 0.10 * sway[1] * y
    radius = 0.06 + 0.26 * y**0.8
    body = 1 - np.hypot(x, z) / radius + 0.33 * turbulence(shape, (4, 6, 4), 4, random) * (0.3 + y)
    density = np.clip(2.2 * body, 0, 1) * np.clip(8 * (1 - y), 0, 1) * np.clip(20 * y, 0, 1)
    density *= 1 - 0.55 * y
    for axis in range(3):  # zero at the border: the box must not show
        edge = np.ones(shape[axis])
        edge[[0, -1]] = 0
        density *= edge.reshape([-1 if k == axis else 1 for k in range(3)])
    return density


def plume():
    density = plume_density()
    nz, ny, nx = density.shape
    text = "\n".join(" ".join(f"{v:.2g}".lstrip("0") or "0" for v in np.round(row, 2))
                     for row in density.reshape(-1, nx))
    return ("# Written by tools/make_scenes.py.\n"
            f'MakeNamedMedium "smoke" "string type" "uniformgrid" "rgb sigma_a" [2 2.2 2.4]\n'
            f'"rgb sigma_s" [26 25 24] "float g" 0.35 "point3 p0" [-1 0 -1] "point3 p1" [1 3.27 1]\n'
            f'"integer nx" {nx} "integer ny" {ny} "integer nz" {nz} "float density" [\n{text}\n]\n')


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", type=pathlib.Path,
                        default=pathlib.Path(__file__).resolve().parent.parent / "scenes")
    folder = parser.parse_args().folder
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "hall_geometry.pbrt").write_text(hall())
    (folder / "lantern_geometry.pbrt").write_text(lantern())
    (folder / "plume_density.pbrt").write_text(plume())


if __name__ == "__main__":
    main()

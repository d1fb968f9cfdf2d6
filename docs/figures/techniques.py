#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the figures of docs/techniques.md: for each random decision, what the formulas of that
page draw (bars: a histogram of samples) against the integrand (line: normalised by quadrature,
from its definition alone). Needs nothing but Python; writes SVG files beside itself.

    docs/figures/techniques.py [--samples N]
"""

import argparse
import bisect
import math
import random
from pathlib import Path

WIDTH, HEIGHT, MARGIN = 340, 210, 34
H, FOOT, T_MAX = 1.0, 2.0, 5.0  # the light beside the ray, and the ray's end


def phase(g, cosine):
    return (1 - g * g) / (4 * math.pi) / (1 + g * g - 2 * g * cosine) ** 1.5


class Tabulated:
    """Draws from a function on [low, high] by its numeric integral."""

    def __init__(self, f, low, high, cells=4000):
        self.low, self.step = low, (high - low) / cells
        self.sums = [0.0]
        for i in range(cells):
            self.sums.append(self.sums[-1] + f(low + (i + 0.5) * self.step) * self.step)

    def total(self):
        return self.sums[-1]

    def sample(self, u):
        target = u * self.total()
        i = min(bisect.bisect_right(self.sums, target), len(self.sums) - 1) - 1
        part = (target - self.sums[i]) / (self.sums[i + 1] - self.sums[i])
        return self.low + (i + part) * self.step


def alpha_at(t):
    return math.atan2(H, FOOT - t)


def distance_at(t):
    return math.hypot(H, t - FOOT)


def single_scattering(g):
    """t of single scattering: the angle alpha in proportion to the phase function."""
    table = Tabulated(lambda a: phase(g, math.cos(a)), alpha_at(0), alpha_at(T_MAX))
    draw = lambda u: FOOT - H / math.tan(table.sample(u[0]))
    exact = lambda t: phase(g, math.cos(alpha_at(t))) / distance_at(t) ** 2
    return draw, exact, (0, T_MAX), "t"


def scattered_along(g, theta, steps=300):
    """P(theta): the phase function over the angles at the second vertex, from theta to pi."""
    step = (math.pi - theta) / steps
    return sum(phase(g, math.cos(theta + (i + 0.5) * step)) for i in range(steps)) * step


def over_azimuth(g, alpha, theta, steps=128):
    a, b = math.cos(alpha) * math.cos(theta), math.sin(alpha) * math.sin(theta)
    step = 2 * math.pi / steps
    return sum(phase(g, a + b * math.cos((i + 0.5) * step)) for i in range(steps)) * step


def double_distance():
    """t_ab of isotropic double scattering: uniform in asinh(s / h)."""
    first, last = math.asinh(-FOOT / H), math.asinh((T_MAX - FOOT) / H)
    draw = lambda u: FOOT + H * math.sinh(first + u[0] * (last - first))
    return draw, lambda t: 1 / distance_at(t), (0, T_MAX), "t"


def double_polar_isotropic():
    """theta of isotropic double scattering: 1 - (1 - theta / pi)^2 is uniform."""
    draw = lambda u: math.pi * (1 - math.sqrt(1 - u[0]))
    # Over theta the sine of the sphere cancels that of the light scattered along.
    return draw, lambda theta: math.pi - theta, (0, math.pi), "theta"


def double_polar(g, alpha):
    """theta of anisotropic double scattering, given alpha."""
    exact = lambda theta: over_azimuth(g, alpha, theta) * scattered_along(g, theta)
    table = Tabulated(exact, 0, math.pi, 400)
    return lambda u: table.sample(u[0]), exact, (0, math.pi), "theta"


def azimuth(g, alpha, theta):
    """phi, given alpha and theta: an elliptic integral in tan(phi / 2) / e."""
    a = 1 + g * g - 2 * g * math.cos(alpha) * math.cos(theta)
    k = 2 * g * math.sin(alpha) * math.sin(theta) / a
    e = math.sqrt((1 - k) / (1 + k))
    table = Tabulated(
        lambda eta: math.hypot(1 - eta, e * eta) / math.hypot(1 - eta, eta) ** 3, 0, 1)

    def draw(u):
        v = 2 * u[0] - 1
        eta = table.sample(abs(v))
        return math.copysign(2 * math.atan2(e * eta, 1 - eta), v)

    return draw, lambda phi: (1 - k * math.cos(phi)) ** -1.5, (-math.pi, math.pi), "phi"


def histogram(draw, low, high, bins, n):
    counts = [0] * bins
    rng = random.Random(1)
    for i in range(n):
        x = draw(((i + rng.random()) / n,))
        counts[min(max(int((x - low) / (high - low) * bins), 0), bins - 1)] += 1
    return [c * bins / (n * (high - low)) for c in counts]


def panel(title, case, origin_x, n):
    draw, exact, (low, high), name = case
    bins, points = 40, 400
    bars = histogram(draw, low, high, bins, n)
    xs = [low + (i + 0.5) * (high - low) / points for i in range(points)]
    ys = [exact(x) for x in xs]
    total = sum(ys) * (high - low) / points
    ys = [y / total for y in ys]
    top = 1.1 * max(max(bars), max(ys))
    to_x = lambda x: origin_x + MARGIN + (x - low) / (high - low) * (WIDTH - 1.5 * MARGIN)
    to_y = lambda y: HEIGHT - MARGIN - y / top * (HEIGHT - 2 * MARGIN)
    out = [f'<text x="{origin_x + MARGIN}" y="20">{title}</text>']
    for i, y in enumerate(bars):
        left = to_x(low + i * (high - low) / bins)
        right = to_x(low + (i + 1) * (high - low) / bins)
        out.append(f'<rect x="{left:.1f}" y="{to_y(y):.1f}" width="{right - left - 0.5:.1f}" '
                   f'height="{to_y(0) - to_y(y):.1f}" fill="#9cc4e4"/>')
    line = " ".join(f"{to_x(x):.1f},{to_y(y):.1f}" for x, y in zip(xs, ys))
    out.append(f'<polyline points="{line}" fill="none" stroke="#b03020" stroke-width="1.5"/>')
    out.append(f'<line x1="{to_x(low):.1f}" y1="{to_y(0):.1f}" x2="{to_x(high):.1f}" '
               f'y2="{to_y(0):.1f}" stroke="black"/>')
    for x in (low, high):
        out.append(f'<text x="{to_x(x):.1f}" y="{HEIGHT - MARGIN + 14}" '
                   f'text-anchor="middle">{x:.3g}</text>')
    out.append(f'<text x="{to_x((low + high) / 2):.1f}" y="{HEIGHT - MARGIN + 14}" '
               f'text-anchor="middle" font-style="italic">{name}</text>')
    return "\n".join(out)


def write(name, panels, n):
    width = WIDTH * len(panels)
    body = "\n".join(panel(title, case, i * WIDTH, n) for i, (title, case) in enumerate(panels))
    Path(__file__).with_name(name).write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{HEIGHT}" '
        f'font-family="sans-serif" font-size="12">\n'
        f'<rect width="{width}" height="{HEIGHT}" fill="white"/>\n{body}\n</svg>\n')


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--samples", type=int, default=20000)
    n = parser.parse_args().samples
    write("single_scattering.svg", [("equi-angular, g = 0", single_scattering(0)),
                                    ("g = 0.75", single_scattering(0.75)),
                                    ("g = -0.5", single_scattering(-0.5))], n)
    write("double_scattering.svg", [("first distance, g = 0", double_distance()),
                                    ("direction, g = 0", double_polar_isotropic()),
                                    ("direction, g = 0.75, alpha = 1", double_polar(0.75, 1))], n)
    write("azimuth.svg", [("g = 0.5, alpha = 1, theta = 1", azimuth(0.5, 1, 1)),
                          ("g = 0.9, alpha = 1, theta = 1", azimuth(0.9, 1, 1)),
                          ("g = 0.9, alpha = 1, theta = 2", azimuth(0.9, 1, 2))], n)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Models the whale: writes whale.glb beside this file. Standard library only. A humpback, 10 units long, head towards +z."""
import math
import pathlib
import random

from solid import Solid, curve, mix, rgb, smooth

BACK, FLANK, BELLY, GROOVE = rgb("#27466a"), rgb("#4f7fa6"), rgb("#e6eef2"), rgb("#9db6c4")
PALE, DARK = rgb("#c9dbe4"), rgb("#101820")
# From the root of the flukes (0) to the snout (1).
WIDTH = [0.10, 0.16, 0.24, 0.38, 0.56, 0.76, 0.94, 1.08, 1.15, 1.15, 1.08, 0.97, 0.86, 0.72, 0.50, 0.02]
HEIGHT = [0.12, 0.20, 0.30, 0.44, 0.60, 0.78, 0.94, 1.04, 1.08, 1.06, 0.98, 0.86, 0.72, 0.56, 0.36, 0.02]
SPOTS = random.Random(7)
SPOT = [(SPOTS.uniform(0.08, 0.97), SPOTS.uniform(-1, 1), SPOTS.uniform(0.008, 0.022)) for _ in range(70)]


def body_z(t):
    return -4.0 + 8.6 * t


def body_y(t):
    return 0.06 * math.sin(3.0 * t) - 0.10 * smooth(0.85, 1, t)


def skin(t, side, top):
    c = mix(FLANK, BACK, smooth(-0.1, 0.75, top))
    c = mix(c, BELLY, smooth(-0.25, -0.62, top) * smooth(0.15, 0.4, t))
    # Throat grooves run from the chin to the navel.
    if top < -0.35 and t > 0.5:
        c = mix(c, GROOVE, 0.8 * smooth(0.55, 0.95, math.sin(math.atan2(top, side) * 22)))
    # The line of the mouth.
    line = abs(top - (-0.18 + 0.5 * (t - 0.85)))
    if t > 0.78:
        c = mix(c, DARK, 0.75 * (1 - smooth(0.03, 0.10, line)))
    for at, across, size in SPOT:
        if top > -0.1:
            d = math.hypot((at - t), (across - side) * 0.11)
            c = mix(c, PALE, 0.55 * (1 - smooth(0.4 * size, size, d)))
    # A pale saddle behind the blowhole, knobs on the snout.
    if top > 0.5:
        c = mix(c, FLANK, 0.7 * (1 - smooth(0.0, 0.06, abs(t - 0.62))) * smooth(0.5, 0.9, top))
        if t > 0.84:
            c = mix(c, PALE, 0.5 * smooth(0.75, 0.95, math.sin(t * 150) * math.cos(side * 14)))
    return c


def flipper(solid, side):
    knots = [(0.80, -0.35, 1.55), (1.35, -0.42, 1.22), (1.95, -0.46, 0.72), (2.5, -0.46, 0.08), (2.95, -0.42, -0.55), (3.2, -0.38, -1.0)]
    centre = lambda t: (lambda p: (side * p[0], p[1], p[2]))(curve(knots, t))

    def width(t):
        leading = 1 + 0.05 * math.sin(t * 34)  # a humpback's knobs
        return max(0.015, curve([0.20, 0.30, 0.35, 0.34, 0.27, 0.15, 0.02], t) * leading)

    def colour(t, s, top):
        c = mix(mix(BACK, FLANK, 0.25 + 0.55 * t), BELLY, smooth(0.1, -0.5, top))
        edge = s * side
        return mix(c, PALE, 0.6 * smooth(0.55, 0.95, abs(edge)) * smooth(0.15, 0.4, t))

    solid.sweep(centre, width, lambda t: max(0.012, 0.12 * (1 - t) + 0.03), colour, 24, 20)


def fluke(solid, side):
    knots = [(0.0, 0.0, -3.72), (0.42, 0.01, -4.1), (0.92, 0.03, -4.48), (1.42, 0.06, -4.72), (1.86, 0.08, -4.98)]
    centre = lambda t: (lambda p: (side * p[0], p[1], p[2]))(curve(knots, t))
    width = lambda t: max(0.015, curve([0.20, 0.46, 0.44, 0.30, 0.02], t))

    def colour(t, s, top):
        c = mix(BACK, FLANK, 0.2 + 0.5 * t)
        c = mix(c, BELLY, smooth(0.0, -0.5, top))
        return mix(c, PALE, 0.45 * smooth(0.72, 1.0, abs(s)))

    solid.sweep(centre, width, lambda t: 0.075 * (1 - t) + 0.014, colour, 18, 18)


def dorsal(solid):
    centre = lambda t: (0, 0.62 + 0.02 * t + 0.36 * t, -1.05 - 0.52 * t)
    solid.sweep(centre, lambda t: 0.10 * (1 - t) + 0.012, lambda t: 0.42 * (1 - t) ** 0.8 + 0.02,
                lambda t, s, h: mix(BACK, FLANK, 0.3 * t), 10, 14, up=(0, 0.5, -1))


def whale():
    solid = Solid()
    solid.sweep(lambda t: (0, body_y(t), body_z(t)), lambda t: max(0.012, curve(WIDTH, t)), lambda t: max(0.012, curve(HEIGHT, t)), skin, 76, 44)
    for side in (-1, 1):
        flipper(solid, side)
        fluke(solid, side)
        solid.ball((side * 0.93, 0.18, 2.9), 0.10, PALE, 6, 10)
        solid.ball((side * 0.985, 0.20, 2.92), 0.072, DARK, 6, 10)
        solid.ball((side * 0.09, 0.98, 2.15), 0.055, DARK, 5, 8)
    dorsal(solid)
    return solid


if __name__ == "__main__":
    whale().write_glb(pathlib.Path(__file__).with_name("whale.glb"), "whale", "Apache-2.0, made by make_whale.py")

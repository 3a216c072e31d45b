#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the flower: writes flower.svg beside this file; flower.png is made from it once with
`rsvg-convert flower.svg -o flower.png`. Standard library only. The blossom is the head, two leaves the fins, the stem the tail."""
import math
import pathlib

from drawing import Svg, path, spline, turned

W, H, CX, CY = 720, 1180, 360, 250
INK, GREEN_INK = "#7a1f3d", "#1f5a2a"
ROOT_Y = 560  # of the leaves
LEAF = [(0, 16), (36, 40), (92, 66), (156, 66), (212, 40), (256, 2), (214, -26), (156, -38), (96, -36), (40, -22), (0, -14)]


def stem():
    half = [(0, 17, 380), (0, 17, 560), (0, 16, 760), (0, 15, 940), (0, 16, 1080), (0, 13, 1140)]
    right = [(CX + w, y) for _, w, y in half]
    left = [(CX - w, y) for _, w, y in reversed(half)]
    return spline(right + [(CX, 1152)] + left)


def leaf(side, d):
    a = -0.50
    c, s = math.cos(a), math.sin(a)
    place = lambda u, v: (CX + side * (8 + u * c + v * s * -1), ROOT_Y + (u * s + v * c))
    d.shape(spline([place(u, v) for u, v in LEAF]), "url(#leaf)", GREEN_INK, 6)
    d.line(spline([place(2, 1), place(90, 10), place(236, 4)], closed=False), GREEN_INK, 4.5, stroke_opacity=0.75)
    for k in range(5):
        u = 40 + 38 * k
        for v in (-1, 1):
            d.line([place(u, 8), place(u + 34, 8 + v * (34 - 5 * k) + 6)], GREEN_INK, 3, stroke_opacity=0.5)


def petal(angle, length, broad, fill, d):
    half = [(CX + broad * w, CY - length * t) for t, w in ((0.15, 0.20), (0.35, 0.62), (0.6, 0.98), (0.82, 0.9), (0.96, 0.5))]
    shape = spline(half + [(CX, CY - length * 0.965)] + [(2 * CX - x, y) for x, y in reversed(half)], steps=10)
    d.shape(turned(shape, angle, (CX, CY)), fill, INK, 5)
    for k in (-1, 0, 1):
        line = spline([(CX + 6 * k, CY - 0.36 * length), (CX + broad * 0.24 * k, CY - 0.6 * length), (CX + broad * 0.42 * k, CY - (0.84 - 0.06 * abs(k)) * length)], closed=False)
        d.line(turned(line, angle, (CX, CY)), INK, 3, stroke_opacity=0.35)


def draw():
    d = Svg(W, H, "make_flower.py")
    d.gradient("stem", [(0, "#2f8f3d"), (0.45, "#7fd06a"), (1, "#2b7f38")], x1=0, x2=1, y1=0, y2=0)
    d.gradient("leaf", [(0, "#8fdc70"), (1, "#3c9a45")])
    d.radial("back", [(0, "#d63b78"), (1, "#f2719f")])
    d.radial("front", [(0, "#ff5c93"), (0.75, "#ff97bb"), (1, "#ffc3d7")])
    d.radial("heart", [(0, "#fff3a6"), (0.6, "#ffd23f"), (1, "#e59a12")])
    for side in (-1, 1):
        leaf(side, d)
    d.shape(stem(), "url(#stem)", GREEN_INK, 6)
    d.line([(CX - 5, 470), (CX - 5, 1120)], "#c6f2a8", 4, stroke_opacity=0.6)
    count = 8
    for k in range(count):
        petal(2 * math.pi * (k + 0.5) / count, 214, 74, "url(#back)", d)
    for k in range(count):
        petal(2 * math.pi * k / count, 206, 72, "url(#front)", d)
    d.ellipse(CX, CY, 74, 74, "url(#heart)", "#9a5b07", 6)
    for k in range(90):
        r, a = 64 * math.sqrt((k + 0.5) / 90), k * 2.39996
        d.ellipse(CX + r * math.cos(a), CY + r * math.sin(a), 3.2, 3.2, "#b06a0a", fill_opacity=0.8)
    return d


if __name__ == "__main__":
    draw().write(pathlib.Path(__file__).with_name("flower.svg"))

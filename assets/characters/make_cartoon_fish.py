#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the cartoon fish: writes cartoon_fish.svg beside this file; cartoon_fish.png is made from it once with
`rsvg-convert cartoon_fish.svg -o cartoon_fish.png`. Standard library only. From above, head to the right."""
import math
import pathlib

from drawing import Svg, spline

W, H, CY = 1000, 620, 310
INK = "#1d2a52"


def mirrored(points, side):
    return [(x, CY + side * (y - CY)) for x, y in points]


HALF = [(948, CY), (940, CY + 44), (905, CY + 92), (840, CY + 128), (750, CY + 144), (640, CY + 136), (530, CY + 110), (430, CY + 78),
        (345, CY + 50), (285, CY + 36)]
TAIL = [(300, CY + 34), (262, CY + 40), (205, CY + 74), (140, CY + 122), (88, CY + 142), (62, CY + 128), (66, CY + 92), (92, CY + 46), (104, CY)]
# A fin on its root: along and across its own axis.
FIN = [(0, 26), (40, 42), (90, 56), (140, 56), (178, 38), (188, 6), (168, -22), (124, -34), (76, -30), (34, -20), (0, -16)]


def body():
    lower = HALF
    return spline(lower + [(x, 2 * CY - y) for x, y in reversed(lower[1:])], steps=12)


def tail():
    return spline(TAIL + [(x, 2 * CY - y) for x, y in reversed(TAIL[:-1])], steps=10)


def fin(side):
    x0, y0, a = 690, CY + 128, 0.72
    c, s = math.cos(a), math.sin(a)
    return mirrored(spline([(x0 - u * c + v * s, y0 + u * s + v * c) for u, v in FIN] + [(x0 - 6, y0 - 34), (x0 + 26, y0 - 30)], steps=10), side)


def draw():
    d = Svg(W, H, "make_cartoon_fish.py")
    d.gradient("skin", [(0, "#f29b12"), (0.28, "#ffc629"), (0.5, "#ffe36b"), (0.72, "#ffc629"), (1, "#f29b12")])
    d.gradient("stripe", [(0, "#1769c9"), (0.5, "#3fa4ff"), (1, "#1769c9")])
    d.gradient("tail", [(0, "#1769c9"), (1, "#5fd0ff")], x1=0, x2=1, y1=0, y2=0)
    d.radial("fin", [(0, "#5fd0ff"), (1, "#1769c9")], cx=0.6, cy=0.5, r=0.7)
    d.clip("body", body())
    d.shape(tail(), "url(#tail)", INK, 9)
    for k in (-2, -1, 0, 1, 2):
        d.line(spline([(262, CY + 8 * k), (190, CY + 22 * k), (112 + 4 * abs(k), CY + 46 * k)], closed=False), "#0f4f9e", 5, stroke_opacity=0.7)
    for side in (-1, 1):
        d.clip(f"inner{side}", fin(side))
        d.shape(fin(side), "url(#fin)", INK, 9)
        d.group(clip_path=f"url(#inner{side})")
        for k in range(4):
            far = (560 - 6 * k + 14 * k, CY + 216 - 22 * k)
            d.line(mirrored(spline([(676 + 5 * k, CY + 140), (628 + 6 * k, CY + 176 - 6 * k), far], closed=False), side), "#0f4f9e", 5, stroke_opacity=0.7)
        d.end()
    d.shape(body(), "url(#skin)")
    d.group(clip_path="url(#body)")
    for x, w in ((700, 46), (556, 40), (424, 30)):
        for side in (-1, 1):
            d.shape(mirrored(spline([(x - w, CY - 6), (x - w - 18, CY + 70), (x - w - 60, CY + 170), (x + w - 50, CY + 170), (x + w - 12, CY + 70), (x + w, CY - 6)],
                                    closed=False), side), "url(#stripe)", INK, 5)
    d.ellipse(620, CY - 6, 300, 24, "#ffffff", fill_opacity=0.28)
    for k in range(3):
        for j in (-1, 0, 1):
            x, y = 790 - 140 * k, CY + 46 * j
            d.line(spline([(x, y - 16), (x - 12, y), (x, y + 16)], closed=False), "#c9790a", 4, stroke_opacity=0.55)
    d.end()
    d.shape(spline([(690, CY), (620, CY - 17), (520, CY - 18), (430, CY - 8), (400, CY), (430, CY + 8), (520, CY + 18), (620, CY + 17)]), "url(#fin)", INK, 6)
    d.shape(body(), "none", INK, 9)
    d.line(spline([(926, CY - 40), (938, CY - 20), (941, CY), (938, CY + 20), (926, CY + 40)], closed=False), "#c2410c", 8)
    for side in (-1, 1):
        x, y = 842, CY + side * 88
        d.ellipse(x, y, 46, 40, "#ffffff", INK, 7, turn=side * -16)
        d.ellipse(x + 12, y + side * 4, 25, 25, "#1d2a52")
        d.ellipse(x + 20, y - 6, 9, 9, "#ffffff")
        d.ellipse(910, CY + side * 20, 5, 4, "#c2410c")
        d.ellipse(772, CY + side * 58, 20, 12, "#ff8a5c", fill_opacity=0.75)
    return d


if __name__ == "__main__":
    draw().write(pathlib.Path(__file__).with_name("cartoon_fish.svg"))

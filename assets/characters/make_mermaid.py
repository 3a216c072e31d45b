#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the mermaid: writes mermaid.svg beside this file; mermaid.png is made from it once with
`rsvg-convert mermaid.svg -o mermaid.png`. Standard library only. Head up, arms spread: they are her fins."""
import math
import pathlib

from drawing import Svg, spline

W, H, CX = 760, 1120, 380
INK, SKIN_INK = "#233a4d", "#a6603f"


def mirrored(points, side):
    return [(CX + side * (x - CX), y) for x, y in points]


def both(half):
    """A closed shape from its right half, top to bottom."""
    return spline(half + [(2 * CX - x, y) for x, y in reversed(half)], steps=10)


TORSO = [(CX + 24, 262), (CX + 30, 296), (CX + 62, 318), (CX + 74, 350), (CX + 68, 410), (CX + 56, 470), (CX + 66, 520), (CX + 78, 560), (CX + 60, 600)]
TAIL = [(CX + 60, 528), (CX + 84, 566), (CX + 90, 620), (CX + 82, 700), (CX + 64, 780), (CX + 44, 850), (CX + 28, 910), (CX + 24, 945), (CX + 26, 968)]
FLUKE = [(CX + 8, 905), (CX + 40, 944), (CX + 96, 978), (CX + 158, 1010), (CX + 196, 1056), (CX + 190, 1086), (CX + 150, 1090), (CX + 88, 1070), (CX + 36, 1046), (CX + 10, 1038)]
# Right arm: shoulder, elbow, hand.
ARM = [(CX + 52, 322), (CX + 92, 330), (CX + 150, 372), (CX + 208, 424), (CX + 250, 446), (CX + 286, 470), (CX + 310, 500), (CX + 312, 522), (CX + 292, 524),
       (CX + 266, 500), (CX + 234, 482), (CX + 194, 462), (CX + 142, 420), (CX + 100, 376), (CX + 64, 362)]


def hair(d):
    half = [(CX, 66), (CX + 66, 78), (CX + 112, 128), (CX + 124, 196), (CX + 116, 262), (CX + 128, 330), (CX + 112, 392), (CX + 84, 426), (CX + 62, 392), (CX + 66, 330), (CX + 40, 270)]
    d.shape(both(half), "url(#hair)", INK, 6)
    for side in (-1, 1):
        for k in range(4):
            d.line(mirrored(spline([(CX + 70 + 11 * k, 150 + 14 * k), (CX + 78 + 10 * k, 240), (CX + 70 + 10 * k, 320), (CX + 74 + 8 * k, 390)], closed=False), side),
                   "#8f1f3d", 4, stroke_opacity=0.55)


def face(d):
    d.shape(spline([(CX, 116), (CX + 62, 132), (CX + 78, 190), (CX + 60, 244), (CX, 276), (CX - 60, 244), (CX - 78, 190), (CX - 62, 132)]), "url(#face)", SKIN_INK, 4)
    fringe = spline([(CX - 84, 200), (CX - 86, 140), (CX - 44, 92), (CX + 10, 84), (CX + 62, 104), (CX + 86, 150), (CX + 84, 200), (CX + 62, 158), (CX + 20, 138),
                     (CX - 26, 160), (CX - 64, 160)])
    d.shape(fringe, "url(#hair)", INK, 5)
    for side in (-1, 1):
        x = CX + side * 32
        d.ellipse(x, 198, 15, 18, "#ffffff", INK, 4)
        d.ellipse(x + 2, 201, 9, 12, "#1a7f78")
        d.ellipse(x + 2, 203, 5, 7, "#101820")
        d.ellipse(x + 5, 196, 3.4, 3.4, "#ffffff")
        d.line(spline([(x - 15, 174), (x, 166), (x + 15, 174)], closed=False), "#8f1f3d", 5)
        d.ellipse(CX + side * 48, 228, 12, 8, "#ff8d80", fill_opacity=0.6)
    d.line(spline([(CX - 4, 214), (CX + 5, 224), (CX - 3, 228)], closed=False), SKIN_INK, 3.5)
    d.shape(spline([(CX - 20, 240), (CX, 246), (CX + 20, 240), (CX, 258)]), "#d43d51", "#8f1f3d", 2.5)
    star = [(CX + 58 + r * math.cos(a), 108 + r * math.sin(a)) for k in range(10) for r, a in [((22 if k % 2 == 0 else 10), -math.pi / 2 + k * math.pi / 5)]]
    d.shape(star, "#ffd84d", "#b5790a", 4)


def scales(d):
    d.group(clip_path="url(#scaled)")
    row, y = 0, 574
    while y < 960:
        size = 25 - 10 * (y - 574) / 386
        for k in range(-6, 7):
            x = CX + (k + (0.5 if row % 2 else 0)) * 2 * size
            d.line([(x + size * math.cos(a), y + size * 0.95 * math.sin(a)) for a in (math.pi * i / 8 for i in range(9))], "#0b6e6b", 3.4, stroke_opacity=0.65)
        y += size * 0.95
        row += 1
    d.ellipse(CX - 34, 700, 16, 190, "#ffffff", turn=-4, fill_opacity=0.22)
    d.end()


def draw():
    d = Svg(W, H, "make_mermaid.py")
    d.gradient("hair", [(0, "#ff6b6b"), (0.5, "#e03a5f"), (1, "#b3234f")])
    d.gradient("face", [(0, "#ffdcc0"), (1, "#ffc7a0")])
    d.gradient("skin", [(0, "#ffd6b5"), (1, "#f9b98f")])
    d.gradient("tail", [(0, "#35d0ba"), (0.55, "#1aa6a0"), (1, "#147d92")])
    d.gradient("fluke", [(0, "#1aa6a0"), (0.6, "#5fe3d0"), (1, "#b8fff0")])
    tail = both(TAIL)
    d.clip("scaled", tail)
    hair(d)
    for side in (-1, 1):
        d.shape(mirrored(spline(FLUKE), side), "url(#fluke)", INK, 6)
        for k in range(6):
            d.line(mirrored(spline([(CX + 14 + 3 * k, 946 + 6 * k), (CX + 60 + 8 * k, 1004 - 2 * k), (CX + 60 + 24 * k, 1056 + (4 - k) * 2)], closed=False), side), "#0b6e6b", 4, stroke_opacity=0.6)
        d.shape(mirrored(spline(ARM), side), "url(#skin)", SKIN_INK, 5)
        d.line(mirrored([(CX + 196, 440), (CX + 222, 462)], side), "#ffd84d", 9)
        d.line(mirrored(spline([(CX + 286, 488), (CX + 298, 502), (CX + 300, 514)], closed=False), side), SKIN_INK, 3)
    d.shape(both(TORSO), "url(#skin)", SKIN_INK, 5)
    d.ellipse(CX, 500, 5, 7, "#c67b55")
    d.shape(tail, "url(#tail)", INK, 6)
    scales(d)
    d.shape(tail, "none", INK, 6)
    belt = spline([(CX - 78, 560), (CX - 40, 584), (CX, 590), (CX + 40, 584), (CX + 78, 560)], closed=False)
    d.line(belt, INK, 20)
    d.line(belt, "#ffd84d", 11)
    for side in (-1, 1):
        shell = spline([(CX + side * 6, 372), (CX + side * 26, 352), (CX + side * 56, 356), (CX + side * 66, 384), (CX + side * 46, 408), (CX + side * 18, 402)])
        d.shape(shell, "#b06fe0", "#5a2b82", 5)
        for k in range(3):
            d.line([(CX + side * (32 + 2 * k), 404), (CX + side * (18 + 18 * k), 362)], "#5a2b82", 3, stroke_opacity=0.7)
    d.line(spline([(CX - 30, 318), (CX, 336), (CX + 30, 318)], closed=False), "#ffffff", 6, stroke_dasharray="1 9")
    face(d)
    return d


if __name__ == "__main__":
    draw().write(pathlib.Path(__file__).with_name("mermaid.svg"))

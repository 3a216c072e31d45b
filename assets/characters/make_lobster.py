#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Models the lobster: writes lobster.glb beside this file. Standard library only. 10 units long, head towards +z."""
import math
import pathlib

from solid import Solid, add, curve, mix, rgb, smooth

SHELL, DEEP, LIGHT, JOINT = rgb("#d8351f"), rgb("#8e1710"), rgb("#ff8a52"), rgb("#f3c9a0")
DARK, WHITE = rgb("#14100f"), rgb("#fff4e6")


def shaded(base, top, amount=0.6):
    return mix(mix(base, DEEP, amount * smooth(0.1, -0.8, top)), LIGHT, 0.45 * smooth(0.55, 1.0, top))


def carapace(solid):
    width = [0.42, 0.72, 0.84, 0.86, 0.80, 0.66, 0.44, 0.20, 0.02]
    height = [0.36, 0.60, 0.70, 0.72, 0.66, 0.52, 0.34, 0.16, 0.02]

    def colour(t, s, top):
        c = shaded(SHELL, top)
        groove = abs(t - (0.42 + 0.10 * abs(s)))  # the neck groove
        c = mix(c, DEEP, 0.75 * (1 - smooth(0.012, 0.035, groove)) * smooth(-0.2, 0.2, top))
        c = mix(c, DEEP, 0.6 * (1 - smooth(0.02, 0.06, abs(s))) * smooth(0.7, 0.9, top))  # the back's seam
        freckle = math.sin(t * 61) * math.cos(s * 23 + t * 17)
        return mix(c, LIGHT, 0.4 * smooth(0.75, 0.95, freckle) * smooth(0.1, 0.5, top))

    solid.sweep(lambda t: (0, 0, -0.35 + 3.9 * t), lambda t: max(0.01, curve(width, t)), lambda t: max(0.01, curve(height, t)), colour, 24, 22)


def abdomen(solid):
    """Six rings that overlap, each a short tube wider at its rear edge."""
    for k in range(6):
        front = -0.1 - 0.60 * k
        w, h = 0.80 - 0.062 * k, 0.62 - 0.055 * k

        def colour(t, s, top):
            c = shaded(SHELL, top)
            c = mix(c, JOINT, 0.8 * (1 - smooth(0.0, 0.16, t)) * smooth(-0.3, 0.1, top))
            return mix(c, DEEP, 0.55 * smooth(0.80, 1.0, t))

        solid.sweep(lambda t: (0, 0.02 * math.sin(3 * t), front - 0.86 + 0.9 * t),
                    lambda t: w * curve([0.55, 0.96, 1.0, 0.95, 0.8, 0.45], t), lambda t: h * curve([0.5, 0.92, 1.0, 0.94, 0.8, 0.45], t),
                    colour, 6, 18)


def fan(solid):
    for turn, length, broad in ((0.0, 1.25, 0.34), (0.42, 1.28, 0.36), (-0.42, 1.28, 0.36), (0.84, 1.15, 0.34), (-0.84, 1.15, 0.34)):
        d = (math.sin(turn), 0, -math.cos(turn))
        root = (0.20 * math.sin(turn), -0.02 * abs(turn), -3.62)

        def colour(t, s, top):
            c = shaded(SHELL, top, 0.4)
            c = mix(c, DEEP, 0.5 * (1 - smooth(0.05, 0.16, abs(s))))
            return mix(c, JOINT, 0.85 * smooth(0.80, 0.97, t))

        solid.sweep(lambda t: add(root, (d[0] * length * t, 0, d[2] * length * t)),
                    lambda t: broad * curve([0.3, 0.62, 0.92, 1.05, 0.9, 0.1], t), lambda t: 0.07 * (1 - 0.6 * t), colour, 8, 10)


def limb(solid, knots, thick, side, base=SHELL, rings=12, segments=9):
    """A jointed leg: pale bands at its knots."""
    n = len(knots) - 1

    def colour(t, s, top):
        band = min(abs(t * n - i) for i in range(1, n)) if n > 1 else 1
        return mix(shaded(base, top), JOINT, 0.75 * (1 - smooth(0.06, 0.16, band)))

    centre = lambda t: (lambda p: (side * p[0], p[1], p[2]))(curve(knots, t))
    solid.sweep(centre, lambda t: curve(thick, t), lambda t: curve(thick, t), colour, rings, segments)


def claw(solid, side):
    limb(solid, [(0.52, -0.10, 2.35), (1.15, -0.05, 2.62), (1.75, 0.0, 2.72), (2.08, 0.02, 3.15)], [0.20, 0.24, 0.25, 0.26], side, rings=12, segments=10)
    crusher = 1.0 if side > 0 else 0.9  # one claw is heavier than the other, as lobsters' are

    def palm(t, s, top):
        c = shaded(SHELL, top)
        bump = math.sin(t * 40) * math.cos(s * 11)
        c = mix(c, LIGHT, 0.35 * smooth(0.7, 0.95, bump) * smooth(0.0, 0.5, top))
        return mix(c, JOINT, 0.7 * (1 - smooth(0.0, 0.07, t))) if t < 0.5 else mix(c, DEEP, 0.6 * smooth(0.84, 1.0, t))

    outer = [(2.04, 0.02, 3.05), (2.26, 0.03, 3.55), (2.36, 0.04, 4.15), (2.26, 0.04, 4.75), (1.96, 0.04, 5.3)]
    solid.sweep(lambda t: (lambda p: (side * p[0], p[1], p[2]))(curve(outer, t)),
                lambda t: crusher * max(0.02, curve([0.20, 0.46, 0.56, 0.42, 0.24, 0.03], t)),
                lambda t: crusher * max(0.02, curve([0.18, 0.28, 0.30, 0.24, 0.14, 0.03], t)), palm, 16, 14)
    thumb = [(1.98, 0.02, 3.75), (1.66, 0.03, 4.12), (1.52, 0.03, 4.55), (1.58, 0.03, 5.0)]
    solid.sweep(lambda t: (lambda p: (side * p[0], p[1], p[2]))(curve(thumb, t)),
                lambda t: crusher * max(0.02, curve([0.24, 0.24, 0.18, 0.03], t)), lambda t: crusher * max(0.02, curve([0.2, 0.2, 0.14, 0.03], t)),
                palm, 10, 10)


def lobster():
    solid = Solid()
    abdomen(solid)
    carapace(solid)
    fan(solid)
    for side in (-1, 1):
        claw(solid, side)
        for k, (z, reach, lean) in enumerate(((1.85, 1.85, 0.75), (1.35, 2.0, 0.15), (0.85, 1.95, -0.45), (0.4, 1.75, -0.95))):
            limb(solid, [(0.62, -0.25, z), (0.62 + 0.34 * reach, 0.02, z + 0.4 * lean), (0.62 + 0.62 * reach, -0.2, z + 0.8 * lean), (0.62 + 0.82 * reach, -0.6, z + 1.2 * lean)],
                 [0.12, 0.115, 0.10, 0.03], side, mix(SHELL, LIGHT, 0.35), 9, 7)
        limb(solid, [(0.22, 0.12, 3.1), (0.5, 0.3, 4.0), (0.95, 0.36, 5.0), (1.0, 0.30, 6.2)], [0.06, 0.035, 0.022, 0.008], side, LIGHT, 9, 5)
        solid.ball((side * 0.40, 0.44, 2.86), 0.13, WHITE, 6, 10)
        solid.ball((side * 0.43, 0.49, 2.92), 0.105, DARK, 6, 10)
    return solid


if __name__ == "__main__":
    lobster().write_glb(pathlib.Path(__file__).with_name("lobster.glb"), "lobster", "Apache-2.0, made by make_lobster.py")

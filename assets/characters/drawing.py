# SPDX-License-Identifier: Apache-2.0
"""Curves and shapes for the drawn characters, standard library only. SVG coordinates: x right, y down."""
import math


def path(points, closed=True):
    return "M" + " L".join(f"{x:.1f},{y:.1f}" for x, y in points) + (" Z" if closed else "")


def spline(points, closed=True, steps=10):
    """Catmull-Rom through the points."""
    n, out = len(points), []
    at = (lambda i: points[i % n]) if closed else (lambda i: points[max(0, min(n - 1, i))])
    for i in range(n if closed else n - 1):
        p0, p1, p2, p3 = at(i - 1), at(i), at(i + 1), at(i + 2)
        for k in range(steps):
            t = k / steps
            out.append(tuple(0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t * t
                                    + (3 * b - a - 3 * c + d) * t ** 3) for a, b, c, d in zip(p0, p1, p2, p3)))
    if not closed:
        out.append(points[-1])
    return out


def turned(points, angle, about=(0, 0)):
    c, s = math.cos(angle), math.sin(angle)
    return [(about[0] + (x - about[0]) * c - (y - about[1]) * s, about[1] + (x - about[0]) * s + (y - about[1]) * c) for x, y in points]


class Svg:
    def __init__(self, width, height, script):
        self.width, self.height, self.script, self.defs, self.out = width, height, script, [], []

    def gradient(self, name, stops, x1=0, y1=0, x2=0, y2=1, absolute=False):
        units = ' gradientUnits="userSpaceOnUse"' if absolute else ""
        inner = "".join(f'<stop offset="{o}" stop-color="{c}"/>' for o, c in stops)
        self.defs.append(f'<linearGradient id="{name}" x1="{x1}" y1="{y1}" x2="{x2}" y2="{y2}"{units}>{inner}</linearGradient>')

    def radial(self, name, stops, cx=0.5, cy=0.5, r=0.5):
        inner = "".join(f'<stop offset="{o}" stop-color="{c}"/>' for o, c in stops)
        self.defs.append(f'<radialGradient id="{name}" cx="{cx}" cy="{cy}" r="{r}">{inner}</radialGradient>')

    def clip(self, name, points):
        self.defs.append(f'<clipPath id="{name}"><path d="{path(points)}"/></clipPath>')

    def shape(self, points, fill, stroke="none", width=0, closed=True, **more):
        extra = "".join(f' {k.replace("_", "-")}="{v}"' for k, v in more.items())
        self.out.append(f'<path d="{path(points, closed)}" fill="{fill}" stroke="{stroke}" stroke-width="{width}"{extra}/>')

    def line(self, points, stroke, width, **more):
        self.shape(points, "none", stroke, width, closed=False, **more)

    def ellipse(self, cx, cy, rx, ry, fill, stroke="none", width=0, turn=0, **more):
        extra = "".join(f' {k.replace("_", "-")}="{v}"' for k, v in more.items())
        self.out.append(f'<ellipse cx="{cx:.1f}" cy="{cy:.1f}" rx="{rx}" ry="{ry}" fill="{fill}" stroke="{stroke}" '
                        f'stroke-width="{width}" transform="rotate({turn} {cx:.1f} {cy:.1f})"{extra}/>')

    def group(self, **attributes):
        self.out.append("<g" + "".join(f' {k.replace("_", "-")}="{v}"' for k, v in attributes.items()) + ">")

    def end(self):
        self.out.append("</g>")

    def write(self, target):
        head = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}" '
                f'viewBox="0 0 {self.width} {self.height}">\n<!-- SPDX-License-Identifier: Apache-2.0. Written by {self.script} -->\n')
        target.write_text(head + "<defs>\n" + "\n".join(self.defs) + '\n</defs>\n<g stroke-linejoin="round" stroke-linecap="round">\n'
                          + "\n".join(self.out) + "\n</g>\n</svg>\n", encoding="utf-8")

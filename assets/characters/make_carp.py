#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Draws the carp: writes carp.svg beside this file; carp.png is made from it once with
`rsvg-convert carp.svg -o carp.png` (package librsvg2-bin, needed only to redraw). Standard library only. The fish is seen from above, head to the right.
Every shape is computed from a width profile along the body's axis, so that it can be redrawn by changing numbers."""
import math
import pathlib
import random

W, H = 1024, 640
CY = H / 2
SNOUT, PEDUNCLE, FORK = 978.0, 262.0, 26.0  # x of the snout, of the root of the tail fin, of its tips

# Half width of the body at shares of the way from the snout to the root of the tail fin.
PROFILE = [(0.0, 0), (0.0025, 15), (0.008, 25), (0.018, 34), (0.034, 43), (0.06, 52), (0.10, 61), (0.15, 69), (0.21, 77),
           (0.30, 84), (0.39, 86), (0.50, 79), (0.62, 66), (0.74, 51), (0.85, 39), (0.93, 33), (1.0, 31)]
ROUND_END = 1.06  # the scaled skin runs out in a rounded tongue over the root of the tail fin


def half_width(s):
    """Monotone cubic through PROFILE (Fritsch-Carlson), so that the outline has no bumps."""
    if s > 1:
        return PROFILE[-1][1] * math.sqrt(max(0.0, 1 - ((s - 1) / (ROUND_END - 1)) ** 2))
    xs, ys = [p[0] for p in PROFILE], [p[1] for p in PROFILE]
    d = [(ys[i + 1] - ys[i]) / (xs[i + 1] - xs[i]) for i in range(len(xs) - 1)]
    m = [d[0]] + [0 if d[i - 1] * d[i] <= 0 else 2 / (1 / d[i - 1] + 1 / d[i]) for i in range(1, len(d))] + [d[-1]]
    for i in range(len(d)):
        if xs[i] <= s <= xs[i + 1]:
            h = xs[i + 1] - xs[i]
            t = (s - xs[i]) / h
            return ((1 + 2 * t) * (1 - t) ** 2 * ys[i] + t * (1 - t) ** 2 * h * m[i]
                    + t * t * (3 - 2 * t) * ys[i + 1] + t * t * (t - 1) * h * m[i + 1])
    return ys[-1]


def x_at(s):
    return SNOUT + (PEDUNCLE - SNOUT) * s


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


def body(last=ROUND_END, closed=True):
    """The skin's outline; up to `last` only, from the root of the tail fin round the head, when not closed."""
    ss = [last * (i / 200) ** 2 for i in range(201)]
    if closed:
        ss = [s for s in ss if s < 1] + [1 + (ROUND_END - 1) * math.sin(i / 20 * math.pi / 2) for i in range(21)]
    upper = [(x_at(s), CY - half_width(s)) for s in ss]
    lower = [(x_at(s), CY + half_width(s)) for s in ss]
    return list(reversed(upper)) + lower[1:-1] + [lower[-1]]


def bezier(p0, p1, p2, n=24):
    return [((1 - t) ** 2 * p0[0] + 2 * t * (1 - t) * p1[0] + t * t * p2[0],
             (1 - t) ** 2 * p0[1] + 2 * t * (1 - t) * p1[1] + t * t * p2[1]) for t in (i / n for i in range(n + 1))]


def mirrored(points, side):
    return [(x, CY + side * (y - CY)) for x, y in points]


# Pectoral fins: the middle of the root on the body's edge, half the root's length, how far the fin opens from straight back.
FIN_X, FIN_ROOT, FIN_OPEN = 772.0, 15.0, 0.64
# The fan along and across its own axis, from the root's front round the tip to the root's rear.
FAN = [(30, 23), (70, 34), (115, 42), (160, 45), (198, 40), (219, 26), (226, 6), (219, -15), (198, -31), (165, -37), (130, -34),
       (97, -25), (72, -16), (54, -9), (38, -4), (24, -6)]


def pectoral(side):
    """A fan on rays; drawn for the lower side (side 1) and mirrored."""
    def edge(x):
        return CY + half_width((SNOUT - x) / (SNOUT - PEDUNCLE))

    # Narrow at the root and well off the body behind it, so that it can fold and open without crumpling.
    front, back = (FIN_X + FIN_ROOT, edge(FIN_X + FIN_ROOT) - 4), (FIN_X - FIN_ROOT, edge(FIN_X - FIN_ROOT) - 4)
    c, s, y0 = math.cos(FIN_OPEN), math.sin(FIN_OPEN), edge(FIN_X)
    fan = [(FIN_X - a * c + b * s, y0 + a * s + b * c) for a, b in FAN]
    rim = spline([front] + fan + [back], closed=False)
    inner = [(back[0] + 3, CY + 58), (front[0] - 3, CY + 56)]
    rays = []
    tips = spline(fan[1:-4], closed=False, steps=6)
    count = 11
    for k in range(1, count):
        tip = tips[k * (len(tips) - 1) // count]
        u = k / count
        root = (front[0] + (back[0] - front[0]) * (0.1 + 0.6 * u), y0 - 8)
        bow = 12 - 10 * u
        mid = ((root[0] + tip[0]) / 2 + bow * s, (root[1] + tip[1]) / 2 + bow * c)
        rays.append(mirrored(bezier(root, mid, (root[0] + (tip[0] - root[0]) * 0.95, root[1] + (tip[1] - root[1]) * 0.95)), side))
    return mirrored(rim + inner, side), rays


def caudal():
    half = [(PEDUNCLE + 40, CY - 31), (PEDUNCLE + 8, CY - 31.5), (PEDUNCLE - 34, CY - 41), (PEDUNCLE - 84, CY - 68), (PEDUNCLE - 146, CY - 106),
            (PEDUNCLE - 206, CY - 130), (FORK + 2, CY - 134), (FORK + 8, CY - 122), (FORK + 52, CY - 78), (FORK + 86, CY - 36),
            (FORK + 100, CY - 9)]
    upper = spline(half, closed=False)
    lower = [(x, 2 * CY - y) for x, y in reversed(upper)]
    # The rim from tip to tip: rays end there.
    rim = spline([(FORK + 2, CY - 134), (FORK + 8, CY - 122), (FORK + 52, CY - 78), (FORK + 86, CY - 36), (FORK + 100, CY - 9)],
                 closed=False, steps=8)
    rays = []
    for side in (-1, 1):
        for k in range(1, 11):
            x, y = rim[(k - 1) * (len(rim) - 1) // 10]
            u = k / 11
            root = (PEDUNCLE - 14, CY - 26 * (1 - u))
            ctrl = (PEDUNCLE - 84, CY - (CY - y) * (0.40 + 0.1 * u))
            end = (root[0] + (x - root[0]) * 0.96, root[1] + (y - root[1]) * 0.96)
            rays.append(mirrored(bezier(root, ctrl, end), -side))
    return upper + lower, rays


def blob(cx, cy, rx, ry, seed, bumps=9, rough=0.16, tilt=0.0):
    """A patch with an uneven rim."""
    r = random.Random(seed)
    pts = []
    for i in range(bumps):
        a = 2 * math.pi * i / bumps
        k = 1 + r.uniform(-rough, rough)
        x, y = rx * k * math.cos(a), ry * k * math.sin(a)
        pts.append((cx + x * math.cos(tilt) - y * math.sin(tilt), cy + x * math.sin(tilt) + y * math.cos(tilt)))
    return spline(pts)


def scales():
    """Rows of overlapping scales, open towards the tail, from behind the head to the root of the tail fin."""
    dark, light = [], []
    step, s = 0.0235, 0.275
    row = 0
    while s < 1.045:
        w = half_width(s) * 0.97
        n = 9
        size = 2 * w / n
        for k in range(-1, n + 1):
            y = CY - w + (k + (0.5 if row % 2 else 1.0)) * size
            if abs(y - CY) > w:
                continue
            # Scales curve round the flank: rows bend towards the tail at the sides.
            x = x_at(s) - 10 * ((y - CY) / w) ** 2
            r = size * 0.56
            arc = [(x - 0.95 * r * math.cos(a), y + r * math.sin(a)) for a in (-1.35 + 2.7 * i / 10 for i in range(11))]
            dark.append(path(arc, closed=False))
            light.append(path([(px + 2.2, py) for px, py in arc[2:9]], closed=False))
        s += step
        row += 1
    return " ".join(dark), " ".join(light)


def dorsal():
    # It leans to one side, as in a turn: the ridge is the lower edge, the tips of the rays the upper one.
    ridge = [(x_at(s), CY) for s in (0.355, 0.45, 0.55, 0.65, 0.73)]
    tips = spline([(x_at(0.73), CY), (x_at(0.785), CY - 7), (x_at(0.70), CY - 15), (x_at(0.58), CY - 19), (x_at(0.46), CY - 20),
                   (x_at(0.40), CY - 13), (x_at(0.355), CY)], closed=False)
    outline = ridge + tips[1:-1]
    rays = []
    for k in range(12):
        s = 0.385 + 0.029 * k
        rays.append([(x_at(s), CY - 1), (x_at(s + 0.033), CY - 15 + 0.35 * k)])
    return outline, rays


def eye(side):
    x, y = x_at(0.105), CY + side * 52
    return (f'<g transform="rotate({side * -12} {x:.1f} {y:.1f})">'
            f'<ellipse cx="{x:.1f}" cy="{y:.1f}" rx="17" ry="11.5" fill="#fff6ea" stroke="#7a3a22" stroke-width="2"/>'
            f'<ellipse cx="{x:.1f}" cy="{y + side * 1.5:.1f}" rx="11" ry="8.4" fill="#d58a2a"/>'
            f'<ellipse cx="{x:.1f}" cy="{y + side * 2:.1f}" rx="8" ry="7" fill="#1c1416"/>'
            f'<ellipse cx="{x + 3.4:.1f}" cy="{y - 1.4:.1f}" rx="2.6" ry="2.1" fill="#ffffff"/></g>')


def barbel(side):
    p = spline([(x_at(0.020), CY + side * 33), (x_at(0.028), CY + side * 46), (x_at(0.046), CY + side * 58),
                (x_at(0.068), CY + side * 67)], closed=False)
    return path(p, closed=False)


def svg():
    b = path(body())
    tail, tail_rays = caudal()
    dark, light = scales()
    ridge, ridge_rays = dorsal()
    out = [f'''<svg xmlns="http://www.w3.org/2000/svg" width="{W}" height="{H}" viewBox="0 0 {W} {H}">
<!-- SPDX-License-Identifier: Apache-2.0. Written by make_carp.py -->
<defs>
<clipPath id="body"><path d="{b}"/></clipPath>
<linearGradient id="skin" x1="0" y1="{CY - 84}" x2="0" y2="{CY + 84}" gradientUnits="userSpaceOnUse">
<stop offset="0" stop-color="#e9cfbd"/><stop offset="0.2" stop-color="#fbf1e6"/><stop offset="0.5" stop-color="#ffffff"/>
<stop offset="0.8" stop-color="#faeee2"/><stop offset="1" stop-color="#e2c3af"/></linearGradient>
<linearGradient id="red" x1="0" y1="{CY - 84}" x2="0" y2="{CY + 84}" gradientUnits="userSpaceOnUse">
<stop offset="0" stop-color="#c8301a"/><stop offset="0.32" stop-color="#ee5423"/><stop offset="0.5" stop-color="#ff7634"/>
<stop offset="0.68" stop-color="#ea4c20"/><stop offset="1" stop-color="#bd2a17"/></linearGradient>
<linearGradient id="tail" x1="{PEDUNCLE + 20}" y1="0" x2="{FORK}" y2="0" gradientUnits="userSpaceOnUse">
<stop offset="0" stop-color="#fff4ea"/><stop offset="0.35" stop-color="#ffe3cf" stop-opacity="0.97"/>
<stop offset="1" stop-color="#ffb98f" stop-opacity="0.86"/></linearGradient>
<linearGradient id="fin" x1="0" y1="0" x2="0" y2="1"><stop offset="0" stop-color="#fff8f0"/>
<stop offset="0.55" stop-color="#ffe9d8" stop-opacity="0.97"/><stop offset="1" stop-color="#ffbf97" stop-opacity="0.88"/></linearGradient>
<linearGradient id="finup" x1="0" y1="1" x2="0" y2="0"><stop offset="0" stop-color="#fff8f0"/>
<stop offset="0.55" stop-color="#ffe9d8" stop-opacity="0.97"/><stop offset="1" stop-color="#ffbf97" stop-opacity="0.88"/></linearGradient>
<filter id="soft2"><feGaussianBlur stdDeviation="1.4"/></filter>
<filter id="soft8" x="-20%" y="-60%" width="140%" height="220%"><feGaussianBlur stdDeviation="9"/></filter>
<filter id="soft16" x="-20%" y="-60%" width="140%" height="220%"><feGaussianBlur stdDeviation="13"/></filter>
</defs>
<g stroke-linejoin="round" stroke-linecap="round" fill="none">''']
    # Tail fin, then pectoral fins, then the body over their roots.
    out.append(f'<path d="{path(tail)}" fill="url(#tail)" stroke="#8a3f22" stroke-width="3.2"/>')
    out.append(f'<g stroke="#d9662f" stroke-opacity="0.5" stroke-width="2.2">{"".join(f"""<path d="{path(r, False)}"/>""" for r in tail_rays)}</g>')
    for side in (-1, 1):
        fin, rays = pectoral(side)
        fill = "fin" if side > 0 else "finup"
        out.append(f'<clipPath id="in{fill}"><path d="{path(fin)}"/></clipPath>'
                   f'<path d="{path(fin)}" fill="url(#{fill})" stroke="#8a3f22" stroke-width="3.2"/>')
        out.append(f'<g clip-path="url(#in{fill})" stroke="#d9662f" stroke-opacity="0.5" stroke-width="2.2">{"".join(f"""<path d="{path(r, False)}"/>""" for r in rays)}</g>')
        out.append(f'<path d="{barbel(side)}" stroke="#8a3f22" stroke-width="9"/>'
                   f'<path d="{barbel(side)}" stroke="#f0a27c" stroke-width="5"/>')
    out.append(f'<path d="{b}" fill="url(#skin)"/><g clip-path="url(#body)">')
    patches = [blob(x_at(0.15), CY - 6, 62, 36, 5, 10, 0.12), blob(x_at(0.375), CY - 26, 92, 58, 11, 11, 0.2, 0.12),
               blob(x_at(0.50), CY + 34, 70, 44, 8, 10, 0.2, -0.15), blob(x_at(0.72), CY - 4, 66, 60, 21, 11, 0.2),
               blob(x_at(0.93), CY + 6, 34, 36, 4, 9, 0.18)]
    out.append(f'<g fill="url(#red)" filter="url(#soft2)">{"".join(f"""<path d="{path(p)}"/>""" for p in patches)}</g>')
    out.append(f'<path d="{dark}" stroke="#7e2d18" stroke-opacity="0.26" stroke-width="2"/>')
    out.append(f'<path d="{light}" stroke="#ffffff" stroke-opacity="0.30" stroke-width="1.6"/>')
    # Roundness: dark along the flanks, a sheen on the back.
    out.append(f'<path d="{path(body(1.0, closed=False), closed=False)}" stroke="#6a2c1c" stroke-opacity="0.55" stroke-width="26" filter="url(#soft8)"/>')
    out.append(f'<path d="{b}" stroke="#b5542c" stroke-opacity="0.35" stroke-width="18" filter="url(#soft8)"/>')
    out.append(f'<ellipse cx="{x_at(0.36)}" cy="{CY - 20}" rx="250" ry="15" fill="#ffffff" fill-opacity="0.42" filter="url(#soft16)"/>')
    # Gill covers, brow and nostrils.
    for side in (-1, 1):
        gill = bezier((x_at(0.205), CY + side * 76), (x_at(0.252), CY + side * 44), (x_at(0.228), CY + side * 10))
        out.append(f'<path d="{path(gill, False)}" stroke="#8a3f22" stroke-opacity="0.55" stroke-width="3"/>')
        inner = bezier((x_at(0.155), CY + side * 62), (x_at(0.186), CY + side * 46), (x_at(0.178), CY + side * 30))
        out.append(f'<path d="{path(inner, False)}" stroke="#8a3f22" stroke-opacity="0.28" stroke-width="2.4"/>')
        out.append(f'<ellipse cx="{x_at(0.048)}" cy="{CY + side * 17}" rx="4.4" ry="3" fill="#6d2c1b" fill-opacity="0.75"/>')
    mouth = bezier((x_at(0.022), CY - 21), (x_at(-0.001), CY), (x_at(0.022), CY + 21))
    out.append(f'<path d="{path(mouth, False)}" stroke="#8a3f22" stroke-opacity="0.6" stroke-width="2.4"/>')
    out.append('</g>')
    out.append(f'<path d="{path(ridge)}" fill="#fff3e8" fill-opacity="0.82" stroke="#8a3f22" stroke-opacity="0.8" stroke-width="2.2"/>')
    out.append(f'<g stroke="#d9662f" stroke-opacity="0.7" stroke-width="1.8">{"".join(f"""<path d="{path(r, False)}"/>""" for r in ridge_rays)}</g>')
    out.append(f'<path d="{path(body(0.985, closed=False), closed=False)}" stroke="#8a3f22" stroke-width="3.4"/>')
    out += [eye(-1), eye(1), '</g>\n</svg>\n']
    return "\n".join(out)


if __name__ == "__main__":
    pathlib.Path(__file__).with_name("carp.svg").write_text(svg(), encoding="utf-8")

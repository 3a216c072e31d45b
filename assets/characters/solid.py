# SPDX-License-Identifier: Apache-2.0
"""Solids for characters, standard library only: tubes swept along curves, with a colour at each vertex, written as GLB.
Axes as in glTF: x to the side, y up, z forward (towards the head)."""
import json
import math
import struct


def add(a, b):
    return tuple(p + q for p, q in zip(a, b))


def sub(a, b):
    return tuple(p - q for p, q in zip(a, b))


def mul(a, s):
    return tuple(p * s for p in a)


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a):
    return mul(a, 1 / max(math.sqrt(dot(a, a)), 1e-12))


def mix(a, b, t):
    t = min(1.0, max(0.0, t))
    return tuple(p + (q - p) * t for p, q in zip(a, b))


def smooth(lo, hi, v):
    t = min(1.0, max(0.0, (v - lo) / (hi - lo)))
    return t * t * (3 - 2 * t)


def rgb(hexa):
    return tuple(int(hexa[i:i + 2], 16) / 255 for i in (1, 3, 5))


def curve(knots, t):
    """Catmull-Rom through equally spaced knots (numbers or tuples), t in [0, 1]."""
    n = len(knots) - 1
    i = min(n - 1, int(t * n))
    u = t * n - i
    p = [knots[max(0, min(n, i + k))] for k in (-1, 0, 1, 2)]

    def one(a, b, c, d):
        return 0.5 * (2 * b + (c - a) * u + (2 * a - 5 * b + 4 * c - d) * u * u + (3 * b - a - 3 * c + d) * u ** 3)

    return tuple(one(*q) for q in zip(*p)) if isinstance(knots[0], tuple) else one(*p)


class Solid:
    def __init__(self):
        self.points, self.colours, self.faces = [], [], []

    def sweep(self, centre, width, height, colour, rings, segments, up=(0, 1, 0)):
        """A tube along centre(t), elliptic with half width(t) to the side and half height(t) along `up`; both ends are
        closed by a point. colour(t, side, top) with side and top in [-1, 1] round the ring."""
        first = len(self.points)
        ends = (0.0, 1.0)
        ts = [0.5 - 0.5 * math.cos(math.pi * (i + 0.5) / rings) for i in range(rings)]
        for t in ts:
            c = centre(t)
            forward = unit(sub(centre(min(1, t + 0.01)), centre(max(0, t - 0.01))))
            right = unit(cross(up, forward))
            over = cross(forward, right)
            for k in range(segments):
                a = 2 * math.pi * k / segments
                s, h = math.cos(a), math.sin(a)
                self.points.append(add(c, add(mul(right, s * width(t)), mul(over, h * height(t)))))
                self.colours.append(colour(t, s, h))
        for t in ends:
            self.points.append(centre(t))
            self.colours.append(colour(t, 0, 0))
        at = lambda i, k: first + i * segments + k % segments
        for i in range(rings - 1):
            for k in range(segments):
                a, b, c, d = at(i, k), at(i, k + 1), at(i + 1, k + 1), at(i + 1, k)
                self.faces += [(a, b, c), (a, c, d)]
        start, end = first + rings * segments, first + rings * segments + 1
        for k in range(segments):
            self.faces += [(start, at(0, k + 1), at(0, k)), (end, at(rings - 1, k), at(rings - 1, k + 1))]

    def ball(self, at, radius, colour, rings=6, segments=10):
        self.sweep(lambda t: add(at, (0, 0, radius * (2 * t - 1))), lambda t: radius * math.sqrt(max(0, 1 - (2 * t - 1) ** 2)),
                   lambda t: radius * math.sqrt(max(0, 1 - (2 * t - 1) ** 2)), lambda t, s, h: colour, rings, segments)

    def write_glb(self, path, name, note):
        faces = [i for f in self.faces for i in f]
        index = struct.pack(f"<{len(faces)}I", *faces)
        position = b"".join(struct.pack("<3f", *p) for p in self.points)
        colour = b"".join(struct.pack("<4B", *(round(255 * min(1, max(0, v))) for v in c), 255) for c in self.colours)
        box = [[round(f(p[i] for p in self.points), 6) for i in range(3)] for f in (min, max)]
        box = [[struct.unpack("<f", struct.pack("<f", v))[0] for v in corner] for corner in box]
        document = {
            "asset": {"version": "2.0", "generator": name, "copyright": note},
            "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "name": name}],
            "meshes": [{"name": name, "primitives": [{"attributes": {"POSITION": 1, "COLOR_0": 2}, "indices": 0, "material": 0}]}],
            "materials": [{"name": "skin", "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.7}}],
            "buffers": [{"byteLength": len(index) + len(position) + len(colour)}],
            "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(index), "target": 34963},
                            {"buffer": 0, "byteOffset": len(index), "byteLength": len(position), "target": 34962},
                            {"buffer": 0, "byteOffset": len(index) + len(position), "byteLength": len(colour), "target": 34962}],
            "accessors": [{"bufferView": 0, "componentType": 5125, "count": len(faces), "type": "SCALAR"},
                          {"bufferView": 1, "componentType": 5126, "count": len(self.points), "type": "VEC3", "min": box[0], "max": box[1]},
                          {"bufferView": 2, "componentType": 5121, "normalized": True, "count": len(self.points), "type": "VEC4"}]}
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = index + position + colour
        body = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(data), 0x004E4942) + data
        path.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(body)) + body)

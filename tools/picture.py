#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Velum authors
# SPDX-License-Identifier: MIT
"""picture.py RESULTS OUT.png: the picture of the README from the results of `make demo`.

Left the registered scans, coloured by height; right the meshes of both sails, shaded.
"""
import math
import os
import struct
import sys
import zlib

WIDTH, HEIGHT = 1200, 620
TYPES = {"float": "f", "double": "d", "int": "i", "uint": "I", "uchar": "B", "char": "b",
         "short": "h", "ushort": "H", "int32": "i", "float32": "f", "uint8": "B"}


def read_ply(path):
    """Vertices (x, y, z) and triangles of a binary little-endian PLY."""
    with open(path, "rb") as file:
        data = file.read()
    head, body = data.split(b"end_header\n", 1)
    counts, formats = {}, {}
    for line in head.decode().splitlines():
        words = line.split()
        if words[0] == "element":
            element = words[1]
            counts[element], formats[element] = int(words[2]), []
        elif words[0] == "property":
            formats[element].append(words[1:])
    row = struct.Struct("<" + "".join(TYPES[p[0]] for p in formats["vertex"]))
    place = [[p[-1] for p in formats["vertex"]].index(axis) for axis in "xyz"]
    end = counts["vertex"] * row.size
    vertices = [tuple(v[i] for i in place) for v in row.iter_unpack(body[:end])]
    face = struct.Struct("<" + TYPES[formats["face"][0][1]] + 3 * TYPES[formats["face"][0][2]]
                         ) if "face" in counts else None
    faces = [f[1:] for f in face.iter_unpack(body[end:end + counts["face"] * face.size])] if face else []
    return vertices, faces


class Canvas:
    """Pixels with depth; places are projected along the viewing direction."""

    def __init__(self):
        self.colour = bytearray([250] * (3 * WIDTH * HEIGHT))
        self.depth = [math.inf] * (WIDTH * HEIGHT)

    def put(self, x, y, depth, colour):
        if 0 <= x < WIDTH and 0 <= y < HEIGHT and depth < self.depth[y * WIDTH + x]:
            self.depth[y * WIDTH + x] = depth
            self.colour[3 * (y * WIDTH + x):3 * (y * WIDTH + x) + 3] = bytes(colour)

    def triangle(self, a, b, c, colour):
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if area == 0:
            return
        for y in range(math.ceil(min(a[1], b[1], c[1])), math.floor(max(a[1], b[1], c[1])) + 1):
            for x in range(math.ceil(min(a[0], b[0], c[0])), math.floor(max(a[0], b[0], c[0])) + 1):
                u = ((b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)) / area
                v = ((c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)) / area
                if u >= 0 and v >= 0 and u + v <= 1:
                    self.put(x, y, u * a[2] + v * b[2] + (1 - u - v) * c[2], colour)

    def save(self, path):
        rows = b"".join(b"\0" + self.colour[3 * WIDTH * y:3 * WIDTH * (y + 1)] for y in range(HEIGHT))

        def chunk(kind, content):
            crc = struct.pack(">I", zlib.crc32(kind + content))
            return struct.pack(">I", len(content)) + kind + content + crc

        with open(path, "wb") as file:
            file.write(b"\x89PNG\r\n\x1a\n")
            file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)))
            file.write(chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def view(centre, scale, turn, dip, middle):
    """A parallel projection: (x right, y down, depth) of a place."""
    ct, st, cd, sd = math.cos(turn), math.sin(turn), math.cos(dip), math.sin(dip)

    def project(p):
        x, y, z = (p[i] - centre[i] for i in range(3))
        right, forward = ct * x + st * y, -st * x + ct * y
        return (middle[0] + scale * right, middle[1] - scale * (cd * z + sd * forward),
                cd * forward - sd * z)

    return project


def shade(a, b, c, tint):
    u = [b[i] - a[i] for i in range(3)]
    v = [c[i] - a[i] for i in range(3)]
    n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
    length = math.sqrt(sum(k * k for k in n)) or 1.0
    light = abs(0.36 * n[0] - 0.48 * n[1] + 0.8 * n[2]) / length
    return [min(255, int(k * (0.35 + 0.65 * light))) for k in tint]


def main():
    folder, out = sys.argv[1:3]
    canvas = Canvas()
    points, _ = read_ply(os.path.join(folder, "scene.ply"))
    sails = [(read_ply(os.path.join(folder, name)), tint) for name, tint in
             (("gennaker.ply", (235, 120, 60)), ("mainsail.ply", (80, 150, 225)))]
    corners = [v for (vertices, _), _ in sails for v in vertices]
    centre = [sum(v[i] for v in corners) / len(corners) for i in range(3)]

    left = view(centre, 110.0, 2.0, 0.45, (WIDTH * 0.27, HEIGHT * 0.55))
    for p in points:
        x, y, depth = left(p)
        # The ceiling and the near walls would hide the model.
        if x < WIDTH * 0.53 and p[2] < 2.0 and depth > -3.0:
            share = min(max((p[2] + 1.4) / 3.6, 0.0), 1.0)
            canvas.put(round(x), round(y), depth,
                       (int(40 + 190 * share), int(90 + 60 * math.sin(3.1 * share)), int(190 - 150 * share)))
    right = view(centre, 225.0, 2.0, 0.12, (WIDTH * 0.77, HEIGHT * 0.5))
    for (vertices, faces), tint in sails:
        seen = [right(v) for v in vertices]
        for f in faces:
            canvas.triangle(*(seen[i] for i in f), shade(*(vertices[i] for i in f), tint))
    canvas.save(out)


if __name__ == "__main__":
    main()

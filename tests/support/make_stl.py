#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes our own STL models into configs/geometry: plate_with_hole.stl (binary), bracket.stl (ASCII).

    make_stl.py [FOLDER]

Both are prisms over a closed outline with round corners and holes, so that one routine makes them:
walls between two copies of the outline, and lids triangulated strip by strip.
"""
import math
import pathlib
import struct
import sys


def arc(center, radius, start_deg, end_deg, steps):
    """Points of an arc, both ends included."""
    angles = (math.radians(start_deg + (end_deg - start_deg) * i / steps) for i in range(steps + 1))
    return [(center[0] + radius * math.cos(a), center[1] + radius * math.sin(a)) for a in angles]


def prism(outline, holes, low, high):
    """Triangles of the solid between z = low and z = high over an outline with holes.

    The outline runs counter-clockwise, holes run clockwise: material is on the left.
    """
    triangles = []
    for loop in [outline, *holes]:
        for (ax, ay), (bx, by) in zip(loop, loop[1:] + loop[:1]):
            a, b = (ax, ay, low), (bx, by, low)
            c, d = (bx, by, high), (ax, ay, high)
            triangles += [(a, b, c), (a, c, d)]
    for a, b, c in ears(joined(outline, holes)):
        triangles.append(tuple((x, y, high) for x, y in (a, b, c)))
        triangles.append(tuple((x, y, low) for x, y in (c, b, a)))
    return triangles


def joined(outline, holes):
    """One loop: each hole is cut open where it is nearest to what there is."""
    loop = list(outline)
    for hole in holes:
        i, j = min(
            ((i, j) for i in range(len(loop)) for j in range(len(hole))),
            key=lambda ij: math.dist(loop[ij[0]], hole[ij[1]]),
        )
        loop = loop[: i + 1] + hole[j:] + hole[: j + 1] + loop[i:]
    return loop


def turn(a, b, c):
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def ears(loop):
    """Ear clipping that takes the roundest ear first."""

    def roundness(i):
        a, b, c = loop[i - 1], loop[i], loop[(i + 1) % len(loop)]
        area = turn(a, b, c)
        if area <= 1e-12:
            return -1.0
        for p in loop:
            if p not in (a, b, c) and min(turn(a, b, p), turn(b, c, p), turn(c, a, p)) >= 0.0:
                return -1.0
        return area / (math.dist(a, b) ** 2 + math.dist(b, c) ** 2 + math.dist(c, a) ** 2)

    loop = list(loop)
    while len(loop) > 3:
        i = max(range(len(loop)), key=roundness)
        if roundness(i) < 0.0:
            raise ValueError("outline cannot be triangulated")
        yield loop[i - 1], loop[i], loop[(i + 1) % len(loop)]
        del loop[i]
    yield tuple(loop)


def plate_with_hole():
    """100 x 60 x 10 with a round hole of diameter 30."""
    outline = [(0, 0), (100, 0), (100, 60), (0, 60)]
    hole = list(reversed(arc((50, 30), 15, 0, 360, 64)[:-1]))
    return prism(outline, [hole], 0, 10)


def bracket():
    """L-shaped, rounded inside, with two bolt holes."""
    outline = [(0, 0), (80, 0), (80, 12)]
    outline += arc((22, 22), 10, 270, 180, 12)
    outline += [(12, 80), (0, 80)]
    holes = [list(reversed(arc(c, 3.5, 0, 360, 32)[:-1])) for c in ((62, 6), (6, 62))]
    return prism(outline, holes, -15, 15)


def write_binary(file, triangles):
    with open(file, "wb") as out:
        out.write(b"binary STL".ljust(80, b"\0"))
        out.write(struct.pack("<I", len(triangles)))
        for corners in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *(x for p in corners for x in p), 0))


def write_ascii(file, name, triangles):
    with open(file, "w") as out:
        print("solid", name, file=out)
        for corners in triangles:
            print("  facet normal 0 0 0\n    outer loop", file=out)
            for p in corners:
                print("      vertex", *(f"{x:.7g}" for x in p), file=out)
            print("    endloop\n  endfacet", file=out)
        print("endsolid", name, file=out)


def main():
    root = pathlib.Path(__file__).resolve().parents[2]
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else root / "configs/geometry"
    folder.mkdir(parents=True, exist_ok=True)
    write_binary(folder / "plate_with_hole.stl", plate_with_hole())
    write_ascii(folder / "bracket.stl", "bracket", bracket())


if __name__ == "__main__":
    main()

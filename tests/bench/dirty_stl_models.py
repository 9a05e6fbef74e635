# SPDX-License-Identifier: BSD-3-Clause
"""STL files that bound no body, made of bodies that do: for dirty_stl. Triangles are arrays of shape
(n, 3, 3). Everything follows from fixed seeds."""
import dataclasses
import pathlib
import struct

import numpy as np

GEOMETRY = pathlib.Path(__file__).resolve().parents[2] / "configs" / "geometry"


@dataclasses.dataclass(frozen=True)
class Dirty:
    name: str
    wrong: str  # In words.
    triangles: np.ndarray
    volume: float  # Of what was meant; 0: nobody knows.


def read_stl(file):
    data = file.read_bytes()
    if len(data) >= 84 and len(data) == 84 + 50 * struct.unpack_from("<I", data, 80)[0]:
        rows = np.frombuffer(data, dtype=np.dtype([("normal", "<f4", 3), ("xyz", "<f4", (3, 3)), ("bits", "<u2")]),
                             offset=84)
        return rows["xyz"].astype(float)
    numbers = [line.split()[1:] for line in data.decode(errors="replace").splitlines() if "vertex" in line]
    return np.array(numbers, dtype=float).reshape(-1, 3, 3)


def write_stl(file, triangles, name="dirty"):
    """As text: NETGEN's Python reads no other."""
    facets = ("facet normal 0 0 0\nouter loop\n" + "".join("vertex {:.9g} {:.9g} {:.9g}\n".format(*p) for p in one)
              + "endloop\nendfacet\n" for one in triangles)
    file.write_text(f"solid {name}\n" + "".join(facets) + f"endsolid {name}\n")


def volume_of(triangles):
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


def diagonal(triangles):
    points = triangles.reshape(-1, 3)
    return float(np.linalg.norm(points.max(axis=0) - points.min(axis=0)))


def grid(points, wraps_rows, wraps_columns):
    """Two triangles a square of a grid of points, shape (rows, columns, 3)."""
    rows, columns = points.shape[:2]
    triangles = []
    for i in range(rows if wraps_rows else rows - 1):
        for j in range(columns if wraps_columns else columns - 1):
            p, q = points[i, j], points[(i + 1) % rows, j]
            r, s = points[(i + 1) % rows, (j + 1) % columns], points[i, (j + 1) % columns]
            triangles += [(p, q, r), (p, r, s)]
    return np.array(triangles)


def box(low, high):
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
    rows = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4),
            (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]  # fmt: skip
    return (low + corners * (high - low))[np.array(rows)]


def cut(triangles):
    """Each triangle in four."""
    a, b, c = triangles[:, 0], triangles[:, 1], triangles[:, 2]
    ab, bc, ca = (a + b) / 2, (b + c) / 2, (c + a) / 2
    return np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])


def sphere(levels=4, centre=(0, 0, 0)):
    x, y, z = np.eye(3)
    rows = [(x, y, z), (y, -x, z), (-x, -y, z), (-y, x, z), (y, x, -z), (-x, y, -z), (-y, -x, -z), (x, -y, -z)]
    triangles = np.array(rows)
    for _ in range(levels):
        triangles = cut(triangles)
        triangles /= np.linalg.norm(triangles, axis=2, keepdims=True)
    return triangles + np.array(centre)


def torus(large=3.0, small=1.0, rows=48, columns=24):
    u, v = np.meshgrid(np.arange(rows) * 2 * np.pi / rows, np.arange(columns) * 2 * np.pi / columns, indexing="ij")
    radius = large + small * np.cos(v)
    return grid(np.stack([radius * np.cos(u), radius * np.sin(u), small * np.sin(v)], axis=2), True, True)


def tube(start, end, radius, sides=24):
    """The side of a cylinder, open at both ends."""
    start, end = np.array(start, dtype=float), np.array(end, dtype=float)
    axis = (end - start) / np.linalg.norm(end - start)
    across = np.cross(axis, [0.3, 0.5, 0.8])
    across /= np.linalg.norm(across)
    other = np.cross(axis, across)
    angles = np.arange(sides) * 2 * np.pi / sides
    ring = radius * (np.outer(np.cos(angles), across) + np.outer(np.sin(angles), other))
    return grid(np.stack([end + ring, start + ring]), False, True)


def turned(triangles):
    return triangles[:, [0, 2, 1]]


def middles(triangles):
    return triangles.mean(axis=1)


def without_some(triangles, count, seed=1):
    gone = np.random.default_rng(seed).choice(len(triangles), count, replace=False)
    return np.delete(triangles, gone, axis=0)


def without_ball(triangles, share):
    """Without the triangles around one of them, within a share of the diagonal."""
    centre = middles(triangles)[len(triangles) // 3]
    return triangles[np.linalg.norm(middles(triangles) - centre, axis=1) > share * diagonal(triangles)]


def with_flipped_part(triangles, axis=0, gap=2e-3):
    """One half is turned and a little apart."""
    place = np.median(middles(triangles)[:, axis])
    is_half = middles(triangles)[:, axis] > place
    half = turned(triangles[is_half])
    half[:, :, axis] += gap * diagonal(triangles)
    return np.concatenate([triangles[~is_half], half])


def with_t_junctions(triangles, share=0.2, seed=2):
    """Some triangles are cut at the middle of an edge, whose other triangle is not."""
    is_cut = np.random.default_rng(seed).random(len(triangles)) < share
    a, b, c = (triangles[is_cut][:, i] for i in range(3))
    middle = (a + b) / 2
    return np.concatenate([triangles[~is_cut], np.stack([a, middle, c], axis=1), np.stack([middle, b, c], axis=1)])


def with_loose_triangles(triangles, shrink=5e-3):
    centre = middles(triangles)[:, None]
    return centre + (1 - shrink) * (triangles - centre)


def with_noise(triangles, share=5e-4, seed=3):
    return triangles + np.random.default_rng(seed).normal(0, share * diagonal(triangles), triangles.shape)


def with_copy(triangles, share=2e-3):
    return np.concatenate([triangles, triangles + share * diagonal(triangles) * np.array([0.6, 0.48, 0.64])])


def with_fin(triangles):
    a, b = triangles[0, 0], triangles[0, 1]
    out = np.cross(triangles[0, 1] - triangles[0, 0], triangles[0, 2] - triangles[0, 0])
    tip = (a + b) / 2 + 0.2 * diagonal(triangles) * out / np.linalg.norm(out)
    return np.concatenate([triangles, [[a, b, tip]]])


def robot_arm():
    parts = [tube((0, 0, 0), (0, 0, 4), 0.8), tube((0, 0, 3.5), (3, 0, 5), 0.6), tube((2.6, 0, 4.9), (5, 1, 3), 0.5),
             sphere(3, (0, 0, 4)), sphere(3, (3, 0, 5))]
    return np.concatenate(parts)


def printed_tag():
    plate = box((0, 0, 0), (20, 8, 1.5))
    pegs = [tube((x, 4, 0.7), (x, 4, 4), 1.2) for x in (3, 7, 11, 15)]
    lids = [np.array([[p[0], p[1], [x, 4, 4]] for p in peg[1::2][:, [0, 2]]]) for x, peg in zip((3, 7, 11, 15), pegs)]
    return np.concatenate([plate, *pegs, *lids])


def all_models():
    bracket, plate = read_stl(GEOMETRY / "bracket.stl"), read_stl(GEOMETRY / "plate_with_hole.stl")
    ball, ring, block = sphere(), torus(), box((0, 0, 0), (4, 3, 2))
    def dirty(name, wrong, triangles, of=None):
        return Dirty(name, wrong, triangles, 0.0 if of is None else of)
    fine = cut(cut(bracket))
    v_bracket, v_plate, v_ball = volume_of(bracket), volume_of(plate), volume_of(ball)
    v_ring, v_block = volume_of(ring), volume_of(block)
    wall = np.array([[[2, 0, 0], [2, 3, 0], [2, 3, 2]], [[2, 0, 0], [2, 3, 2], [2, 0, 2]]], dtype=float)
    return [
        dirty("block_facet", "a facet is missing", block[1:], v_block),
        dirty("block_wall", "a wall inside, its edges are not joined", np.concatenate([block, wall]), v_block),
        dirty("block_edge", "two blocks that meet at one edge",
              np.concatenate([block, block + [4, 3, 0]]), 2 * v_block),
        dirty("blocks_crossing", "two blocks that cross",
              np.concatenate([block, block + [2.5, 1.7, 1.2]]), 2 * v_block - 1.5 * 1.3 * 0.8),
        dirty("bracket_holes", "5 small holes", without_some(fine, 5), v_bracket),
        dirty("bracket_hole", "a hole of 0.15 diagonals", without_ball(fine, 0.15), v_bracket),
        dirty("bracket_missing", "every tenth facet is missing", without_some(fine, len(fine) // 10), v_bracket),
        dirty("bracket_fin", "a triangle that sticks out", with_fin(bracket), v_bracket),
        dirty("bracket_double", "each wall twice, 0.002 diagonals apart", with_copy(bracket), v_bracket),
        dirty("plate_flipped", "a half is turned, 0.002 diagonals apart", with_flipped_part(cut(plate)), v_plate),
        dirty("plate_junctions", "T-junctions at a fifth of the facets",
              with_t_junctions(plate) + 0.0, v_plate),
        dirty("plate_loose", "all facets loose, with gaps", with_loose_triangles(cut(plate)), v_plate),
        dirty("ball_cap", "a cap of 0.3 radii is missing",
              ball[middles(ball)[:, 2] < 0.7], v_ball),
        dirty("ball_loose", "all facets loose, with gaps", with_loose_triangles(ball), v_ball),
        dirty("balls_crossing", "two balls that cross", np.concatenate([ball, ball + [1.0, 0.2, 0.1]])),
        dirty("ring_noise", "each corner of each facet off by 0.0005 diagonals", with_noise(ring), v_ring),
        dirty("ring_flipped", "every third facet turned, and 20 missing",
              without_some(np.concatenate([turned(ring[::3]), ring[1::3], ring[2::3]]), 20), v_ring),
        dirty("ring_bar", "a bar through a ring", np.concatenate([ring, box((-5, -0.3, -0.3), (5, 0.3, 0.3))])),
        dirty("robot_arm", "open tubes and balls that cross", robot_arm()),
        dirty("printed_tag", "a plate and pegs that cross it, open below", printed_tag()),
    ]

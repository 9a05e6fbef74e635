# SPDX-License-Identifier: BSD-3-Clause
"""A picture of a mesh's surface without a display: VTK would end the process where there is none."""
from __future__ import annotations

import base64
import colorsys
import struct
import zlib
from typing import TYPE_CHECKING

import numpy as np

from ._exchange import ranges

if TYPE_CHECKING:
    from ._mesh import Mesh

_EYE_DEG = (-60.0, 25.0)  # Azimuth and elevation, as pipeline/tools/picture.py.
_SAMPLES = 2  # Drawn twice as large and then shrunk.
_MARGIN = 1.04
_CANDIDATES = 500_000  # Pixels that are looked at at once: some 50 MB.
_FACES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))  # Of a tet in VTK's order, seen from outside.


def picture(mesh: Mesh, size: tuple[int, int], color: str) -> bytes:
    """The surface of a mesh as a PNG of (width, height) pixels. Local."""
    triangles, values = _surface(mesh, color)
    width, height = (_SAMPLES * n for n in size)
    image = np.full((height * width, 3), 255, np.uint8)
    if len(triangles):
        corners, colors = _project(mesh.points, triangles, width, height), _shaded(mesh.points[triangles], values)
        if mesh.comm is None:  # Closed: what looks away from the eye is hidden.
            facing = _looks_here(corners)
            corners, colors = corners[facing], colors[facing]
        _draw(image, corners, colors, width, height)
    fine = image.reshape(size[1], _SAMPLES, size[0], _SAMPLES, 3)
    return png(fine.mean(axis=(1, 3)).astype(np.uint8))


def as_data_url(image: bytes) -> str:
    return "data:image/png;base64," + base64.b64encode(image).decode()


def png(image: np.ndarray) -> bytes:
    """A PNG file of an image of bytes, shape (height, width, 3). Local."""
    height, width, _ = image.shape
    lines = np.concatenate([np.zeros((height, 1), np.uint8), image.reshape(height, 3 * width)], axis=1)

    def chunk(kind: bytes, content: bytes) -> bytes:
        return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))

    return (
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(lines.tobytes(), 6))
        + chunk(b"IEND", b"")
    )


def _surface(mesh: Mesh, color: str) -> tuple[np.ndarray, np.ndarray]:
    """Triangles as rows of points, and the number that colours each."""
    of_cell = {"material": mesh.materials, "subdomain": mesh.subdomains}
    if color not in ("patch", *of_cell):
        raise ValueError(f"color={color!r}: must be patch, material or subdomain")
    if len(mesh.triangles):
        values = mesh.patches if color == "patch" else of_cell[color][mesh.triangle_cells]
        return mesh.triangles[:, :3], values
    # A mesh without a boundary of its own: what is on one tet only.
    faces = mesh.cells[:, np.array(_FACES)].reshape(-1, 3)
    _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    outer = first[count == 1]
    return faces[outer], of_cell.get(color, mesh.materials)[outer // 4]


def _axes() -> np.ndarray:
    """Rows: to the right, upwards, to the eye."""
    azimuth, elevation = np.radians(_EYE_DEG)
    eye = np.array(
        [np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)]
    )
    right = np.array([-np.sin(azimuth), np.cos(azimuth), 0.0])
    return np.stack([right, np.cross(eye, right), eye])


def _project(points: np.ndarray, triangles: np.ndarray, width: int, height: int) -> np.ndarray:
    """Corners in pixels from the upper left, with the nearness to the eye; shape (num_triangles, 3, 3)."""
    seen = points @ _axes().T
    used = seen[np.unique(triangles)]
    low, high = used.min(axis=0), used.max(axis=0)
    span = np.maximum(high - low, 1e-300)
    scale = min(width / span[0], height / span[1]) / _MARGIN
    seen = (seen - 0.5 * (low + high)) * [scale, -scale, 1.0] + [0.5 * width, 0.5 * height, 0.0]
    return seen[triangles]


def _looks_here(corners: np.ndarray) -> np.ndarray:
    a, b, c = (corners[:, i, :2] for i in range(3))
    (ux, uy), (vx, vy) = (b - a).T, (c - a).T
    return ux * vy - uy * vx < 0.0  # Pixels are counted downwards.


def _shaded(corners: np.ndarray, values: np.ndarray) -> np.ndarray:
    """A colour for each triangle: far hues for neighbouring numbers, brighter if it faces the eye."""
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-300)
    light = _axes().T @ [0.3, 0.45, 0.84]
    brightness = 0.45 + 0.55 * np.abs(normal @ light)
    kinds, kind = np.unique(values, return_inverse=True)
    hues = [
        colorsys.hsv_to_rgb((0.58 + i * 0.6180339887) % 1.0, (0.45, 0.62, 0.52)[i % 3], (0.97, 0.88)[i % 2])
        for i in range(len(kinds))
    ]
    return (255 * np.array(hues)[kind] * brightness[:, None]).astype(np.uint8)


def _draw(image: np.ndarray, corners: np.ndarray, colors: np.ndarray, width: int, height: int) -> None:
    """Triangles one over the other: at each pixel the one nearest to the eye stays."""
    low = np.clip(np.floor(corners[:, :, :2].min(axis=1)).astype(int), 0, [width - 1, height - 1])
    high = np.clip(np.ceil(corners[:, :, :2].max(axis=1)).astype(int), 0, [width - 1, height - 1])
    box = high - low + 1
    ends = np.cumsum(box.prod(axis=1))
    nearest = np.full(width * height, -np.inf)
    begin = 0
    while begin < len(corners):
        done = ends[begin - 1] if begin else 0
        end = max(begin + 1, int(np.searchsorted(ends, done + _CANDIDATES)))
        part = slice(begin, end)
        pixel, nearness, triangle = _covered(corners[part], low[part], box[part], width)
        _keep_nearest(image, nearest, pixel, nearness, colors[part][triangle])
        begin = end


def _covered(
    corners: np.ndarray, low: np.ndarray, box: np.ndarray, width: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Pixels whose middle is in a triangle, how near it is to the eye there, and which triangle."""
    counts = box.prod(axis=1)
    triangle = np.repeat(np.arange(len(corners)), counts)
    within = ranges(np.zeros(len(corners), int), counts)
    y, x = np.divmod(within, box[:, 0][triangle])
    a, b, c, nearness = (
        at_low[triangle] + by_x[triangle] * x + by_y[triangle] * y
        for at_low, by_x, by_y in _linear_functions(corners, low + 0.5)
    )
    inside = (a >= 0.0) & (b >= 0.0) & (c >= 0.0)
    x, y, triangle = x[inside], y[inside], triangle[inside]
    return (y + low[triangle, 1]) * width + x + low[triangle, 0], nearness[inside], triangle


def _linear_functions(corners: np.ndarray, origin: np.ndarray) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """The three barycentric coordinates and the nearness to the eye of each triangle: the value at its origin,
    and the growth along x and y."""
    a = corners[:, 0]
    to_b, to_c = corners[:, 1] - a, corners[:, 2] - a
    area = to_b[:, 0] * to_c[:, 1] - to_b[:, 1] * to_c[:, 0]
    area[area == 0.0] = np.nan  # Seen from its edge: covers nothing.
    from_a = origin - a[:, :2]
    bx, by = to_c[:, 1] / area, -to_c[:, 0] / area
    cx, cy = -to_b[:, 1] / area, to_b[:, 0] / area
    b = (from_a[:, 0] * bx + from_a[:, 1] * by, bx, by)
    c = (from_a[:, 0] * cx + from_a[:, 1] * cy, cx, cy)
    nearness = [start + to_b[:, 2] * of_b + to_c[:, 2] * of_c for start, of_b, of_c in zip((a[:, 2], 0.0, 0.0), b, c)]
    return [(1.0 - b[0] - c[0], -bx - cx, -by - cy), b, c, tuple(nearness)]


def _keep_nearest(
    image: np.ndarray, nearest: np.ndarray, pixel: np.ndarray, nearness: np.ndarray, color: np.ndarray
) -> None:
    order = np.lexsort((nearness, pixel))
    pixel, nearness, color = pixel[order], nearness[order], color[order]
    last = np.append(pixel[1:] != pixel[:-1], True)[: len(pixel)]
    pixel, nearness, color = pixel[last], nearness[last], color[last]
    nearer = nearness > nearest[pixel]
    nearest[pixel[nearer]] = nearness[nearer]
    image[pixel[nearer]] = color[nearer]

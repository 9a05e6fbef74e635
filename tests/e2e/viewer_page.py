# SPDX-License-Identifier: BSD-3-Clause
"""Reads what a page shows back from it: what its scripts read, decoded here a second time."""
import base64
import json
import re
import zlib

import numpy as np


def block_of(text, name):
    """What a script element of a page holds; None if there is none."""
    found = re.search(rf'<script type="[a-z/]+" id="viewer-{name}">(.*?)</script>', text, re.DOTALL)
    return found and found.group(1)


def unpacked(text, layout):
    """The arrays by name: byte planes of differences whose sign is the lowest bit, deflated, in base64."""
    data = zlib.decompress(base64.b64decode(text, validate=True))
    arrays, begin = {}, 0
    for one in layout:
        width, size = one["width"], one["size"]
        planes = np.frombuffer(data, np.uint8, width * size, begin).reshape(width, size).astype(np.int64)
        codes = sum(plane << (8 * p) for p, plane in enumerate(planes))
        differences = np.where(codes % 2 == 0, codes // 2, -(codes + 1) // 2)
        arrays[one["name"]] = np.cumsum(differences) % 2 ** (8 * width)
        begin += width * size
    assert begin == len(data), "bytes are left over"
    return arrays


class ViewerPage:
    """A page with a view.

    Attributes:
        data: What the page says of its surface.
        arrays: Its arrays by name.
        points: Shape (num_points, 3).
        corners: Shape (num_triangles, 3).
    """

    def __init__(self, text):
        self.text = text
        self.data = json.loads(block_of(text, "data"))
        self.arrays = unpacked(block_of(text, "arrays"), self.data["arrays"])
        self.points = self.places("x", "y", "z")
        self.corners = self.arrays["corners"].reshape(-1, 3)

    def places(self, *names):
        steps = np.stack([self.arrays[name] for name in names], axis=1)
        return np.array(self.data["low"]) + np.array(self.data["step"]) * steps

    def three_js(self):
        return zlib.decompress(base64.b64decode(block_of(self.text, "three"), validate=True))

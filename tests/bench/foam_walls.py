# SPDX-License-Identifier: BSD-3-Clause
"""What meshes of OpenFOAM have at their walls: heights of the first cells, and what checkMesh says."""
import os
import re
import shutil
import subprocess
import sys

import bench_data
import numpy as np

sys.path.append(str(bench_data.ROOT / "tests/support"))
from poly_mesh import PolyMesh, body_of, read_list

FOAM = os.environ | {"WM_PROJECT_DIR": "/usr/share/openfoam"}
OFF = 0.1  # Of a height: within is as asked.


def check_mesh(folder):
    """What OpenFOAM's checkMesh says of a mesh; nothing if it is not installed."""
    if shutil.which("checkMesh") is None:
        return {"verdict": None, "non_orthogonality": None, "skewness": None}
    said = subprocess.run(["checkMesh", "-constant"], cwd=folder, env=FOAM, capture_output=True, text=True).stdout
    figure = lambda words: float((re.search(words + r"\s*(\S+?),? ", said) or [0, "nan"])[1])
    failed = re.search(r"Failed (\d+) mesh checks", said)
    return {"verdict": "OK" if "Mesh OK" in said else f"{failed[1]} failed" if failed else "ended",
            "non_orthogonality": figure("Mesh non-orthogonality Max:"), "skewness": figure("Max skewness =")}


class Walls:
    """The faces of some patches and their cells; faces may have any number of corners."""

    def __init__(self, folder, is_wall):
        mesh = folder / "constant/polyMesh"
        self.points = read_list(body_of(mesh / "points"), PolyMesh.VECTOR)[0]
        faces = body_of(mesh / "faces")
        self.begins, end = read_list(faces, "<i4")
        self.corners = read_list(faces, "<i4", end)[0]
        self.owner = read_list(body_of(mesh / "owner"), "<i4")[0]
        self.neighbour = read_list(body_of(mesh / "neighbour"), "<i4")[0]
        self.patches = {name: range(begin, end) for name, (_, begin, end, _)
                        in PolyMesh.read_boundary(mesh / "boundary").items() if is_wall(name)}
        self.faces = np.concatenate([np.array(one, dtype=int) for one in self.patches.values()])
        self.num_cells = int(max(self.owner.max(), self.neighbour.max(initial=0))) + 1  # The last may own no face.
        self.measure_faces()

    def measure_faces(self):
        """Area vectors, and what flows out of each face of the field x / 3: both from fans of triangles."""
        num, of_corner = np.diff(self.begins), np.repeat(np.arange(len(self.begins) - 1), np.diff(self.begins))
        following = np.arange(len(self.corners)) + 1
        following[self.begins[1:] - 1] = self.begins[:-1]
        p, q = self.points[self.corners], self.points[self.corners[following]]
        middle = np.add.reduceat(p, self.begins[:-1]) / num[:, None]
        normals = np.cross(q - p, middle[of_corner] - p) / 2.0
        flux = np.einsum("ij,ij->i", p + q + middle[of_corner], normals) / 9.0
        self.areas = np.linalg.norm(np.add.reduceat(normals, self.begins[:-1]), axis=1)
        self.flux = np.add.reduceat(flux, self.begins[:-1])

    def volumes(self):
        inside = len(self.neighbour)
        return (np.bincount(self.owner, self.flux, minlength=self.num_cells)
                - np.bincount(self.neighbour, self.flux[:inside], minlength=self.num_cells))

    def heights(self):
        """Of the cell at each face: its volume by the mean area of its two ends. The other end are the faces that
        do not touch this one. Without one (a pyramid, a tet) there is no layer: 0."""
        volumes, others = self.volumes(), {int(cell): [] for cell in self.owner[self.faces]}
        for cells in (self.owner, self.neighbour):
            for face in np.isin(cells, list(others)).nonzero()[0]:
                others[int(cells[face])].append(face)
        heights = np.zeros(len(self.faces))
        for i, face in enumerate(self.faces):
            cell, own = int(self.owner[face]), self.corners_of(face)
            ends = sum(self.areas[other] for other in others[cell] if own.isdisjoint(self.corners_of(other)))
            if ends > 0.0:
                heights[i] = 2.0 * volumes[cell] / (self.areas[face] + ends)
        return heights

    def corners_of(self, face):
        return set(self.corners[self.begins[face]:self.begins[face + 1]].tolist())

    def share_as_asked(self, first):
        """Of the area: where the first cell is as high as asked."""
        area, is_right = self.areas[self.faces], abs(self.heights() / first - 1.0) <= OFF
        return float(area[is_right].sum() / area.sum())

# SPDX-License-Identifier: BSD-3-Clause
"""Reads OpenFOAM's polyMesh in binary, by nothing but what its documentation says."""
import re

import numpy


def body_of(file):
    """What follows the head of a binary file, and the comment that OpenFOAM puts behind it."""
    content = file.read_bytes()
    return re.sub(rb"\A\s*//.*\n", b"", content[content.index(b"}\n") + 2 :])


def read_list(content, kind, begin=0):
    """A binary list at a place, and where it ends."""
    head = re.compile(rb"\s*(\d+)\s*").match(content, begin)
    count = int(head.group(1))
    if count == 0:
        return numpy.zeros(0, kind), head.end()
    assert content[head.end() : head.end() + 1] == b"("
    values = numpy.frombuffer(content, kind, count, head.end() + 1)
    end = head.end() + 1 + values.nbytes
    assert content[end : end + 1] == b")"
    return values, end + 1


class PolyMesh:
    """constant/polyMesh in a folder."""

    VECTOR = numpy.dtype(("<f8", 3))

    def __init__(self, folder):
        self.folder = folder
        mesh = folder / "constant/polyMesh"
        self.points = read_list(body_of(mesh / "points"), self.VECTOR)[0]
        faces = body_of(mesh / "faces")
        begins, end = read_list(faces, "<i4")
        corners = read_list(faces, "<i4", end)[0]
        assert begins[0] == 0 and begins[-1] == len(corners)
        self.num_corners = numpy.diff(begins)
        assert set(self.num_corners) <= {3, 4}
        # A triangle has its first corner twice: its second half is of no area.
        last = numpy.where(self.num_corners == 4, begins[1:] - 1, begins[:-1])
        self.quads = numpy.stack([corners[begins[:-1] + i] for i in range(3)] + [corners[last]], axis=1)
        self.faces = self.quads[:, :3]
        self.owner = read_list(body_of(mesh / "owner"), "<i4")[0]
        self.neighbour = read_list(body_of(mesh / "neighbour"), "<i4")[0]
        self.patches = self.read_boundary(mesh / "boundary")
        self.zones = self.read_zones(mesh / "cellZones")
        a, b, c, d = (self.points[self.quads[:, i]] for i in range(4))
        self.face_areas = (numpy.cross(b - a, c - a) + numpy.cross(c - a, d - a)) / 2.0
        self.face_centres = (a + b + c) / 3.0  # Of triangles.
        # What flows out of each face of the field x / 3, by its two halves.
        self.face_flux = sum(
            numpy.einsum("ij,ij->i", p + q + r, numpy.cross(q - p, r - p)) / 18.0 for p, q, r in ((a, b, c), (a, c, d)))

    @staticmethod
    def read_boundary(file):
        """By name: type, first face, end of its faces, both processors."""
        patches = {}
        for name, text in re.findall(r"(\S+)\s*\{(.*?)\}", body_of(file).decode(), re.DOTALL):
            entry = dict(re.findall(r"(\w+) +([^;]+);", text))
            begin = int(entry["startFace"])
            pair = tuple(int(entry[key]) for key in ("myProcNo", "neighbProcNo") if key in entry)
            patches[name] = (entry["type"], begin, begin + int(entry["nFaces"]), pair)
        return patches

    @staticmethod
    def read_zones(file):
        content, zones, place = body_of(file), {}, 0
        zone = re.compile(rb"(\S+)\s*\{\s*type cellZone;\s*cellLabels\s+List<label>")
        while found := zone.search(content, place):
            zones[found.group(1).decode()], place = read_list(content, "<i4", found.end())
        return zones

    def num_cells(self):
        return int(max(self.owner.max(), self.neighbour.max(initial=0))) + 1

    def cell_volumes(self):
        return self.cell_sums(self.face_flux)

    def cell_sums(self, of_faces):
        """What leaves each cell, from what goes through each face out of its owner."""
        inner = len(self.neighbour)
        sums = numpy.bincount(self.owner, of_faces, minlength=self.num_cells())
        return sums - numpy.bincount(self.neighbour, of_faces[:inner], minlength=self.num_cells())

    def cell_centres(self):
        """Of tets: the means of their corners."""
        sides = numpy.concatenate([self.owner, self.neighbour])
        faces = numpy.concatenate([self.face_centres, self.face_centres[: len(self.neighbour)]])
        sums = [numpy.bincount(sides, faces[:, d], minlength=self.num_cells()) for d in range(3)]
        return numpy.stack(sums, axis=1) / 4.0

    def outer_patches(self):
        return {name: patch for name, patch in self.patches.items() if patch[0] == "patch"}

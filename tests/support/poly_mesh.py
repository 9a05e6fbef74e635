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
        assert (numpy.diff(begins) == 3).all() and begins[-1] == len(corners)
        self.faces = corners.reshape(-1, 3)
        self.owner = read_list(body_of(mesh / "owner"), "<i4")[0]
        self.neighbour = read_list(body_of(mesh / "neighbour"), "<i4")[0]
        self.patches = self.read_boundary(mesh / "boundary")
        self.zones = self.read_zones(mesh / "cellZones")
        a, b, c = (self.points[self.faces[:, i]] for i in range(3))
        self.face_centres = (a + b + c) / 3.0
        self.face_areas = numpy.cross(b - a, c - a) / 2.0

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
        flux = numpy.einsum("ij,ij->i", self.face_centres, self.face_areas) / 3.0
        volumes = numpy.bincount(self.owner, flux, minlength=self.num_cells())
        inner = len(self.neighbour)
        return volumes - numpy.bincount(self.neighbour, flux[:inner], minlength=self.num_cells())

    def cell_centres(self):
        """Of tets: the means of their corners."""
        sides = numpy.concatenate([self.owner, self.neighbour])
        faces = numpy.concatenate([self.face_centres, self.face_centres[: len(self.neighbour)]])
        sums = [numpy.bincount(sides, faces[:, d], minlength=self.num_cells()) for d in range(3)]
        return numpy.stack(sums, axis=1) / 4.0

    def outer_patches(self):
        return {name: patch for name, patch in self.patches.items() if patch[0] == "patch"}

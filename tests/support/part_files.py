# SPDX-License-Identifier: BSD-3-Clause
"""Readers of formats with files for each part of a mesh: MFEM's and Elmer's."""
import collections
import itertools
import pathlib
import re

SIDES = tuple(itertools.combinations(range(4), 3))
EDGES = tuple(itertools.combinations(range(4), 2))


class Part:
    """A part of a mesh; a point is its position, so that parts can be compared."""

    def __init__(self, points, tets, materials, triangles, patches):
        self.points = [tuple(point) for point in points]
        self.tets, self.materials = tets, materials
        self.triangles, self.patches = triangles, patches

    def at(self, rows):
        return tuple(self.points[row] for row in rows)

    def entities(self):
        """Its points, edges and faces: each a set of positions."""
        found = set()
        for tet in self.tets:
            for corners in (*((c,) for c in range(4)), *EDGES, *SIDES):
                found.add(frozenset(self.at(tet[c] for c in corners)))
        return found


def shared_by(parts):
    """Entity -> the parts that have it, for those of more than one."""
    owners = collections.defaultdict(list)
    for number, part in enumerate(parts):
        for entity in part.entities():
            owners[entity].append(number)
    return {entity: tuple(numbers) for entity, numbers in owners.items() if len(numbers) > 1}


class Words:
    """A text word by word, without comments."""

    def __init__(self, text):
        self.words = iter(re.sub(r"#.*", "", text).split())

    def next(self, expected=None):
        word = next(self.words)
        assert expected is None or word == expected, (word, expected)
        return word

    def number(self, name=None):
        if name is not None:
            self.next(name)
        return int(self.next())

    def rows(self, count, width, kind=int):
        return [[kind(self.next()) for _ in range(width)] for _ in range(count)]


class MfemPart(Part):
    """mesh.000000 and so on: what ParMesh reads. With named sets it is mesh_sets.000000."""

    def __init__(self, file):
        version, _, text = file.read_text().partition("\n")
        assert version == ("MFEM mesh v1.3" if file.name.startswith("mesh_sets.") else "MFEM mesh v1.2")
        self.names = dict(re.findall(r"^# ((?:boundary )?attribute \d+): (.*)$", text, re.MULTILINE))
        if version.endswith("v1.3"):
            assert not self.names
            self.names, text = self.take_sets(text)
        words = Words(text)
        assert words.number("dimension") == 3
        tets = words.rows(words.number("elements"), 6)
        assert all(tet[1] == 4 for tet in tets)
        triangles = words.rows(words.number("boundary"), 5)
        assert all(triangle[1] == 2 for triangle in triangles)
        num_points = words.number("vertices")
        assert words.number() == 3
        points = words.rows(num_points, 3, float)
        words.next("mfem_serial_mesh_end")
        super().__init__(
            points, [tet[2:] for tet in tets], [tet[0] for tet in tets],
            [triangle[2:] for triangle in triangles], [triangle[0] for triangle in triangles],
        )  # fmt: skip
        self.read_groups(words)

    @staticmethod
    def take_sets(text):
        """Names as comments of v1.2 have them, and the text without the sets, which stand behind elements and
        boundary."""
        names = {}
        for keyword, kind, before in (("attribute_sets", "attribute", "boundary"),
                                      ("bdr_attribute_sets", "boundary attribute", "vertices")):  # fmt: skip
            found = re.search(rf'^{keyword}\n(\d+)\n((?:".*\n)*)\n(?={before}\n)', text, re.MULTILINE)
            lines = re.findall(r'^"([^"]+)" 1 (\d+)$', found[2], re.MULTILINE)
            assert len(lines) == int(found[1]) == found[2].count("\n")
            assert len({name for name, _ in lines}) == len(lines)
            names.update({f"{kind} {tag}": name for name, tag in lines})
            text = text[: found.start()] + text[found.end() :]
        return names, text

    def read_groups(self, words):
        words.next("communication_groups")
        self.members = [
            tuple(words.rows(1, words.number())[0]) for _ in range(words.number("number_of_groups"))
        ]
        self.totals = [words.number(f"total_shared_{kind}") for kind in ("vertices", "edges", "faces")]
        self.shared = {}
        for members in self.members[1:]:
            assert members not in self.shared, members
            points = words.rows(words.number("shared_vertices"), 1)
            edges = words.rows(words.number("shared_edges"), 2)
            faces = words.rows(words.number("shared_faces"), 4)
            assert all(face[0] == 2 for face in faces)
            self.shared[members] = (points, edges, [face[1:] for face in faces])
        words.next("mfem_mesh_end")
        assert next(words.words, None) is None


def rows_of(file, kind=int):
    return [[kind(word) for word in line.split()] for line in file.read_text().splitlines()]


class ElmerPart(Part):
    """part.n.*: what ElmerSolver reads. Numbers are those of the whole mesh."""

    def __init__(self, folder, number):
        name = str(folder / f"part.{number}.")
        nodes = rows_of(pathlib.Path(name + "nodes"), float)
        self.header = rows_of(pathlib.Path(name + "header"))
        self.elements = rows_of(pathlib.Path(name + "elements"))
        self.boundary = rows_of(pathlib.Path(name + "boundary"))
        self.shared = {row[0]: row[1:] for row in rows_of(pathlib.Path(name + "shared"))}
        assert all(node[1] == -1 for node in nodes)
        assert all(element[2] == 504 for element in self.elements)
        assert all(element[4] == 303 for element in self.boundary)
        self.numbers = [int(node[0]) for node in nodes]
        row = {number: i for i, number in enumerate(self.numbers)}
        super().__init__(
            [node[2:] for node in nodes],
            [[row[n] for n in element[3:]] for element in self.elements],
            [element[1] for element in self.elements],
            [[row[n] for n in element[5:]] for element in self.boundary],
            [element[1] for element in self.boundary],
        )

# SPDX-License-Identifier: BSD-3-Clause
"""Formats with one file a part, read by readers of our own: every tet and triangle is in one part, and
all parts tell the same of what they share."""
import collections
import hashlib
import itertools
import pathlib
import re
import resource
import shutil
import sys
import unittest

import numpy

import program
from program import CANNOT_WRITE, CONFIGS, OK, sets
from vtk_test import read, texts
from vtkmodules.util.numpy_support import vtk_to_numpy
from writes_test import without_files_of_mpi

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from part_files import SIDES, ElmerPart, MfemPart, shared_by  # noqa: E402
from poly_mesh import PolyMesh, body_of, read_list  # noqa: E402

PARTS = 6
FORMATS = ("elmer", "mfem", "mfem-sets", "openfoam", "openfoam-serial")


def hashes(folder):
    files = (file for file in folder.rglob("*") if file.is_file())
    return {str(file.relative_to(folder)): hashlib.sha256(file.read_bytes()).hexdigest() for file in files}


def cells_of(file, values, names):
    """Sets of positions of the cells, with the name of each."""
    grid = read(file)[0]
    points = [tuple(point) for point in vtk_to_numpy(grid.GetPoints().GetData()).tolist()]
    cells = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(grid.GetNumberOfCells(), -1)
    tags = vtk_to_numpy(grid.GetCellData().GetArray(values)).tolist()
    first = 1 if values == "attribute" else 0
    return {
        frozenset(points[p] for p in cell): texts(grid, names)[tag - first]
        for cell, tag in zip(cells.tolist(), tags)
    }  # fmt: skip


class PartitionedFormats(program.ProgramTest):
    """One mesh of two materials, in all formats."""

    @classmethod
    def setUpClass(cls):
        maker = cls.make_maker()
        model = CONFIGS / "geometry" / "two_blocks.step"
        case = maker.write_case(geometry=model, max_size=6, subdomains=12)
        words = ", ".join(f"'{name}'" for name in ("pvtu", *FORMATS))
        settings = sets(f"output.parts={PARTS}", f"output.formats=[{words}]")
        cls.source = maker.mesh(case, "mesh", *settings, ranks=2)
        cls.in_one_part = maker.mesh(case, "one", *sets("output.parts=1", f"output.formats=[{words}]"))
        cls.tets = cells_of(cls.source / "mesh.pvtu", "attribute", "material_names")
        cls.triangles = cells_of(cls.source / "boundary.pvtu", "patch", "patch_names")

    def convert(self, output, *arguments, ranks=None, **options):
        formats = [word for name in FORMATS for word in ("--format", name)]
        return self.run_program(
            "convert", self.source / "mesh.pvtu", *formats, "--output", output, *arguments, ranks=ranks,
            **options,
        )  # fmt: skip

    def assert_every_cell_once(self, parts, material_names, patch_names):
        """Positive tets and outward triangles, each in one part, under the name it has."""
        tets, triangles = [], []
        for part in parts:
            sides = {}
            for tet, material in zip(part.tets, part.materials):
                corners = part.at(tet)
                a, b, c, d = map(numpy.array, corners)
                self.assertGreater(numpy.dot(numpy.cross(b - a, c - a), d - a), 0.0)
                tets.append((frozenset(corners), material_names[material]))
                sides.update({frozenset(corners[i] for i in side): corners for side in SIDES})
            for triangle, patch in zip(part.triangles, part.patches):
                corners = part.at(triangle)
                self.assertIn(frozenset(corners), sides)
                triangles.append((frozenset(corners), patch_names[patch]))
        self.assertEqual((len(tets), dict(tets)), (len(self.tets), self.tets))
        self.assertEqual((len(triangles), dict(triangles)), (len(self.triangles), self.triangles))

    def test_mfem(self):
        files = sorted(self.source.glob("mesh.0*"))
        self.assertEqual([file.name for file in files], [f"mesh.{p:06}" for p in range(PARTS)])
        parts = [MfemPart(file) for file in files]
        names = parts[0].names
        self.assert_every_cell_once(
            parts,
            {tag: names.get(f"attribute {tag}") for tag in range(1, 9)},
            {tag: names.get(f"boundary attribute {tag}") for tag in range(1, 99)},
        )
        shared = shared_by(parts)
        self.assertTrue(any(len(numbers) > 2 for numbers in shared.values()))
        for number, part in enumerate(parts):
            listed = {}
            self.assertEqual(part.members[0], (number,))
            for members, kinds in part.shared.items():
                self.assertEqual(list(members), sorted(set(members)))
                self.assertIn(number, members)
                for kind, rows in enumerate(kinds):
                    entities = [part.at(row) for row in rows]
                    for other in members:
                        other_rows = parts[other].shared[members][kind]
                        self.assertEqual([parts[other].at(row) for row in other_rows], entities)
                    for entity in entities:
                        self.assertNotIn(frozenset(entity), listed)
                        listed[frozenset(entity)] = members
            self.assertEqual(listed, {entity: pieces for entity, pieces in shared.items() if number in pieces})
            counts = collections.Counter(map(len, listed))
            self.assertEqual(part.totals, [counts[1], counts[2], counts[3]])

    def test_mfem_with_named_sets_is_the_same_mesh(self):
        for number, file in enumerate(sorted(self.source.glob("mesh_sets.*"))):
            named, plain = MfemPart(file), MfemPart(self.source / f"mesh.{number:06}")
            self.assertGreater(len(named.names), 2)
            self.assertEqual(vars(named), vars(plain))
        self.assertEqual(number, PARTS - 1)

    def test_mfem_edges_are_those_of_both_parts(self):
        """Two parts may have both ends of an edge that only one has: it is not shared."""
        parts = [MfemPart(file) for file in sorted(self.source.glob("mesh.0*"))]
        shared, num_false = shared_by(parts), 0
        for number, part in enumerate(parts):
            for entity in part.entities():
                if len(entity) != 2:
                    continue
                common = set.intersection(*(set(shared.get(frozenset([end]), ())) for end in entity))
                if common - set(shared.get(entity, (number,))):
                    num_false += 1
        self.assertGreater(num_false, 0)

    def elmer_parts(self, source=None, num_parts=PARTS):
        folder = (source or self.source) / f"partitioning.{num_parts}"
        self.assertEqual(len(list(folder.iterdir())), 5 * num_parts)
        return [ElmerPart(folder, number + 1) for number in range(num_parts)]

    def test_elmer(self):
        parts = self.elmer_parts()
        names = (self.source / "mesh.names").read_text()
        bodies, patches = names.split("! ----- names for boundaries -----")
        named = [
            {int(tag): name for name, tag in re.findall(r"^\$ (.*) = (\d+)$", text, re.MULTILINE)}
            for text in (bodies, patches)
        ]
        self.assert_every_cell_once(parts, *named)
        numbers = sorted(element[0] for part in parts for element in part.elements)
        self.assertEqual(numbers, list(range(1, len(self.tets) + 1)))
        numbers = sorted(element[0] for part in parts for element in part.boundary)
        self.assertEqual(numbers, list(range(1, len(self.triangles) + 1)))
        for part in parts:
            num_tets, num_triangles = len(part.tets), len(part.triangles)
            self.assertEqual(
                part.header,
                [[len(part.points), num_tets, num_triangles], [2], [504, num_tets], [303, num_triangles],
                 [len(part.shared), 0]],
            )  # fmt: skip

    def test_elmer_nodes(self):
        """A number is a point; the parts that have it are listed in each, its owner first."""
        position, parts_with = {}, collections.defaultdict(list)
        parts = self.elmer_parts()
        for p, part in enumerate(parts):
            for number, point in zip(part.numbers, part.points):
                self.assertEqual(position.setdefault(number, point), point)
                parts_with[number].append(p + 1)
        self.assertEqual(sorted(position), list(range(1, len(position) + 1)))
        self.assertEqual(len(set(position.values())), len(position))
        for p, part in enumerate(parts):
            expected = {n: [len(w), *w] for n, w in parts_with.items() if len(w) > 1 and p + 1 in w}
            self.assertEqual(part.shared, expected)
        self.assertGreater(max(map(len, parts_with.values())), 2)

    def test_elmer_parents(self):
        """A triangle names the tets of its part on its sides."""
        kinds = collections.Counter()
        on_side = collections.Counter(
            frozenset(corners[i] for i in side) for corners in map(tuple, self.tets) for side in SIDES
        )
        for part in self.elmer_parts() + self.elmer_parts(self.in_one_part, 1):
            corners = {element[0]: set(element[3:]) for element in part.elements}
            having = collections.defaultdict(set)
            for number, nodes in corners.items():
                for side in itertools.combinations(sorted(nodes), 3):
                    having[side].add(number)
            for triangle, element in zip(part.triangles, part.boundary):
                parents = {parent for parent in element[2:4] if parent > 0}
                self.assertGreater(element[2], 0)
                self.assertEqual(parents, having[tuple(sorted(element[5:]))])
                kinds[len(parents), on_side[frozenset(part.at(triangle))]] += 1
        # Outer ones, inner ones with the other tet elsewhere, and with both tets here.
        self.assertTrue(kinds[1, 1] and kinds[1, 2] and kinds[2, 2], kinds)

    def assert_upper_triangular(self, mesh):
        num_inner = len(mesh.neighbour)
        pairs = list(zip(mesh.owner[:num_inner].tolist(), mesh.neighbour.tolist()))
        self.assertEqual(pairs, sorted(set(pairs)))
        self.assertTrue(all(owner < neighbour for owner, neighbour in pairs))
        self.assertGreater(mesh.cell_volumes().min(), 0.0)
        # Each patch begins where the one before it ends; nothing is left over.
        ends = [num_inner] + [end for _, _, end, _ in mesh.patches.values()]
        self.assertEqual([begin for _, begin, _, _ in mesh.patches.values()], ends[:-1])
        self.assertEqual(ends[-1], len(mesh.faces))

    def polygons(self, mesh, faces):
        return [frozenset(map(tuple, mesh.points[face].tolist())) for face in mesh.faces[faces]]

    def assert_openfoam(self, meshes):
        """Cells by zones and outer triangles by patches are those of the mesh."""
        cells, outer = {}, []
        for mesh in meshes:
            self.assert_upper_triangular(mesh)
            corners = [set() for _ in range(mesh.num_cells())]
            for side in (mesh.owner, mesh.neighbour):
                for cell, face in zip(side, mesh.faces):
                    corners[cell].update(map(tuple, mesh.points[face].tolist()))
            for name, rows in mesh.zones.items():
                cells.update({frozenset(corners[row]): name for row in rows})
            for name, (_, begin, end, _) in mesh.outer_patches().items():
                outer += [(face, name) for face in self.polygons(mesh, slice(begin, end))]
        self.assertEqual(cells, self.tets)
        self.assertEqual(sum(mesh.num_cells() for mesh in meshes), len(self.tets))
        sides = collections.Counter(
            frozenset(corners[i] for i in side) for corners in map(tuple, self.tets) for side in SIDES
        )
        expected = {face: name for face, name in self.triangles.items() if sides[face] == 1}
        self.assertLess(len(expected), len(self.triangles))  # There are inner ones, which are no patch.
        self.assertEqual((len(outer), dict(outer)), (len(expected), expected))

    def test_openfoam(self):
        parts = [PolyMesh(self.source / f"processor{p}") for p in range(PARTS)]
        self.assert_openfoam(parts)
        num_faces = 0
        for part in parts:
            self.assertEqual(list(part.outer_patches()), list(parts[0].outer_patches()))
            for kind, begin, end, pair in part.patches.values():
                if kind == "processor":
                    other = parts[pair[1]]
                    _, first, last, _ = other.patches[f"procBoundary{pair[1]}to{pair[0]}"]
                    there = other.points[other.faces[first:last]][:, [0, 2, 1]]
                    numpy.testing.assert_array_equal(part.points[part.faces[begin:end]], there)
                    num_faces += end - begin
        self.assertGreater(num_faces, 0)

    def test_openfoam_serial(self):
        mesh = PolyMesh(self.source)
        self.assert_openfoam([mesh])
        self.assertEqual(len({tuple(point) for point in mesh.points.tolist()}), len(mesh.points))

    def test_openfoam_addressing(self):
        """What a processor has is, by its addressing, what stands in the serial mesh."""
        whole, num_turned = PolyMesh(self.source), 0
        for number in range(PARTS):
            folder = self.source / f"processor{number}"
            part = PolyMesh(folder)
            cells, faces, points, patches = (
                read_list(body_of(folder / f"constant/polyMesh/{kind}ProcAddressing"), "<i4")[0]
                for kind in ("cell", "face", "point", "boundary")
            )
            numpy.testing.assert_array_equal(whole.points[points], part.points)
            self.assertEqual((len(cells), len(faces)), (part.num_cells(), len(part.faces)))
            rows, is_turned = numpy.abs(faces) - 1, faces < 0
            there = whole.faces[rows]
            there[is_turned] = there[is_turned][:, [0, 2, 1]]
            numpy.testing.assert_array_equal(points[part.faces], there)
            owners = whole.owner[rows]
            owners[is_turned] = whole.neighbour[rows[is_turned]]
            numpy.testing.assert_array_equal(cells[part.owner], owners)
            num_outer = len(whole.patches)
            self.assertEqual(patches.tolist(), [*range(num_outer), *[-1] * (len(part.patches) - num_outer)])
            num_turned += int(is_turned.sum())
        self.assertGreater(num_turned, 0)

    def test_faces_without_a_patch(self):
        """Those of a part whose triangles are missing; OpenFOAM wants every face in a patch."""
        mesh = shutil.copytree(self.source, self.folder / "mesh")
        index = (mesh / "boundary.pvtu").read_text().splitlines(keepends=True)
        pieces = [line for line in index if "<Piece" in line]
        self.assertEqual(len(pieces), PARTS)
        (mesh / "boundary.pvtu").write_text("".join(line for line in index if line != pieces[0]))
        formats = ("--format", "openfoam", "--format", "openfoam-serial")
        outcome = self.run_program("convert", mesh / "mesh.pvtu", *formats, "--output", "out", ranks=2)
        self.assertEqual(outcome.code, OK, outcome.err)
        whole, numbers = PolyMesh(self.folder / "out"), []
        self.assert_upper_triangular(whole)
        for number in range(PARTS):
            part = PolyMesh(self.folder / f"out/processor{number}")
            self.assert_upper_triangular(part)
            self.assertEqual(list(part.outer_patches()), list(whole.patches))
            numbers.append({name: end - begin for name, (_, begin, end, _) in part.outer_patches().items()})
        self.assertEqual([bool(number["defaultFaces"]) for number in numbers], [True] + [False] * (PARTS - 1))
        for name, (_, begin, end, _) in whole.patches.items():
            self.assertEqual(end - begin, sum(number[name] for number in numbers))

    def test_any_number_of_ranks(self):
        """The same bits, also as `mesh` writes them itself."""
        folders = []
        for ranks in (1, 2, 3):
            folders.append(self.folder / f"ranks_{ranks}")
            self.assertEqual(self.convert(folders[-1].name, ranks=ranks).code, OK)
        first = hashes(folders[0])
        self.assertEqual(len(first), 1 + 2 * PARTS + 1 + 5 * PARTS + 4 + 10 * PARTS + 6)
        for folder in folders[1:]:
            self.assertEqual(hashes(folder), first)
        by_mesh = hashes(self.source)
        del first[".tessera.lock"]
        self.assertEqual({name: by_mesh.get(name) for name in first}, first)

    def test_full_disk(self):
        """No file is there that is not whole."""
        sound = hashes(self.source)
        self.assertEqual(self.convert("whole").code, OK)
        largest = max(path.stat().st_size for path in (self.folder / "whole").rglob("*") if path.is_file())
        for size in (1000, largest // 3, largest - 1):
            output = self.folder / f"full_{size}"

            def limit(size=size):
                resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

            outcome = self.convert(output.name, preexec_fn=limit, env=without_files_of_mpi(self.folder))
            self.assert_refused(outcome, CANNOT_WRITE, f"cannot write {output.name}/", "File too large")
            found = hashes(output)
            self.assertLessEqual(set(found.items()) - {(".tessera.lock", found[".tessera.lock"])}, set(sound.items()))

    def test_a_file_in_the_way(self):
        """Says which folder cannot be made; --overwrite then goes on."""
        (self.folder / "out").mkdir()
        (self.folder / "out/.tessera.lock").touch()
        blocker = self.folder / "out/processor1"
        blocker.touch()
        outcome = self.convert("out", "--overwrite", ranks=2)
        self.assert_refused(outcome, CANNOT_WRITE, "out/processor1")
        self.assertEqual(list((self.folder / "out").rglob("*.tmp-*")), [])
        blocker.unlink()
        self.assertEqual(self.convert("out", "--overwrite", ranks=2).code, OK)

    def test_openfoam_case_of_more_processors(self):
        """OpenFOAM counts the folders: one too many is refused before anything is written."""
        result = self.folder / "out" / f"processor{PARTS}/100/T"
        result.parent.mkdir(parents=True)
        result.touch()
        (self.folder / "out/.tessera.lock").touch()
        outcome = self.convert("out", "--overwrite")
        self.assert_refused(outcome, CANNOT_WRITE, f"processor{PARTS}")
        self.assertFalse((self.folder / "out/processor0").exists())

    def test_openfoam_keeps_what_users_wrote(self):
        self.assertEqual(self.convert("out").code, OK)
        system = self.folder / "out/system"
        (system / "controlDict").write_text("mine")
        numbers = system / "decomposeParDict"
        ours = numbers.read_text()
        self.assertIn(f"numberOfSubdomains {PARTS};", ours)
        of_another_mesh = ours.replace(str(PARTS), "24")
        for found, expected in ((of_another_mesh, ours), (of_another_mesh + "mine", of_another_mesh + "mine")):
            numbers.write_text(found)
            self.assertEqual(self.convert("out", "--overwrite").code, OK)
            self.assertEqual(numbers.read_text(), expected)
        self.assertEqual((system / "controlDict").read_text(), "mine")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Gmsh's formats, read by a reader of our own: the same mesh as in the pieces, in every form."""
import hashlib
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIntArray, vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

import program
from check_test import KUHN_TETS, write_cube
from msh_file import TET, TRIANGLE, Msh
from repartition_test import INDEX
from vtk_test import read, texts

NUM_SUBDOMAINS = 5
ALL_FORMATS = [word for name in ("msh", "msh2", "msh-parts") for word in ("--format", name)]


def cells_of(grid, tags, names, first_tag):
    """Ids of the corners of a grid's cells, row by row, and the names of their tags."""
    ids = vtk_to_numpy(grid.GetPointData().GetGlobalIds())
    number = grid.GetCell(0).GetNumberOfPoints()
    corners = ids[vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, number)]
    values = vtk_to_numpy(grid.GetCellData().GetArray(tags))
    return corners, np.array(texts(grid, names), dtype=object)[values - first_tag]


class Piece:
    """A piece as its VTU files have it."""

    def __init__(self, file):
        grid, said = read(file)
        assert said == ""
        self.ids = vtk_to_numpy(grid.GetPointData().GetGlobalIds())
        self.xyz = vtk_to_numpy(grid.GetPoints().GetData())
        self.tets, self.materials = cells_of(grid, "attribute", "material_names", 1)
        self.triangles, self.patches = np.empty((0, 3), int), np.array([], dtype=object)
        boundary = file.parents[1] / "boundary" / file.name
        if boundary.exists():
            grid, _ = read(boundary)
            self.triangles, self.patches = cells_of(grid, "patch", "patch_names", 0)


def place_sorted(cells, xyz, names, keep_order):
    """Cells as rows of coordinates with their names, in an order that depends on these alone."""
    corners = xyz[cells]
    if not keep_order:
        order = np.lexsort(np.moveaxis(corners, 2, 0), axis=1)
        corners = np.take_along_axis(corners, order[:, :, None], axis=1)
    rows = corners.reshape(len(cells), -1)
    order = np.lexsort(rows.T)
    return rows[order], names[order]


class MshFiles(program.ResultTest):
    @staticmethod
    def make_result(maker):
        maker.write("two.geo", program.TWO_MATERIALS)
        case = maker.write_case(geometry="two.geo", max_size=1.0, subdomains=NUM_SUBDOMAINS)
        out = maker.mesh(case, "out", ranks=2)
        outcome = maker.run_program(
            "convert", out / "mesh.pvtu", *ALL_FORMATS, "--output", "out/msh", ranks=2
        )
        assert outcome.code == program.OK, outcome.err
        return out

    def setUp(self):
        super().setUp()
        self.pieces = [Piece(file) for file in sorted((self.out / "mesh").glob("*.vtu"))]
        self.assertEqual(len(self.pieces), NUM_SUBDOMAINS)
        self.xyz = np.full((max(piece.ids.max() for piece in self.pieces) + 1, 3), np.nan)
        for piece in self.pieces:
            self.xyz[piece.ids] = piece.xyz
        self.assertFalse(np.isnan(self.xyz).any())

    def msh(self, name):
        return Msh(self.out / "msh" / name)

    def parts(self):
        return [self.msh(f"mesh_{k}.msh") for k in range(1, len(self.pieces) + 1)]

    def assert_cells(self, found, expected, keep_order):
        """Both are (rows of points, positions by point, names)."""
        rows, names = place_sorted(*found, keep_order)
        expected_rows, expected_names = place_sorted(*expected, keep_order)
        self.assertGreater(len(expected_rows), 0)
        np.testing.assert_array_equal(rows, expected_rows)
        self.assertEqual(names.tolist(), expected_names.tolist())

    def assert_whole_mesh(self, msh):
        """One file has the points, tets and triangles of all pieces, bit by bit."""
        self.assertEqual(sorted(msh.nodes), list(range(1, len(self.xyz) + 1)))
        np.testing.assert_array_equal(
            msh.xyz[np.lexsort(msh.xyz.T)], self.xyz[np.lexsort(self.xyz.T)]
        )
        tets, materials = msh.elements(TET)
        triangles, patches = msh.elements(TRIANGLE)
        self.assertEqual(
            sorted(np.concatenate([tets[:, 0], triangles[:, 0]])),
            list(range(1, len(tets) + len(triangles) + 1)),
        )
        for found, names, cells, words, keep in (
            (tets, materials, "tets", "materials", True),
            (triangles, patches, "triangles", "patches", False),
        ):
            expected = np.concatenate([getattr(piece, cells) for piece in self.pieces])
            expected_names = np.concatenate([getattr(piece, words) for piece in self.pieces])
            self.assert_cells(
                (found[:, 1:], msh.node_xyz, names), (expected, self.xyz, expected_names), keep
            )

    def test_version_4_has_the_mesh_with_one_block_a_tag(self):
        msh = self.msh("mesh.msh")
        self.assert_whole_mesh(msh)
        self.assertEqual(
            msh.order, ["MeshFormat", "PhysicalNames", "Entities", "Nodes", "Elements"]
        )
        self.assertEqual(sorted(msh.physicals), sorted(block[:2] for block in msh.blocks))
        for (_, entity), physicals in msh.physicals.items():
            self.assertEqual(physicals, [entity])
        tags = [tag for _, tag in msh.names]
        self.assertEqual(sorted(tags), list(range(1, len(tags) + 1)), "groups of all dimensions")
        self.assertEqual({name for (d, _), name in msh.names.items() if d == 3}, {"core", "shell"})

    def test_version_2_has_the_same_numbers(self):
        old, new = self.msh("mesh_v2.msh"), self.msh("mesh.msh")
        self.assert_whole_mesh(old)
        np.testing.assert_array_equal(old.nodes, new.nodes)
        np.testing.assert_array_equal(old.xyz, new.xyz)
        self.assertEqual(old.names, new.names)
        for kind in (TRIANGLE, TET):
            rows = [msh.elements(kind)[0] for msh in (old, new)]
            np.testing.assert_array_equal(*[r[np.argsort(r[:, 0])] for r in rows])

    def test_triangles_look_out_of_their_tets(self):
        msh = self.msh("mesh.msh")
        triangles, names = msh.elements(TRIANGLE)
        tets, _ = msh.elements(TET)
        faces = {}
        for row in tets[:, 1:]:
            for corner in range(4):
                faces.setdefault(frozenset(np.delete(row, corner)), []).append(row[corner])
        num_outside = 0
        for row in triangles[:, 1:]:
            behind = faces[frozenset(row)]
            if len(behind) == 2:
                continue
            a, b, c, d = msh.node_xyz[[*row, behind[0]]]
            self.assertLess(np.dot(np.cross(b - a, c - a), d - a), 0.0)
            num_outside += 1
        self.assertGreater(num_outside, 0)
        self.assertGreater(len(triangles), num_outside)

    def test_each_part_has_its_piece(self):
        whole = self.msh("mesh.msh")
        for part, piece in zip(self.parts(), self.pieces):
            self.assertEqual(part.names, whole.names)
            for kind, cells, names, keep in (
                (TET, piece.tets, piece.materials, True),
                (TRIANGLE, piece.triangles, piece.patches, False),
            ):
                found, found_names = part.elements(kind)
                if len(cells) == 0:
                    self.assertEqual(len(found), 0)
                    continue
                self.assert_cells(
                    (found[:, 1:], part.node_xyz, found_names), (cells, self.xyz, names), keep
                )
            np.testing.assert_array_equal(part.xyz, whole.node_xyz[part.nodes])

    def test_tags_of_all_parts_are_those_of_the_whole_file_each_once(self):
        whole = self.msh("mesh.msh")
        for kind in (TET, TRIANGLE):
            rows = np.concatenate([part.elements(kind)[0] for part in self.parts()])
            expected = whole.elements(kind)[0]
            np.testing.assert_array_equal(
                rows[np.argsort(rows[:, 0])], expected[np.argsort(expected[:, 0])]
            )

    def test_entities_of_parts_have_parents_and_one_part_each(self):
        seen = set()
        for number, part in enumerate(self.parts(), 1):
            self.assertEqual(part.num_parts, len(self.pieces))
            self.assertEqual(list(part.ghost_parts.values()), [number])
            self.assertGreater(len(part.parents), 0)
            for key, (dimension, parent) in part.parents.items():
                self.assertEqual(dimension, key[0])
                self.assertNotIn((dimension, parent), part.parents)
                self.assertEqual(part.physicals[dimension, parent], part.physicals[key])
                self.assertEqual(part.parts[key], [number])
            keys = {*part.parents, *((3, tag) for tag in part.ghost_parts)}
            self.assertTrue(seen.isdisjoint(keys))
            seen |= keys

    def test_ghosts_are_the_tets_of_others_that_touch_the_piece(self):
        parts = self.parts()
        owners = [{row[0]: tuple(row[1:]) for row in part.elements(TET)[0]} for part in parts]
        for number, (part, piece) in enumerate(zip(parts, self.pieces), 1):
            ghosts = part.ghost_rows()
            self.assertGreater(len(ghosts), 0)
            np.testing.assert_array_equal(part.ghosts[:, 0], ghosts[:, 0])
            self.assertEqual(set(part.ghosts[:, 2]), {number})
            for (element, *nodes), (_, owner, _) in zip(ghosts.tolist(), part.ghosts):
                self.assertNotEqual(owner, number)
                self.assertEqual(owners[owner - 1][element], tuple(nodes))
            expected = np.concatenate(
                [
                    other.tets[np.isin(other.tets, piece.ids).any(axis=1)]
                    for other in self.pieces
                    if other is not piece
                ]
            )
            no_names = np.full(len(expected), "", dtype=object)
            self.assert_cells(
                (ghosts[:, 1:], part.node_xyz, no_names), (expected, self.xyz, no_names), True
            )
            used = np.concatenate([part.elements(TET, with_ghosts=True)[0][:, 1:].ravel()])
            self.assertEqual(sorted(part.nodes), sorted(set(used)), "no node without a tet")

    def test_any_number_of_ranks_writes_the_same_bits(self):
        hashes = {}
        for ranks in (1, 2, 3, 7):  # The last is more than there are pieces.
            outcome = self.run_program(
                "convert", self.out / "mesh.pvtu", *ALL_FORMATS, "--output", f"n{ranks}",
                ranks=ranks,
            )  # fmt: skip
            self.assertEqual(outcome.code, program.OK, outcome.err)
            files = sorted((self.folder / f"n{ranks}").glob("*.msh"))
            self.assertEqual(len(files), 2 + len(self.pieces))
            hashes[ranks] = [(f.name, hashlib.sha256(f.read_bytes()).hexdigest()) for f in files]
        self.assertEqual(hashes[1], hashes[2])
        self.assertEqual(hashes[1], hashes[3])
        self.assertEqual(hashes[1], hashes[7])

    def test_a_smaller_mesh_leaves_no_parts_of_a_larger_one(self):
        convert = ["convert", self.out / "mesh.pvtu", "--format", "msh-parts", "--output"]
        folder = self.out / "msh"
        extra = folder / f"mesh_{len(self.pieces) + 1}.msh"
        extra.write_text("of a larger mesh")
        outcome = self.run_program(*convert, folder, "--overwrite")
        self.assertEqual(outcome.code, program.OK, outcome.err)
        self.assertFalse(extra.exists())


class ForeignMeshes(program.ProgramTest):
    def test_names_can_be_read_whatever_they_are(self):
        write_cube(self.folder / "plain.vtu", KUHN_TETS)
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(self.folder / "plain.vtu"))
        reader.Update()
        grid = reader.GetOutput()
        material = vtkIntArray()
        material.SetName("attribute")
        names = vtkStringArray()
        names.SetName("material_names")
        for tag, name in enumerate(('a "b"', "a _b_", "back\\slash", "ü" * 100, "", "x"), 1):
            names.InsertNextValue(name)
            material.InsertNextValue(tag)
        grid.GetCellData().AddArray(material)
        grid.GetFieldData().AddArray(names)
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(self.folder / "named.vtu"))
        writer.SetInputData(grid)
        self.assertEqual(writer.Write(), 1)
        outcome = self.run_program("convert", "named.vtu", *ALL_FORMATS, "--output", "out")
        self.assertEqual(outcome.code, program.OK, outcome.err)
        for file in ("mesh.msh", "mesh_v2.msh", "mesh_1.msh"):
            msh = Msh(self.folder / "out" / file)
            self.assertEqual(
                [msh.names[3, tag] for tag in range(1, 7)],
                ["a _b_", "a _b__2", "back_slash", "ü" * 63, "material_5", "x"],
            )
            self.assertEqual(msh.names[2, 7], "patch_1")
            self.assertEqual(len(msh.elements(TET)[0]), 6)
            self.assertEqual(len(msh.elements(TRIANGLE)[0]), 12)
            self.assertEqual(len(msh.ghosts), 0)

    def test_an_empty_piece_has_an_empty_part(self):
        write_cube(self.folder / "full.vtu", KUHN_TETS)
        writer = vtkXMLUnstructuredGridWriter()
        points = vtkPoints()
        points.SetDataTypeToDouble()
        grid = vtkUnstructuredGrid()
        grid.SetPoints(points)
        writer.SetInputData(grid)
        writer.SetFileName(str(self.folder / "empty.vtu"))
        self.assertEqual(writer.Write(), 1)
        self.write("two.pvtu", INDEX.format("".join(f'<Piece Source="{n}.vtu"/>' for n in ("full", "empty"))))
        outcome = self.run_program("convert", "two.pvtu", *ALL_FORMATS, "--output", "out", ranks=2)
        self.assertEqual(outcome.code, program.OK, outcome.err)
        content = (self.folder / "out" / "mesh_2.msh").read_bytes()
        self.assertEqual(content.count(b"$End"), 6)
        parts = [Msh(self.folder / "out" / f"mesh_{number}.msh") for number in (1, 2)]
        self.assertEqual([len(part.elements(TET)[0]) for part in parts], [6, 0])
        self.assertEqual([len(part.nodes) for part in parts], [8, 0])
        self.assertEqual([part.num_parts for part in parts], [2, 2])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""`tessera repartition`: the same tets in balanced, connected pieces, whoever made the mesh."""
import json
import unittest

from vtkmodules.vtkCommonCore import vtkIdTypeArray, vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import program
from check_test import KUHN_TETS, check
from vtk_test import corners_of_cells, read, values

INDEX = """<?xml version="1.0"?>
<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt32">
  <PUnstructuredGrid GhostLevel="0">
    <PPoints><PDataArray type="Float64" Name="Points" NumberOfComponents="3"/></PPoints>
    {}
  </PUnstructuredGrid>
</VTKFile>
"""


def write_cubes(folder, num_cubes, ids=None):
    """A row of unit cubes of six tets, one piece each, as another tool might write it: no boundary file.
    `ids` "local": each piece numbers its points from 0 and calls that global ids."""
    for cube in range(num_cubes):
        points = vtkPoints()
        points.SetDataTypeToDouble()
        for x, y, z in program.CUBE_CORNERS:
            points.InsertNextPoint(x + cube, y, z)
        grid = vtkUnstructuredGrid()
        grid.SetPoints(points)
        for tet in KUHN_TETS:
            grid.InsertNextCell(VTK_TETRA, 4, tet)
        if ids == "local":
            array = vtkIdTypeArray()
            array.SetName("ids")
            for point in range(8):
                array.InsertNextValue(point)
            grid.GetPointData().SetGlobalIds(array)
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetFileName(str(folder / f"cube_{cube}.vtu"))
        writer.SetInputData(grid)
        assert writer.Write() == 1
    index = folder / "cubes.pvtu"
    index.write_text(INDEX.format("".join(f'<Piece Source="cube_{c}.vtu"/>' for c in range(num_cubes))))
    return index


class Repartition(program.ResultTest):
    @staticmethod
    def make_result(maker):
        maker.write("two.geo", program.TWO_MATERIALS)
        case = maker.write_case(geometry="two.geo", max_size=1.0, subdomains=5)
        return maker.mesh(case, "out")

    def repartition(self, output, parts, *options, ranks=2, mesh=None, code=program.OK):
        """Runs it; the new folder and its report."""
        mesh = mesh or self.out / "mesh.pvtu"
        outcome = self.run_program(
            "repartition", mesh, "--parts", parts, "--output", output, *options, ranks=ranks
        )
        self.assertEqual(outcome.code, code, outcome.err)
        folder = self.folder / output
        return folder, json.loads((folder / "report.json").read_text())

    def test_same_mesh_in_other_pieces(self):
        _, before = check(self, self.out / "mesh.pvtu")
        for ranks, parts in ((None, 3), (2, 7), (3, 2), (4, 4)):
            with self.subTest(ranks=ranks, parts=parts):
                folder, report = self.repartition(f"new{parts}", parts, ranks=ranks)
                code, after = check(self, folder / "mesh.pvtu", ranks=2)
                self.assertEqual(code, program.OK, after)
                for key in ("digest", "num_tets", "num_vertices", "has_global_ids", "num_boundary_triangles"):
                    self.assertEqual(after.get(key), before.get(key), key)
                self.assertAlmostEqual(after["volume"] / before["volume"], 1.0, delta=1e-12)
                self.assertEqual(after["num_subdomains"], parts)
                self.assertEqual(report["num_tets"], before["num_tets"])
                self.assert_good_parts(report, parts)

    def assert_good_parts(self, report, parts):
        sizes = [part["tets"] for part in report["parts"]]
        self.assertEqual((len(sizes), sum(sizes)), (parts, report["num_tets"]))
        average = sum(sizes) / parts
        self.assertLessEqual(max(sizes), max(1.03 * average, average + 1.0))
        self.assertEqual([part["components"] for part in report["parts"]], [1] * parts)
        self.assertEqual((report["status"], report["disconnected_parts"]), ("ok", 0))

    def test_repeats_bit_for_bit(self):
        first, _ = self.repartition("first", 6, ranks=3)
        second, _ = self.repartition("second", 6, ranks=3)
        self.assertEqual(program.mesh_files(first), program.mesh_files(second))

    def test_vtk_reads_what_is_documented(self):
        folder, report = self.repartition("new", 3)
        grid, said = read(folder / "mesh.pvtu")
        self.assertEqual(said, "")
        ids = values(grid.GetCellData().GetGlobalIds())
        self.assertEqual(sorted(ids), list(range(report["num_tets"])))
        part = values(grid.GetCellData().GetArray("subdomain"))
        self.assertEqual([part.count(p) for p in range(3)], [p["tets"] for p in report["parts"]])
        lowest = {}
        for c, corners in enumerate(corners_of_cells(grid)):
            for point in corners:
                lowest[point] = min(lowest.get(point, 3), part[c])
        points = values(grid.GetPointData().GetGlobalIds())
        owner = values(grid.GetPointData().GetArray("owner"))
        self.assertEqual(dict(zip(points, owner)), lowest)
        boundary, said = read(folder / "boundary.pvtu")
        self.assertEqual(said, "")
        part_of_tet = dict(zip(ids, part))
        tets = values(boundary.GetCellData().GetArray("tet"))
        self.assertEqual([part_of_tet[t] for t in tets], values(boundary.GetCellData().GetArray("subdomain")))
        for name in ("patch_names", "material_names", "length_unit"):
            old = read(self.out / "mesh.pvtu")[0].GetFieldData().GetAbstractArray(name)
            new = grid.GetFieldData().GetAbstractArray(name)
            self.assertEqual(values(new), values(old), name)

    def test_mesh_of_another_tool(self):
        for ids in (None, "local"):
            with self.subTest(ids=ids):
                folder = self.folder / f"foreign_{ids}"
                folder.mkdir()
                new, report = self.repartition(f"new_{ids}", 4, ranks=3, mesh=write_cubes(folder, 5, ids))
                self.assertEqual((report["num_tets"], report["num_vertices"]), (30, 24))
                self.assertEqual(len(report["notes"]), 1)
                code, findings = check(self, new / "mesh.pvtu")
                self.assertEqual(code, program.OK, findings)
                self.assertTrue(findings["matched_by_ids"])
                self.assertEqual(findings["num_boundary_triangles"], 5 * 8 + 4)
                self.assertAlmostEqual(findings["volume"], 5.0, delta=1e-12)

    def test_as_many_parts_as_tets(self):
        folder = self.folder / "foreign"
        folder.mkdir()
        new, report = self.repartition("new", 6, ranks=4, mesh=write_cubes(folder, 1))
        self.assertEqual([part["tets"] for part in report["parts"]], [1] * 6)
        self.assertEqual(check(self, new / "mesh.pvtu")[0], program.OK)

    def test_ghost_layers(self):
        _, before = check(self, self.out / "mesh.pvtu")
        for layers in (1, 2):
            with self.subTest(layers=layers):
                folder, _ = self.repartition(f"new{layers}", 3, "--ghost-layers", layers, ranks=2)
                code, after = check(self, folder / "mesh.pvtu")
                self.assertEqual((code, after["digest"]), (program.OK, before["digest"]))
                grid, said = read(folder / "mesh.pvtu")
                self.assertEqual(said, "")
                self.assert_ghosts(grid, layers)

    def assert_ghosts(self, whole, layers):
        """Each piece has the tets within `layers` of its own, worked out from the whole mesh."""
        corners, part_of = {}, {}
        is_ghost = values(whole.GetCellData().GetArray("vtkGhostType"))
        ids = values(whole.GetCellData().GetGlobalIds())
        part = values(whole.GetCellData().GetArray("subdomain"))
        owner_of = {}
        for c, points in enumerate(corners_of_cells(whole)):
            if not is_ghost[c]:
                self.assertNotIn(ids[c], corners)
                corners[ids[c]], part_of[ids[c]] = frozenset(points), part[c]
                for point in points:
                    owner_of[point] = min(owner_of.get(point, part[c]), part[c])
        self.assertEqual(sorted(corners), list(range(self.report["num_tets"])))
        for p in range(3):
            grid, _ = read(self.folder / f"new{layers}" / "mesh" / f"piece_{p:06}.vtu")
            own = {tet for tet in corners if part_of[tet] == p}
            expected = set(own)
            for _ in range(layers):
                near = frozenset().union(*(corners[tet] for tet in expected))
                expected = {tet for tet in corners if corners[tet] & near}
            cells = values(grid.GetCellData().GetGlobalIds())
            ghost = values(grid.GetCellData().GetArray("vtkGhostType"))
            self.assertEqual(len(cells), len(set(cells)))
            self.assertEqual(set(cells), expected)
            self.assertEqual([g == 0 for g in ghost], [tet in own for tet in cells])
            self.assertEqual(values(grid.GetCellData().GetArray("subdomain")), [part_of[tet] for tet in cells])
            self.assertEqual([frozenset(c) for c in corners_of_cells(grid)], [corners[tet] for tet in cells])
            points = values(grid.GetPointData().GetGlobalIds())
            self.assertEqual(len(points), len(set(points)))
            self.assertEqual(values(grid.GetPointData().GetArray("owner")), [owner_of[v] for v in points])
            self.assertEqual(
                values(grid.GetPointData().GetArray("vtkGhostType")),
                [int(owner_of[v] != p) for v in points],
            )

    def refuse(self, code, *words, parts=2, mesh=None, output="new", ranks=2):
        outcome = self.run_program(
            "repartition", mesh or self.out / "mesh.pvtu", "--parts", parts, "--output", output, ranks=ranks
        )
        self.assert_refused(outcome, code, *words)

    def test_wrong_wishes(self):
        for parts in (0, -1, "many", 1.5):
            self.refuse(program.WRONG_INPUT, "--parts", parts, parts=parts)
        num_tets = self.report["num_tets"]
        self.refuse(program.WRONG_INPUT, num_tets + 1, f"only {num_tets} tets", parts=num_tets + 1)

    def test_bad_input(self):
        self.refuse(program.WRONG_INPUT, "nowhere.pvtu", mesh="nowhere.pvtu")
        (self.out / "mesh" / "piece_000001.vtu").unlink()
        self.refuse(program.WRONG_INPUT, "piece_000001.vtu", output="other")
        report = json.loads((self.folder / "other" / "report.json").read_text())
        self.assertEqual((report["status"], report["exit_code"]), ("failed", program.WRONG_INPUT))

    def test_incomplete_mesh(self):
        (self.out / "mesh.pvtu").write_text(
            "".join(
                line
                for line in (self.out / "mesh.pvtu").read_text().splitlines(keepends=True)
                if "piece_000001" not in line
            )
        )
        self.refuse(program.WRONG_INPUT, "does not conform")

    def test_the_mesh_itself_is_never_overwritten(self):
        before = program.mesh_files(self.out)
        outcome = self.run_program(
            "repartition", self.out / "mesh.pvtu", "--parts", 2, "--output", self.out, "--overwrite"
        )
        self.assert_refused(outcome, program.WRONG_INPUT, "output folder")
        self.assertEqual(program.mesh_files(self.out), before)

    def test_used_output_folder(self):
        self.repartition("new", 2)
        self.refuse(program.CANNOT_WRITE, "not empty", "new")
        self.repartition("new", 3, "--overwrite")
        pieces = sorted(f.name for f in (self.folder / "new" / "mesh").iterdir())
        self.assertEqual(pieces, [f"piece_{p:06}.vtu" for p in range(3)])


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""`tessera check` trusts nothing: it passes what is right and notices a single flipped bit."""
import json
import re
import struct
import unittest

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE, vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

import program

# Kuhn's six tets of a cube; rows of program.CUBE_CORNERS.
KUHN_TETS = [(0, 1, 3, 7), (0, 5, 1, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 6, 4, 7)]


def data_begin(content, name):
    """Where the values of an array begin in a file with raw appended data, and their number of bytes."""
    tag = re.search(rb'<DataArray[^>]*Name="' + name.encode() + rb'"[^>]*offset="(\d+)"', content)
    size_at = content.index(b"_", content.index(b"<AppendedData")) + 1 + int(tag[1])
    return size_at + 8, struct.unpack_from("<Q", content, size_at)[0]


def point_ids(piece):
    content = piece.read_bytes()
    begin, size = data_begin(content, "GlobalPointIds")
    return struct.unpack(f"<{size // 8}q", content[begin : begin + size])


def flip_bit(file, name, byte, bit=0):
    """Flips a bit of one byte of an array, counted from the array's begin."""
    content = bytearray(file.read_bytes())
    begin, size = data_begin(bytes(content), name)
    assert byte < size
    content[begin + byte] ^= 1 << bit
    file.write_bytes(content)


def write_cube(file, cells, cell_type=VTK_TETRA):
    """What another tool might write: ASCII, no ids, no materials."""
    points = vtkPoints()
    for corner in program.CUBE_CORNERS:
        points.InsertNextPoint(corner)
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points)
    for cell in cells:
        grid.InsertNextCell(cell_type, len(cell), cell)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(grid)
    writer.SetDataModeToAscii()
    assert writer.Write() == 1


def check(test, file, *options, ranks=None):
    """Exit code and findings."""
    outcome = test.run_program("check", file, "--json", *options, ranks=ranks)
    test.assertIn(outcome.code, (program.OK, program.FAILED), outcome.err)
    findings = json.loads(outcome.out)
    test.assertEqual(findings["conforms"], outcome.code == program.OK)
    test.assertEqual(findings["conforms"], findings["offenders"] == [])
    return outcome.code, findings


class CheckOfResults(program.ResultTest):
    """Of an uncompressed result, so that its bytes can be found and changed."""

    @staticmethod
    def make_result(maker):
        case = maker.write_case(subdomains=3)
        return maker.mesh(case, "out", "--set", "output.compression='none'")

    def setUp(self):
        super().setUp()
        self.piece = self.out / "mesh" / "piece_000001.vtu"

    def check_result(self, ranks=None):
        return check(self, self.out / "mesh.pvtu", ranks=ranks)

    def assert_noticed(self, kind=None):
        """Reported, or at least another digest: with `kind`, reported as that."""
        code, findings = self.check_result()
        if kind is not None:
            self.assertEqual(code, program.FAILED)
            self.assertIn(kind, [offender["kind"] for offender in findings["offenders"]])
        self.assertNotEqual((code, findings["digest"]), (program.OK, self.report["digest"]))

    def test_result_conforms_and_has_the_figures_of_the_report(self):
        code, findings = self.check_result()
        self.assertEqual(code, program.OK)
        for key in ("digest", "num_tets", "num_vertices", "num_subdomains"):
            self.assertEqual(findings[key], self.report[key], key)
        for key in ("volume", "boundary_area"):
            self.assertAlmostEqual(findings[key] / self.report[key], 1.0, delta=1e-12, msg=key)
        for key in ("min_dihedral_deg", "max_dihedral_deg"):
            self.assertAlmostEqual(findings["quality"][key], self.report["quality"][key], delta=1e-9)
        self.assertEqual(
            findings["quality"]["seam"]["num_tets"], self.report["quality"]["seam"]["num_tets"]
        )
        self.assertEqual(findings["euler_characteristic"], 1)

    def test_same_findings_for_any_number_of_ranks(self):
        self.assertEqual(self.check_result(ranks=3), self.check_result())

    def test_findings_for_people(self):
        outcome = self.run_program("check", self.out / "mesh.pvtu")
        self.assertEqual(outcome.code, program.OK)
        self.assertIn("the mesh conforms", outcome.out)
        self.assertIn(f"digest {self.report['digest']}", outcome.out)

    def test_lowest_bit_of_a_coordinate(self):
        ids = point_ids(self.piece)
        others = {i for other in self.piece.parent.iterdir() if other != self.piece for i in point_ids(other)}
        shared = next(point for point, i in enumerate(ids) if i in others)
        for point, kind in ((shared, "point_position"), (len(ids) - 1, None)):  # On a seam; inside.
            with self.subTest(point=point):
                before = self.piece.read_bytes()
                flip_bit(self.piece, "Points", 24 * point)
                self.assert_noticed(kind)
                self.piece.write_bytes(before)

    def test_bit_of_a_point_id(self):
        flip_bit(self.piece, "GlobalPointIds", 0)
        self.assert_noticed()

    def test_bit_of_a_cell_id(self):
        flip_bit(self.piece, "GlobalCellIds", 0)
        code, _ = self.check_result()
        self.assertEqual(code, program.FAILED)

    def test_bit_of_a_material(self):
        flip_bit(self.piece, "attribute", 0, bit=1)
        self.assert_noticed()

    def test_bit_of_a_corner(self):
        flip_bit(self.piece, "connectivity", 0)
        self.assert_noticed()
        self.assertEqual(self.check_result()[0], program.FAILED)

    def test_offender_is_named_on_every_number_of_ranks(self):
        flip_bit(self.piece, "Points", 6, bit=2)
        for ranks in (1, 3):
            with self.subTest(ranks=ranks):
                outcome = self.run_program("check", self.out / "mesh.pvtu", ranks=ranks)
                self.assertEqual(outcome.code, program.FAILED)
                self.assertIn("the mesh does NOT conform", outcome.out)
                self.assertIn("piece 1", outcome.out)

    def test_bit_of_a_boundary_triangle(self):
        boundary = sorted(self.out.glob("boundary/piece_*.vtu"))[0]
        for array in ("Points", "GlobalPointIds", "connectivity", "tet", "patch"):
            with self.subTest(array=array):
                before = boundary.read_bytes()
                flip_bit(boundary, array, 0)
                code, _ = self.check_result()
                self.assertEqual(code, program.OK if array == "patch" else program.FAILED)
                boundary.write_bytes(before)

    def leave_out_piece(self, number):
        """As in a run that makes only some subdomains: neither file names the piece."""
        for index in ("mesh.pvtu", "boundary.pvtu"):
            lines = (self.out / index).read_text().splitlines(keepends=True)
            kept = [line for line in lines if f"piece_{number:06}.vtu" not in line]
            self.assertEqual(len(kept), len(lines) - 1)
            (self.out / index).write_text("".join(kept))

    def test_part_of_a_mesh_is_accepted_if_asked_for(self):
        self.leave_out_piece(1)
        code, refused = self.check_result()
        self.assertEqual((code, refused["partial"]), (program.FAILED, False))
        self.assertIn("--partial", refused["notes"][-1])

        code, findings = check(self, self.out / "mesh.pvtu", "--partial", ranks=2)
        self.assertEqual((code, findings["partial"]), (program.OK, True))
        self.assertEqual(
            findings["num_open_seam_triangles"], refused["num_open_seam_triangles"]
        )
        self.assertGreater(findings["num_open_seam_triangles"], 0)
        self.assertEqual([piece["id"] for piece in findings["subdomains"]], [0, 2])

        outcome = self.run_program("check", self.out / "mesh.pvtu", "--partial")
        self.assertEqual(outcome.code, program.OK)
        self.assertIn(f"{findings['num_open_seam_triangles']} open seam triangles", outcome.out)
        self.assertIn("the part of the mesh conforms", outcome.out)

    def test_defect_of_a_part_of_a_mesh_is_noticed(self):
        self.leave_out_piece(0)
        flip_bit(self.piece, "Points", 6, bit=2)
        code, _ = check(self, self.out / "mesh.pvtu", "--partial")
        self.assertEqual(code, program.FAILED)

    def test_missing_piece_is_an_input_error(self):
        self.piece.unlink()
        outcome = self.run_program("check", self.out / "mesh.pvtu", ranks=3)
        self.assert_refused(outcome, program.WRONG_INPUT, self.piece.name)


class CheckOfForeignMesh(program.ProgramTest):
    def test_good_mesh_without_ids(self):
        write_cube(self.folder / "cube.vtu", KUHN_TETS)
        code, findings = check(self, "cube.vtu", ranks=2)
        self.assertEqual((code, findings["num_tets"]), (program.OK, 6))
        self.assertEqual((findings["has_global_ids"], findings["digest"]), (False, None))
        self.assertAlmostEqual(findings["volume"], 1.0)
        self.assertAlmostEqual(findings["boundary_area"], 6.0)

    def test_flipped_tet(self):
        a, b, c, d = KUHN_TETS[2]
        write_cube(self.folder / "cube.vtu", [*KUHN_TETS[:2], (b, a, c, d), *KUHN_TETS[3:]])
        self.assertEqual(check(self, "cube.vtu")[0], program.FAILED)

    def test_tet_twice(self):
        write_cube(self.folder / "cube.vtu", [*KUHN_TETS, KUHN_TETS[0]])
        self.assertEqual(check(self, "cube.vtu")[0], program.FAILED)

    def test_triangles_are_no_mesh(self):
        write_cube(self.folder / "cube.vtu", [(0, 2, 1), (1, 2, 3)], VTK_TRIANGLE)
        code, findings = check(self, "cube.vtu")
        self.assertEqual(code, program.FAILED)
        self.assertIn("no_tets", [offender["kind"] for offender in findings["offenders"]])


if __name__ == "__main__":
    unittest.main()

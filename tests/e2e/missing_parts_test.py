# SPDX-License-Identifier: BSD-3-Clause
"""Builds without NETGEN, PT-Scotch or VTK: what is missing is refused clearly, all else works."""
import os
import unittest

import program

HAS_NETGEN = os.environ["TESSERA_WITH_NETGEN"] == "ON"
HAS_PTSCOTCH = os.environ["TESSERA_WITH_PTSCOTCH"] == "ON"
HAS_VTK = os.environ["TESSERA_WITH_VTK"] == "ON"
KUHN_TETS = [(0, 1, 3, 7), (0, 5, 1, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 4, 5, 7), (0, 6, 4, 7)]


TETRAHEDRON_STL = (
    "solid tet\n"
    + "".join(
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*[(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)][v]) for v in facet)
        + "endloop\nendfacet\n"
        for facet in ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))
    )
    + "endsolid tet\n"
)


def array(name, kind, values, components=1):
    return (
        f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="ascii">'
        + " ".join(map(str, values))
        + "</DataArray>\n"
    )


def cube_vtu():
    """A cube of six tets as another tool might write it, as text."""
    points = array("Points", "Float64", [x for corner in program.CUBE_CORNERS for x in corner], components=3)
    cells = (
        array("connectivity", "Int64", [corner for tet in KUHN_TETS for corner in tet])
        + array("offsets", "Int64", range(4, 25, 4))
        + array("types", "UInt8", [10] * 6)
    )
    return (
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian">\n'
        '<UnstructuredGrid><Piece NumberOfPoints="8" NumberOfCells="6">\n'
        f"<Points>{points}</Points>\n<Cells>{cells}</Cells>\n"
        "</Piece></UnstructuredGrid></VTKFile>\n"
    )


class MissingParts(program.ProgramTest):
    def test_a_mesh_is_described_cut_and_checked(self):
        self.write("cube.vtu", cube_vtu())
        info = self.run_program("info", "cube.vtu")
        self.assertEqual(info.code, program.OK, info.err)
        self.assertIn("6 cells", info.out)
        parts = 2 if HAS_PTSCOTCH else 1
        cut = self.run_program("repartition", "cube.vtu", "--parts", parts, "--output", "out", ranks=2)
        self.assertEqual(cut.code, program.OK, cut.err)
        for ranks in (None, 2):
            check = self.run_program("check", "out/mesh.pvtu", ranks=ranks)
            self.assertEqual(check.code, program.OK, check.out + check.err)

    @unittest.skipIf(HAS_PTSCOTCH, "this build has PT-Scotch")
    def test_without_ptscotch_parts_are_refused_before_anything_is_made(self):
        self.write("cube.vtu", cube_vtu())
        for ranks in (None, 2):
            outcome = self.run_program("repartition", "cube.vtu", "--parts", 2, "--output", "out", ranks=ranks)
            self.assert_refused(outcome, program.WRONG_INPUT, "TESSERA_WITH_PTSCOTCH=OFF")
            self.assertFalse((self.folder / "out").exists())

    @unittest.skipIf(HAS_NETGEN, "this build has NETGEN")
    def test_without_netgen_a_model_is_refused_before_anything_is_made(self):
        case = self.write_case()
        for ranks in (None, 2):
            outcome = self.run_program("mesh", case, "--output", "out", ranks=ranks)
            self.assert_refused(outcome, program.WRONG_INPUT, "TESSERA_WITH_NETGEN=OFF")
            self.assertFalse((self.folder / "out").exists())
        self.assert_refused(
            self.run_program("info", "ball.geo"), program.WRONG_INPUT, "TESSERA_WITH_NETGEN=OFF"
        )
        self.assertEqual(self.run_program("mesh", case, "--dump-config").code, program.OK)

    @unittest.skipIf(HAS_NETGEN, "this build has NETGEN")
    def test_without_netgen_a_mesh_of_the_user_is_refined(self):
        self.write("cube.vtu", cube_vtu())
        case = self.write(
            "case.toml",
            f"geometry.file = 'cube.vtu'\ndecompose.subdomains = 2\nrefine.levels = 2\n"
            f"output.compression = 'none'\n{program.NO_PAGE}",
        )
        refused = self.run_program("mesh", case, "--output", "out")
        self.assert_refused(refused, program.WRONG_INPUT, 'fill.kernel = "optimize"')
        self.assertFalse((self.folder / "out").exists())
        for kernel in ("optimize", "subdivide"):
            out = self.mesh(case, kernel, "--set", f"fill.kernel={kernel}", ranks=2)
            check = self.run_program("check", out / "mesh.pvtu", ranks=2)
            self.assertEqual(check.code, program.OK, check.out + check.err)

    @unittest.skipIf(HAS_NETGEN, "this build has NETGEN")
    def test_without_netgen_an_stl_file_is_described_and_not_meshed(self):
        self.write("tet.stl", TETRAHEDRON_STL)
        info = self.run_program("info", "tet.stl")
        self.assertEqual(info.code, program.OK, info.err)
        case = self.write("case.toml", "geometry.file = 'tet.stl'\nfill.kernel = 'optimize'\nsize.target = 0.5\noutput.compression = 'none'\n")
        outcome = self.run_program("mesh", case, "--output", "out")
        self.assert_refused(outcome, program.WRONG_INPUT, "TESSERA_WITH_NETGEN=OFF")

    @unittest.skipIf(HAS_VTK or not HAS_NETGEN, "this build has VTK or cannot mesh")
    def test_without_vtk_a_case_must_ask_for_no_compression(self):
        case = self.write_case()
        refused = self.run_program("mesh", case, "--output", "out")
        self.assert_refused(refused, program.WRONG_INPUT, 'output.compression = "none"')
        self.assertFalse((self.folder / "out").exists())
        out = self.mesh(case, "out", "--set", "output.compression=none", ranks=2)
        check = self.run_program("check", out / "mesh.pvtu", ranks=2)
        self.assertEqual(check.code, program.OK, check.out + check.err)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""The output folder: VTK's own readers open it without a word, and it holds what is documented."""
import json
import unittest

from vtkmodules.vtkCommonCore import vtkIdList, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import VTK_TETRA, VTK_TRIANGLE
from vtkmodules.vtkIOXML import vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

import program

# Keys of report.json that scripts rely on; a dictionary: what is inside.
REPORT_KEYS = {
    "schema": int, "version": str, "status": str, "exit_code": int, "reason": str, "reasons": list,
    "case": str,
    "num_ranks": int, "num_subdomains": int, "num_tets": int, "num_vertices": int,
    "volume": float, "boundary_area": float, "model_distance_max": float,
    "points_within_tolerance": {"num": int, "distance_max": float},
    "reproducible": bool, "digest": str,
    "wall_time_s": float, "tets_per_second": float, "peak_rss_bytes_max": int, "stages": list,
    "quality": {
        "min_dihedral_deg": float, "max_dihedral_deg": float, "worst": list,
        "dihedral_deg_histogram": {"smallest_of_tet": list, "largest_of_tet": list},
        "edge_length": {"p01": float, "median": float, "p99": float},
        "mean_ratio": {"min": float, "p01": float, "mean": float, "histogram": list},
        "seam": {
            "num_tets": int, "min_dihedral_deg": float,
            "mean_ratio": {"min": float, "p01": float, "mean": float, "histogram": list},
        },
    },
    "subdomains": list, "patch_names": list, "patches": list, "materials": list,
    "libraries": {"netgen": str, "metis": str, "vtk": str, "mpi": str},
}  # fmt: skip
STAGES = ["model", "coarse", "decompose", "plan", "fill", "improve", "verify", "write", "pictures"]
NUM_SUBDOMAINS = 4


def read(file):
    """The grid of a .vtu or .pvtu and what VTK said while it read it."""
    reader = vtkXMLPUnstructuredGridReader() if file.suffix == ".pvtu" else vtkXMLUnstructuredGridReader()
    # All of VTK, for an index is read by a reader of its own for each piece.
    window = vtkStringOutputWindow()
    vtkOutputWindow.SetInstance(window)
    reader.SetFileName(str(file))
    reader.Update()
    vtkOutputWindow.SetInstance(None)
    return reader.GetOutput(), window.GetOutput()


def values(array):
    return [array.GetValue(i) for i in range(array.GetNumberOfValues())]


def texts(grid, name):
    return values(grid.GetFieldData().GetAbstractArray(name))


def corners_of_cells(grid):
    """Rows of global point ids, one a cell."""
    ids = values(grid.GetPointData().GetGlobalIds())
    cell = vtkIdList()
    for c in range(grid.GetNumberOfCells()):
        grid.GetCellPoints(c, cell)
        yield [ids[cell.GetId(i)] for i in range(cell.GetNumberOfIds())]


class OutputFolder(program.ResultTest):
    """One run of a model with two materials, looked at from all sides."""

    @staticmethod
    def make_result(maker):
        model = program.CONFIGS / "geometry" / "two_blocks.step"
        case = maker.write_case(geometry=model, max_size=8, subdomains=NUM_SUBDOMAINS, page=True)
        return maker.mesh(case, "out", ranks=2)

    def assert_array(self, array, vtk_type, what):
        self.assertIsNotNone(array, what)
        self.assertEqual(array.GetDataTypeAsString(), vtk_type, what)
        self.assertEqual(array.GetNumberOfComponents(), 1, what)

    def assert_dense_ids(self, array, number, what):
        """An id array whose distinct values are 0 … number - 1."""
        self.assertIsNotNone(array, f"{what}: not flagged GLOBAL_IDS")
        self.assertEqual(array.GetDataTypeSize(), 8, what)
        self.assertEqual(sorted(set(values(array))), list(range(number)), what)

    def open_index(self, name, cell_type):
        grid, said = read(self.out / name)
        self.assertEqual(said, "")
        self.assertEqual(
            {grid.GetCellType(c) for c in range(grid.GetNumberOfCells())}, {cell_type}
        )
        return grid

    def test_mesh_index(self):
        grid = self.open_index("mesh.pvtu", VTK_TETRA)
        self.assertEqual(grid.GetNumberOfCells(), self.report["num_tets"])
        self.assert_dense_ids(grid.GetPointData().GetGlobalIds(), self.report["num_vertices"], "points")
        self.assert_dense_ids(grid.GetCellData().GetGlobalIds(), self.report["num_tets"], "cells")
        self.assert_array(grid.GetPointData().GetArray("owner"), "int", "owner")
        for name in ("attribute", "subdomain"):
            self.assert_array(grid.GetCellData().GetArray(name), "int", name)
        self.assertEqual(set(values(grid.GetCellData().GetArray("attribute"))), {1, 2})

    def test_tets_are_positive(self):
        grid, _ = read(self.out / "mesh.pvtu")
        volume = 0.0
        for c in range(grid.GetNumberOfCells()):
            p = [grid.GetCell(c).GetPoints().GetPoint(i) for i in range(4)]
            a, b, d = ([p[i][k] - p[0][k] for k in range(3)] for i in (1, 2, 3))
            cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
            tet = sum(x * y for x, y in zip(cross, d)) / 6.0
            self.assertGreater(tet, 0.0)
            volume += tet
        self.assertAlmostEqual(volume / self.report["volume"], 1.0, delta=1e-12)

    def test_patches_of_the_report_are_those_of_the_file(self):
        grid, _ = read(self.out / "boundary.pvtu")
        names = texts(grid, "patch_names")
        counts, areas = [0] * len(names), [0.0] * len(names)
        for c, row in enumerate(values(grid.GetCellData().GetArray("patch"))):
            counts[row] += 1
            areas[row] += grid.GetCell(c).ComputeArea()
        self.assertGreater(len(names), 6)
        self.assertEqual([patch["name"] for patch in self.report["patches"]], names)
        self.assertEqual([patch["id"] for patch in self.report["patches"]], list(range(len(names))))
        self.assertEqual([patch["triangles"] for patch in self.report["patches"]], counts)
        for patch, area in zip(self.report["patches"], areas):
            self.assertAlmostEqual(patch["area"] / area, 1.0, delta=1e-12)

    def test_owner_is_the_lowest_subdomain_that_holds_the_point(self):
        grid, _ = read(self.out / "mesh.pvtu")
        subdomain = values(grid.GetCellData().GetArray("subdomain"))
        lowest = {}
        for c, corners in enumerate(corners_of_cells(grid)):
            for point in corners:
                lowest[point] = min(lowest.get(point, NUM_SUBDOMAINS), subdomain[c])
        ids = values(grid.GetPointData().GetGlobalIds())
        owner = values(grid.GetPointData().GetArray("owner"))
        self.assertEqual(dict(zip(ids, owner)), lowest)
        self.assertGreater(len(ids), len(lowest), "no point is shared: nothing was tested")

    def test_boundary_triangles_are_faces_of_their_tets(self):
        tets = self.open_index("mesh.pvtu", VTK_TETRA)
        tet_ids = values(tets.GetCellData().GetGlobalIds())
        tet_subdomain = values(tets.GetCellData().GetArray("subdomain"))
        corners = {tet_ids[c]: (set(p), tet_subdomain[c]) for c, p in enumerate(corners_of_cells(tets))}

        boundary = self.open_index("boundary.pvtu", VTK_TRIANGLE)
        data = boundary.GetCellData()
        self.assert_dense_ids(data.GetGlobalIds(), boundary.GetNumberOfCells(), "triangles")
        self.assert_array(data.GetArray("patch"), "int", "patch")
        self.assert_array(data.GetArray("subdomain"), "int", "subdomain")
        tet = values(data.GetArray("tet"))
        subdomain = values(data.GetArray("subdomain"))
        for c, triangle in enumerate(corners_of_cells(boundary)):
            tet_corners, tet_subdomain_of_c = corners[tet[c]]
            self.assertLess(set(triangle), tet_corners)
            self.assertEqual(subdomain[c], tet_subdomain_of_c)
        names = texts(boundary, "patch_names")
        self.assertEqual(set(values(data.GetArray("patch"))), set(range(len(names))))

    def test_field_data(self):
        for name in ("mesh.pvtu", "boundary.pvtu", "mesh/piece_000000.vtu", "boundary/piece_000000.vtu"):
            grid, said = read(self.out / name)
            self.assertEqual(said, "")
            self.assertEqual(len(texts(grid, "material_names")), 2)
            self.assertEqual(texts(grid, "length_unit"), ["mm"])
            self.assertEqual(texts(grid, "tessera_version"), [self.report["version"]])

    def test_a_broken_file_would_be_noticed(self):
        piece = self.out / "mesh" / "piece_000000.vtu"
        piece.write_bytes(piece.read_bytes()[:2000])
        _, said = read(self.out / "mesh.pvtu")
        self.assertIn("Error", said)

    def test_connectivity_has_32_bits(self):
        for piece in sorted(self.out.glob("*/piece_*.vtu")):
            head = piece.read_bytes().split(b"<AppendedData")[0].decode()
            self.assertRegex(head, r'type="Int32"[^>]*Name="connectivity"')
            self.assertRegex(head, r'type="Int32"[^>]*Name="offsets"')

    def test_every_file_has_its_final_name(self):
        pieces = [f"piece_{i:06}.vtu" for i in range(NUM_SUBDOMAINS)]
        expected = {
            *("mesh.pvtu", "boundary.pvtu", "case.toml", "report.html", "report.json", ".tessera.lock", "log/run.log"),
            *(f"mesh/{piece}" for piece in pieces),
            *(f"log/rank_{rank:06}.log" for rank in range(2)),
        }
        found = {f.relative_to(self.out).as_posix() for f in self.out.rglob("*") if f.is_file()}
        boundary = {f"boundary/{piece}" for piece in pieces}
        self.assertEqual(found - boundary, expected)
        self.assertFalse((self.out / "pieces").exists())

    def test_case_runs_again_to_the_same_digest(self):
        again = self.mesh("out/case.toml", "again")
        report = json.loads((again / "report.json").read_text())
        self.assertEqual(report["digest"], self.report["digest"])

    def test_report(self):
        self.assert_has_keys(self.report, REPORT_KEYS, "report.json")
        self.assertEqual((self.report["schema"], self.report["status"], self.report["exit_code"]), (1, "ok", 0))
        self.assertEqual((self.report["case"], self.report["num_ranks"]), ("case.toml", 2))
        self.assertRegex(self.report["digest"], "^[0-9a-f]{32}$")
        self.assertEqual(len(self.report["quality"]["mean_ratio"]["histogram"]), 20)
        self.assertEqual(sum(self.report["quality"]["mean_ratio"]["histogram"]), self.report["num_tets"])
        self.assertEqual([stage["name"] for stage in self.report["stages"]], STAGES)
        for stage in self.report["stages"]:
            self.assertLessEqual(stage["rank_min_s"], stage["rank_max_s"])
            self.assertLessEqual(stage["rank_max_s"], self.report["wall_time_s"])
        subdomains = self.report["subdomains"]
        self.assertEqual([s["id"] for s in subdomains], list(range(NUM_SUBDOMAINS)))
        self.assertEqual(sum(s["tets"] for s in subdomains), self.report["num_tets"])
        for key in ("material", "kernel", "tries", "seconds"):
            self.assertTrue(all(key in s for s in subdomains), key)

    def assert_has_keys(self, json_object, keys, where):
        for key, expected in keys.items():
            self.assertIn(key, json_object, where)
            if isinstance(expected, dict):
                self.assert_has_keys(json_object[key], expected, f"{where}: {key}")
            else:
                self.assertIsInstance(json_object[key], expected, f"{where}: {key}")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Solids that touch, overlap or leave gaps, from the file to the mesh."""
import collections
import json
import math
import pathlib
import subprocess
import unittest

import program
from program import OK, WRONG_INPUT
from vtkmodules.vtkCommonDataModel import vtkTriangle
from vtk_grids import grid_of

MAKER = pathlib.Path(program.PROGRAM).parent / "assembly_models"


# Models of the maker that overlap, on purpose; of one a body is there twice.
OVERLAPPING = {"inclusion", "overlapping_corners", "pin_through_plate", "three_overlaps", "twice"}
NUM_MODELS = 17


def areas_between_materials(folder):
    """Of triangles with tets of two materials, by the materials' numbers."""
    tets = grid_of(folder / "mesh.pvtu")
    ids, material = tets.GetPointData().GetArray("GlobalPointIds"), tets.GetCellData().GetArray("attribute")
    first, areas = {}, collections.Counter()
    for cell in range(tets.GetNumberOfCells()):
        rows = [tets.GetCell(cell).GetPointId(i) for i in range(4)]
        for left_out in range(4):
            corners = [row for i, row in enumerate(rows) if i != left_out]
            key = frozenset(int(ids.GetValue(row)) for row in corners)
            if key not in first:
                first[key] = int(material.GetValue(cell))
            elif first[key] != (other := int(material.GetValue(cell))):
                areas[tuple(sorted((first[key], other)))] += vtkTriangle.TriangleArea(*map(tets.GetPoint, corners))
    return areas


class Assemblies(program.ProgramTest):
    @classmethod
    def setUpClass(cls):
        cls.models = cls.make_maker().folder / "models"
        subprocess.run([MAKER, cls.models], check=True, capture_output=True)

    def case_of(self, model, *settings, size=0.4):
        text = f"geometry.file = '{self.models / model}'\ncoarse.max_size = {size}\nrefine.levels = 1\noutput.report_html = false\n"
        return self.write("case.toml", text + "\n".join(settings))

    def mesh_of(self, model, output, *settings, ranks=None):
        return self.mesh(self.case_of(model, *settings), output, ranks=ranks)

    def info(self, model):
        outcome = self.run_program("info", self.models / model, "--json")
        self.assertEqual(outcome.code, OK, outcome.err)
        return json.loads(outcome.out)

    def test_info_lists_what_touches_what(self):
        for model, touches in (
            ("stairs.step", [([1, 2], 0.75), ([2, 3], 0.75), ([3, 4], 0.75)]),
            ("pin_in_hole.step", [([1, 2], 1.4 * math.pi)]),
            ("boxes_at_line.brep", []),
        ):
            with self.subTest(model=model):
                found = self.info(model)
                self.assertEqual([touch["solids"] for touch in found["touches"]], [pair for pair, _ in touches])
                for touch, (_, area) in zip(found["touches"], touches):
                    self.assertAlmostEqual(touch["area"], area, delta=1e-6 * area)
                    self.assertGreater(touch["num_faces"], 0)
        text = self.run_program("info", self.models / "stairs.step").out
        self.assertIn("pairs of solids that share faces: 3\n", text)
        self.assertIn("  solids 2 'step 2' and 3 'step 3': 1 faces, area 0.75 mm²\n", text)

    def test_the_mesh_has_what_open_cascade_has(self):
        """Areas between bodies, their volumes and names; overlaps where they are meant."""
        models = sorted(self.models.glob("*.step"))
        self.assertEqual(len(models), NUM_MODELS)
        overlapping = set()
        for model in models:
            with self.subTest(model=model.name):
                found = self.info(model.name)
                if found["assembly"]["overlaps"]:
                    overlapping.add(model.stem)
                out = self.mesh_of(model.name, model.stem, "geometry.overlap = 'first'", ranks=2)
                report = json.loads((out / "report.json").read_text(encoding="utf-8"))
                self.assertEqual(
                    [one["name"] for one in report["materials"]], [solid["name"] for solid in found["solids"]]
                )
                for made, solid in zip(report["materials"], found["solids"]):
                    self.assertAlmostEqual(made["volume"] / solid["volume"], 1.0, delta=0.03)
                areas = areas_between_materials(out)
                self.assertEqual(sorted(areas), sorted(tuple(touch["solids"]) for touch in found["touches"]))
                for touch in found["touches"]:
                    self.assertAlmostEqual(areas[tuple(touch["solids"])] / touch["area"], 1.0, delta=0.03)
        self.assertEqual(overlapping, OVERLAPPING)

    def test_info_lists_what_overlaps(self):
        found = self.info("pin_through_plate.step")["assembly"]["overlaps"]
        self.assertEqual([(one["solids"], one["names"]) for one in found], [([1, 2], ["plate", "pin"])])
        self.assertAlmostEqual(found[0]["volume"], 0.49 * math.pi, delta=1e-6)
        self.assertAlmostEqual(found[0]["box"]["high"][2], 1.0, delta=1e-6)

    def test_an_overlap_is_refused_unless_the_case_says_whose_it_is(self):
        model = self.models / "pin_through_plate.step"
        self.assert_refused(self.run_program("mesh", model, "--size", 0.5, "--output", "none", ranks=2), WRONG_INPUT,
                            "solid 1 'plate' and solid 2 'pin' have a volume of 1.53938 in common",
                            "within (-0.7, -0.7, 0) to (0.7, 0.7, 1)", "geometry.overlap")
        out = self.mesh_of(model.name, "last", "geometry.overlap = 'last'")
        report, _ = self.assert_checked(out, 1e-9)
        self.assertAlmostEqual(report["volume"], 16 + 0.49 * math.pi, delta=0.02)
        self.assertEqual(len(report["model"]["assembly"]["overlaps"]), 1)

    def test_a_contact_has_two_faces_and_a_rim_that_a_third_solid_holds(self):
        """boxes_at_edge: three interfaces of area 1; the outside has an area of 16."""
        contact = "[[geometry.contact]]\nbody = 'a'\nother = 'b'"
        shared = program.figures(self.mesh_of("boxes_at_edge.step", "shared"))
        report, _ = self.assert_checked(self.mesh_of("boxes_at_edge.step", "apart", contact), 1e-9)
        self.assertAlmostEqual(report["volume"], shared["volume"], delta=1e-9)
        self.assertAlmostEqual(report["boundary_area"], shared["boundary_area"] + 2.0, delta=1e-9)
        self.assertEqual(len(report["splits"]), 1)
        areas = {one["name"]: one["area"] for one in report["patches"]}
        for side in ("plus", "minus"):
            self.assertAlmostEqual(areas[report["splits"][0][side]], 1.0, delta=1e-9)
        outcome = self.run_program("mesh", self.case_of("boxes_at_edge.step", contact.replace("'b'", "'shaft'")))
        self.assert_refused(outcome, WRONG_INPUT, "[[geometry.contact]]", '"shaft"', '"a", "b", "c"')

    def test_a_contact_may_be_round(self):
        """pin_in_hole: the pin's side, 1.4 pi long and wide, is in contact with the plate."""
        out = self.mesh_of("pin_in_hole.step", "out", "[[geometry.contact]]\nbody = '1'\nother = '2'")
        report, _ = self.assert_checked(out, 1e-9)
        areas = {one["name"]: one["area"] for one in report["patches"]}
        for pair in report["splits"]:
            self.assertAlmostEqual(areas[pair["plus"]], areas[pair["minus"]], places=12)
        self.assertAlmostEqual(sum(areas[pair["plus"]] for pair in report["splits"]), 1.4 * math.pi, delta=0.05)

    def test_a_gap_is_closed_if_the_case_allows_it(self):
        for setting, num_gaps in (("geometry.gap = 0.002", 1), ("", 0)):
            with self.subTest(setting=setting):
                report, _ = self.assert_checked(self.mesh_of("boxes_with_gap.step", f"gap{num_gaps}", setting), 1e-9)
                gaps = report["model"]["assembly"]["closed_gaps"]
                self.assertEqual(len(gaps), num_gaps)
                self.assertEqual(report["repairs"].get("closed_gaps", 0), num_gaps)
                for gap in gaps:
                    self.assertEqual(gap["names"], ["low", "high"])
                    self.assertAlmostEqual(gap["width"], 0.001, delta=1e-6)

    def test_any_number_of_ranks_gives_the_same_mesh(self):
        for model, setting in (
            ("boxes_at_edge.step", "[[geometry.contact]]\nbody = 'a'\nother = '[bc]'"),
            ("three_overlaps.step", "geometry.overlap = 'first'"),
            ("boxes_with_gap.step", "geometry.gap = 0.002"),
        ):
            with self.subTest(model=model):
                digests = {program.figures(self.mesh_of(model, f"{model}{ranks}", setting, ranks=ranks))["digest"]
                           for ranks in (None, 3)}
                self.assertEqual(len(digests), 1)

    def test_keys_of_assemblies_are_for_files_with_solids(self):
        for setting in ("geometry.overlap = 'cut'", "geometry.gap = 0.1"):
            with self.subTest(setting=setting):
                case = self.write_case()
                case.write_text(case.read_text() + setting + "\n")
                self.assert_refused(self.run_program("mesh", case), WRONG_INPUT, ".step, .iges and .brep", ".geo")


if __name__ == "__main__":
    unittest.main()

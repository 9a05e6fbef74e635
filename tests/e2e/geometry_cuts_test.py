# SPDX-License-Identifier: BSD-3-Clause
"""decompose.method = "geometry": planes cut the model before it is meshed."""
import math
import unittest

import program
from program import NO_PAGE, WRONG_INPUT

GEOMETRY = program.CONFIGS / "geometry"

# A plate with a core of another material: their common face is curved, and cuts of both cross it.
PLATE = """\
algebraic3d
solid brick = orthobrick (0, 0, 0; 2, 1, 1) -bcname=wall;
solid pin = cylinder (0.6, 0.5, 0; 0.6, 0.5, 1; 0.25) -bcname=mantle;
solid plate = brick and not pin;
solid core = brick and pin;
tlo plate -material=steel;
tlo core -material=copper;
"""
PERIODIC = """\
algebraic3d
solid left = plane (0, 0, 0; -1, 0, 0);
solid right = plane (1, 1, 1; 1, 0, 0);
solid cube = left and right and plane (0, 0, 0; 0, -1, 0) and plane (0, 0, 0; 0, 0, -1)
  and plane (1, 1, 1; 0, 1, 0) and plane (1, 1, 1; 0, 0, 1);
tlo cube;
identify periodic left right;
"""
CORE_VOLUME = math.pi * 0.25**2
PLANE = "[[decompose.plane]]\npoint = [{}]\nnormal = [{}]\n"


def materials(report):
    return {material["name"]: material["volume"] for material in report["materials"]}


class GeometryCuts(program.ProgramTest):
    def case(self, model, size, keys="", method="geometry", name="case.toml"):
        return self.write(
            name,
            f"geometry.file = '{model}'\ncoarse.max_size = {size}\nrefine.levels = 1\n"
            f"decompose.method = '{method}'\n{NO_PAGE}{keys}",
        )

    def plate(self):
        return self.write("plate.geo", PLATE)

    def check_cells(self, model, size, volumes, tolerance):
        for kernel, ranks in (("netgen", None), ("netgen", 3), ("subdivide", None)):
            keys = f"decompose.subdomains = 5\nfill.kernel = '{kernel}'\n"
            folder = self.mesh(self.case(model, size, keys), f"{kernel}_{ranks}", ranks=ranks)
            if ranks is None:
                report, _ = self.assert_checked(folder, 1e-9)
            self.assertEqual(program.figures(folder)["digest"], report["digest"])
            cuts = report["decompose"]
            self.assertTrue(cuts["parts_are_meshed"], report["coarse"]["failures"])
            self.assertGreaterEqual(cuts["num_parts"], 3)
            self.assertNotIn(0, [part["coarse_tets"] for part in cuts["parts"]])
            for material, volume in volumes.items():
                self.assertAlmostEqual(materials(report)[material], volume, delta=tolerance * volume)
        return report

    def test_csg_parts_make_the_materials_and_patches_of_the_whole(self):
        volumes = {"steel": 2 - CORE_VOLUME, "copper": CORE_VOLUME}
        cut = self.check_cells(self.plate(), 0.3, volumes, 0.02)
        whole = program.figures(
            self.mesh(self.case("plate.geo", 0.3, method="mesh", name="whole.toml"), "whole"))
        self.assertEqual(cut["patch_names"], whole["patch_names"])
        self.assertEqual(list(materials(cut)), list(materials(whole)))
        self.assertEqual(whole["decompose"]["method"], "mesh")

    def test_step_parts_make_the_materials_and_patches_of_the_whole(self):
        model = GEOMETRY / "two_blocks.step"
        cut = self.check_cells(model, 3, {"steel": 1000, "copper": 288}, 1e-9)
        whole = program.figures(
            self.mesh(self.case(model, 3, method="mesh", name="whole.toml"), "whole"))
        self.assertEqual(cut["patch_names"], whole["patch_names"])

    def test_iges_is_cut_too(self):
        keys = "decompose.subdomains = 4\nfill.kernel = 'subdivide'\n"
        folder = self.mesh(self.case(GEOMETRY / "frustum.iges", 0.4, keys), "out", ranks=2)
        report, _ = self.assert_checked(folder, 1e-9)
        self.assertTrue(report["decompose"]["parts_are_meshed"])
        self.assertEqual(report["decompose"]["num_parts"], 4)
        self.assertEqual(report["coarse"]["surface_mesher"], "netgen")
        self.assertEqual(report["patch_names"], ["patch_1", "patch_2", "patch_3"])

    def test_planes_of_the_user_alone_are_the_cuts(self):
        keys = PLANE.format("1.2, 0, 0", "2, 0, 0") + PLANE.format("0, 0.4, 0", "0, -1, 0")
        report = program.figures(self.mesh(self.case(self.plate(), 0.3, keys), "out"))
        planes = report["decompose"]["planes"]
        self.assertTrue(all(plane["is_given"] for plane in planes))
        normals = {tuple(plane["normal"]): plane["offset"] for plane in planes}
        self.assertEqual(normals, {(1, 0, 0): 1.2, (0, -1, 0): -0.4})
        # The first one cuts the plate alone, the second one its halves and the core.
        self.assertEqual(report["decompose"]["num_parts"], 6)
        self.assertGreaterEqual(report["num_subdomains"], 6)

    def test_planes_are_in_output_units(self):
        keys = "geometry.scale = 10\n" + PLANE.format("12, 0, 0", "1, 0, 0")
        report = program.figures(self.mesh(self.case(self.plate(), 3, keys), "out"))
        self.assertEqual([plane["offset"] for plane in report["decompose"]["planes"]], [12])

    def test_a_model_that_cannot_be_cut_is_meshed_as_a_whole(self):
        model = self.write("periodic.geo", PERIODIC)
        keys = "decompose.subdomains = 3\n"
        cut = program.figures(self.mesh(self.case(model, 0.3, keys), "cut"))
        whole = program.figures(
            self.mesh(self.case(model, 0.3, keys, "mesh", "whole.toml"), "whole"))
        self.assertFalse(cut["decompose"]["parts_are_meshed"])
        self.assertIn("meshed as a whole", " ".join(cut["warnings"]))
        self.assertEqual(cut["digest"], whole["digest"])

    def test_what_a_case_must_not_say(self):
        plane = PLANE.format("0, 0, 0", "1, 0, 0")
        cases = (
            (self.plate(), "mesh", plane, ["[[decompose.plane]]", "decompose.method"]),
            (self.plate(), "geometry", PLANE.format("0, 0, 0", "0, 0, 0"), ["normal", "zero"]),
            (self.plate(), "geometry", PLANE.format("5, 0, 0", "1, 0, 0"), ["meets no solid"]),
            (GEOMETRY / "bracket.stl", "geometry", "", ["needs a solid model"]),
        )
        for number, (model, method, keys, words) in enumerate(cases):
            outcome = self.run_program(
                "mesh", self.case(model, 0.5, keys, method), "--output", f"out_{number}")
            self.assert_refused(outcome, WRONG_INPUT, *words)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""[[layer]] beside fill.levels below refine.levels: what is split after the fill has the same layers."""
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
from program import OK, STOPPED, sets  # noqa: E402

PIPE = (
    "algebraic3d\nsolid inlet = plane (0, 0, 0; 0, 0, -1);\nsolid outlet = plane (0, 0, 2; 0, 0, 1);\n"
    "solid pipe = cylinder (0, 0, 0; 0, 0, 2; 0.5) and inlet and outlet;\ntlo pipe;\n"
)
# A wedge of 11 degrees across a channel: its edge has a wake.
WEDGE = (
    "algebraic3d\nsolid channel = orthobrick (-1, -1, 0; 2, 1, 1);\n"
    "solid wedge = plane (0, 0, 0; -1, 0, 0) and plane (1, 0, 0; 0.1, 1, 0) and plane (1, 0, 0; 0.1, -1, 0)\n"
    "  and plane (0, 0, -1; 0, 0, -1) and plane (0, 0, 2; 0, 0, 1);\n"
    "solid flow = channel and not wedge;\ntlo flow;\n"
)
# A ball in a block: two solids that share their points.
BALL = (
    "algebraic3d\nsolid ball = sphere (0.5, 0.5, 0.5; 0.3);\nsolid block = orthobrick (0, 0, 0; 1, 1, 1) and not ball;\n"
    "tlo ball -col=[1, 0, 0];\ntlo block;\n"
)
# Four blocks around a line.
BLOCKS = "algebraic3d\n" + "".join(
    f"solid {name} = orthobrick ({x}, {y}, 0; {x + 1}, {y + 1}, 1);\n" for name, x, y in (("a", 0, 0), ("b", 1, 0), ("c", 0, 1), ("d", 1, 1))
) + "tlo a;\ntlo b;\ntlo c;\ntlo d;\n"
LAYER = "[[layer]]\npatch = '{}'\n{}first = 0.01\ncount = 3\n"


class LayersLevelsTest(program.ProgramTest):
    def case(self, text, layers, size="coarse.max_size = 0.3\nrefine.levels = 2\n"):
        self.write("model.geo", text)
        return self.write("case.toml", f"geometry.file = 'model.geo'\ndecompose.subdomains = 6\n{program.NO_PAGE}{size}{layers}")

    def made(self, case, name, *values, ranks=None):
        out = self.mesh(case, name, "--overwrite", *sets(*values), ranks=ranks)
        figures, _ = self.assert_checked(out, volume_tolerance=1e-12)
        return out, figures

    def assert_same_bits(self, case, *values, others=(3,)):
        """@return The figures."""
        alone, figures = self.made(case, "alone", *values)
        for ranks in others:
            other, _ = self.made(case, f"on_{ranks}", *values, ranks=ranks)
            self.assertEqual(program.figures(other), figures)
            self.assertEqual(program.mesh_files(other), program.mesh_files(alone))
        return figures

    def assert_same_layers(self, figures, case, *values):
        """As where all levels are filled on, the tets beside them apart."""
        _, whole = self.made(case, "whole", *values, "fill.levels=9")
        for key in ("num_tets", "num_cells", "covered", "full_height"):
            self.assertEqual(figures["layers"][key], whole["layers"][key], key)
        self.assertEqual(figures["num_points_off_geometry"], 0)
        self.assertAlmostEqual(figures["layers"]["volume"], whole["layers"]["volume"], places=12)
        self.assertAlmostEqual(figures["volume"], whole["volume"], places=12)
        self.assertAlmostEqual(figures["boundary_area"], whole["boundary_area"], places=9)


class OfAPipe(LayersLevelsTest):
    def pipe(self):
        return self.case(PIPE, LAYER.format("patch_3", ""))

    def test_are_those_of_all_levels(self):
        for kernel, others in (("optimize", (2, 3, 5)), ("netgen", (3,))):
            with self.subTest(kernel=kernel):
                values = (f"fill.kernel={kernel}",)
                figures = self.assert_same_bits(self.pipe(), *values, "fill.levels=1", others=others)
                self.assert_same_layers(figures, self.pipe(), *values)

    def test_stand_on_what_is_split_by_itself(self):
        """By default the last of three levels is a split."""
        _, auto = self.made(self.pipe(), "auto", "refine.levels=3")
        _, asked = self.made(self.pipe(), "asked", "refine.levels=3", "fill.levels=2")
        self.assertEqual(auto["digest"], asked["digest"])

    def test_go_on_after_a_stop(self):
        case = self.pipe()
        values = sets("fill.levels=1", "refine.levels=3", "fill.kernel=optimize")
        whole = self.mesh(case, "whole", *values)
        stopped = self.start("mesh", case, "--output", "out", *values)
        store = self.folder / "out" / "pieces"
        program.wait_until(lambda: any(store.glob("surface_*")), "surfaces of pieces")
        stopped.send_signal(15)
        self.assertIn(self.finish(stopped).code, (STOPPED, OK))
        self.mesh(case, "out", "--resume", *values, ranks=3)
        self.assertEqual(program.figures(self.folder / "out"), program.figures(whole))


class Elsewhere(LayersLevelsTest):
    SPLIT = ("fill.levels=1", "fill.kernel=optimize")

    def test_where_edges_have_levels_of_their_own(self):
        size = "[size]\ntarget = 0.12\n[[size.region]]\nsize = 0.05\nball = { centre = [0.3, 0, 1], radius = 0.2 }\n"
        case = self.case(PIPE, LAYER.format("patch_3", ""), size)
        figures = self.assert_same_bits(case, *self.SPLIT)
        self.assertGreater(len(figures["coarse"]["edges_by_level"]), 1)
        self.assertEqual(figures["layers"]["covered"], 1.0)

    def test_along_wakes(self):
        case = self.case(WEDGE, LAYER.format("patch_[789]", ""))
        figures = self.assert_same_bits(case, *self.SPLIT)
        self.assert_same_layers(figures, case, self.SPLIT[1])

    def test_between_solids(self):
        """On the one side, where columns end at tets of the other, or on both."""
        for name, sides in (("block", ("block",)), ("both", ("block", "ball"))):
            with self.subTest(name=name):
                layers = "".join(LAYER.format("*", f"side = '{side}'\n") for side in sides)
                case = self.case(BALL, layers)
                figures = self.assert_same_bits(case, *self.SPLIT)
                self.assert_same_layers(figures, case, self.SPLIT[1])

    def test_that_end_at_tets_diagonally_across(self):
        """Around the line columns of three blocks end at tets of the fourth, which only two of them have a face with."""
        layers = "".join(LAYER.format("*", f"side = '{side}'\n") for side in "abc")
        case = self.case(BLOCKS, layers)
        self.assert_same_bits(case, *self.SPLIT)
        self.assert_same_bits(case, *self.SPLIT, "decompose.subdomains=4")

    def test_are_the_same_in_parts(self):
        case = self.case(BALL, LAYER.format("*", "side = 'block'\n"))
        out, figures = self.made(case, "out", *self.SPLIT)
        _, in_parts = self.made(case, "parts", *self.SPLIT, "output.parts=3")
        self.assertEqual(in_parts["layers"]["num_tets"], figures["layers"]["num_tets"])
        self.run_program("repartition", out / "mesh.pvtu", "--parts", "3", "--output", "again", ranks=2)
        self.assertEqual(self.run_program("check", self.folder / "again" / "mesh.pvtu").code, OK)

    def test_as_prisms_of_other_formats(self):
        case = self.case(PIPE, LAYER.format("patch_3", ""))
        out, figures = self.made(case, "out", *self.SPLIT, 'output.formats=["pvtu", "msh2"]')
        elements = (out / "mesh_v2.msh").read_text().split("$Elements\n", 1)[1].split("$EndElements", 1)[0]
        prisms = [line for line in elements.splitlines()[1:] if line.split()[1] == "6"]
        self.assertEqual(len(prisms), figures["layers"]["num_cells"])


if __name__ == "__main__":
    unittest.main()

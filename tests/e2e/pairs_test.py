# SPDX-License-Identifier: BSD-3-Clause
"""Any two things that a case may ask for: the mesh conforms, or a message says which two exclude each other."""
import dataclasses
import itertools
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
from program import CONFIGS, DEGRADED, OK  # noqa: E402


@dataclasses.dataclass
class Wish:
    """What a user may ask for."""

    words: tuple  # One of these names it in messages.
    tables: str = ""
    keys: tuple = ()


# Of two_blocks.step: the sides across y of the larger block, and one more of it.
NAMES = "".join(
    f"[[geometry.name]]\nname = '{name}'\npatch = {{ faces = [{face}] }}\n"
    for name, face in (("left", 1), ("front", 4), ("back", 5))
)
# Faces inside are in planes across x, whose continuation is alike on both sides across y.
CRACK = "[[embed]]\nname = 'crack'\ndisk = { centre = [6.5, 5, 5], normal = [1, 0, 0], radius = 2 }\n"
WISHES = {
    "periodic": Wish(("[[periodic]]",), "[[periodic]]\nfrom = 'front'\nto = 'back'\n"),
    "layers": Wish(("[[layer]]",), "[[layer]]\npatch = 'left'\nfirst = 0.1\ncount = 2\n"),
    "fault": Wish(
        ("[[embed]]",), "[[embed]]\nname = 'fault'\npolygon = [[3, 3, 3], [3, 7, 3], [3, 7, 7], [3, 3, 7.0]]\n"
    ),
    "crack": Wish(("[[embed]]", "[[split]]"), CRACK + "[[split]]\npatch = 'crack'\n"),
    "well": Wish(("[[embed]]",), "[[embed]]\nname = 'well'\npolyline = [[5, 5, 12], [5, 5, 4.0]]\n"),
    "contact": Wish(("[[geometry.contact]]",), "[[geometry.contact]]\nbody = 'steel'\nother = 'copper'\n"),
    "region": Wish(("[[size.region]]",), "[[size.region]]\nmaterial = 'copper'\nsize = 0.7\n"),
    "order 2": Wish(("output.order",), keys=("output.order=2",)),
    "subdivide": Wish(("fill.kernel",), keys=("fill.kernel='subdivide'",)),
    "split after the fill": Wish(("fill.levels",), keys=("refine.levels=2", "fill.levels=1")),
    "corners": Wish(("fill.split_corners",), keys=("fill.split_corners=true",)),
    "planes": Wish(("decompose.method",), keys=("decompose.method='geometry'",)),
    "octree": Wish(("decompose.method",), keys=("decompose.method='octree'",)),
    "gmsh": Wish(("coarse.mesher",), keys=("coarse.mesher='gmsh'",)),
    "parts": Wish(("output.parts",), keys=("output.parts=3",)),
    "openfoam": Wish(("output.formats", "openfoam"), keys=("output.formats=['openfoam-serial']",)),
}
# The pairs that exclude each other, as docs/user_guide.md has them.
REFUSED = {
    "periodic × planes", "periodic × gmsh", "layers × well", "layers × order 2",
    "layers × planes", "fault × planes", "fault × gmsh", "crack × planes", "crack × gmsh",
    "well × planes", "well × gmsh", "order 2 × split after the fill", "order 2 × openfoam", "planes × gmsh",
}  # fmt: skip


class Pairs(program.ProgramTest):
    def outcome_of(self, pair):
        """"ok", or the message that refuses it."""
        wishes = [WISHES[name] for name in pair]
        case = self.write(
            "case.toml",
            f"geometry.file = '{CONFIGS / 'geometry/two_blocks.step'}'\ncoarse.max_size = 2.5\nrefine.levels = 1\n"
            f"decompose.subdomains = 5\n{program.NO_PAGE}{NAMES}" + "".join(wish.tables for wish in wishes),
        )
        keys = [key for wish in wishes for key in wish.keys]
        out = self.folder / "out"
        run = self.run_program(
            "mesh", case, "--output", out, "--overwrite", "--progress", "never", *program.sets(*keys), ranks=2
        )
        if run.code in (OK, DEGRADED):
            found = self.run_program("check", out / "mesh.pvtu")
            self.assertEqual(found.code, OK, found.out)
            return "ok"
        for wish in wishes:
            self.assertTrue(any(word in run.err for word in wish.words), run.err)
        return run.err

    def test_conform_or_are_refused_by_name(self):
        refused = set()
        for pair in itertools.combinations(WISHES, 2):
            with self.subTest(pair=pair):
                if self.outcome_of(pair) != "ok":
                    refused.add(" × ".join(pair))
        self.assertEqual(refused, REFUSED)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""A penny-shaped crack in a block ([[embed]], [[split]]): CalculiX finds how far it opens under pressure, as Sneddon has it."""
import math
import pathlib
import tempfile
import unittest

import numpy
import solver_meshes
from calculix_test import POISSON, YOUNG, Deck
from solver_meshes import Mesh

RADIUS, HALF, PRESSURE = 1.0, 6.0, 1.0
# A quarter of a block, as it is alike on all sides. Far away from the crack it is held.
BLOCK = f"algebraic3d\nsolid block = orthobrick (0, 0, -{HALF}; {HALF}, {HALF}, {HALF});\ntlo block;\n"
CASE = f"""geometry.file = "block.geo"
size.target = 2.0
output.order = 2
decompose.subdomains = 8
[[size.region]]
size = SIZE
cylinder = {{ start = [0, 0, -0.3], end = [0, 0, 0.3], radius = 1.2 }}
[[embed]]
name = "crack"
disk = {{ centre = [0, 0, 0], normal = [0, 0, 1], radius = {RADIUS} }}
[[split]]
patch = "crack"
"""


class Crack(unittest.TestCase):
    def opening_error(self, size):
        """Of the opening, over that of Sneddon; on the mean over the inner part of the crack."""
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "crack.toml"
            case.write_text(CASE.replace("SIZE", str(size)), encoding="utf-8")
            case.with_name("block.geo").write_text(BLOCK, encoding="utf-8")
            mesh = Mesh(case, 3)
        self.addCleanup(mesh.remove)
        deck = Deck(mesh.convert("abaqus") / "mesh.inp")
        lines = []
        for axis in range(3):
            is_held = abs(deck.xyz).max(axis=1) > HALF - 1e-9
            if axis < 2:  # A plane of symmetry.
                is_held |= deck.xyz[:, axis] < 1e-9
            lines += [f"{node},{axis + 1},{axis + 1}\n" for node in numpy.flatnonzero(is_held) + 1]
        tables = deck.solve(
            "*BOUNDARY\n" + "".join(lines)
            + f"*DSLOAD\nCRACK_PLUS,P,{PRESSURE}\nCRACK_MINUS,P,{PRESSURE}\n"
            "*NODE PRINT, NSET=N_CRACK_PLUS\nU\n*NODE PRINT, NSET=N_CRACK_MINUS\nU\n"
        )
        moved = {}
        for side in ("PLUS", "MINUS"):
            nodes, found = deck.displacements(tables, f"N_CRACK_{side}")
            moved[side] = {tuple(deck.xyz[node - 1]): move[2] for node, move in zip(nodes, found)}
        self.assertEqual(set(moved["PLUS"]), set(moved["MINUS"]))
        errors = []
        for place, above in moved["PLUS"].items():  # The disk looks up.
            r = math.hypot(place[0], place[1])
            exact = 8.0 * (1.0 - POISSON**2) * PRESSURE / (math.pi * YOUNG) * math.sqrt(max(RADIUS**2 - r * r, 0.0))
            if r < 0.8 * RADIUS:
                errors.append((above - moved["MINUS"][place]) / exact - 1.0)
            elif r > RADIUS - 1e-6:
                self.assertEqual(moved["MINUS"][place], above)
        return float(numpy.mean(errors)), deck.xyz.shape[0]

    def test_opens_as_sneddon_says(self):
        found = [self.opening_error(size) for size in (0.5, 0.25, 0.08)]
        print("opening off by", ", ".join(f"{100.0 * error:.2f} % ({nodes} nodes)" for error, nodes in found))
        self.assertLess(abs(found[-1][0]), 0.02)
        self.assertLess(abs(found[-1][0]), abs(found[0][0]))


if __name__ == "__main__":
    solver_meshes.main()

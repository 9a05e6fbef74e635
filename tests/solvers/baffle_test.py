# SPDX-License-Identifier: BSD-3-Clause
"""A thin baffle in a channel, as two patches of OpenFOAM: ideal flow past it, against the exact solution, in one mesh and
in parts."""
import math
import re
import unittest

import numpy
import solver_meshes
from openfoam_test import OPENFOAM, SYSTEM, Case, with_head
from solver_meshes import made_of, mpirun, run

PARTS = 3
LENGTH, HEIGHT, GAP = 4.0, 1.0, 0.5
# The channel seems longer by that: the potential far away, by the map cosh(pi z / HEIGHT) of a half of the channel.
ADDED = 4.0 * HEIGHT / math.pi * math.log(1.0 / math.sin(0.5 * math.pi * GAP / HEIGHT))

MODEL = f"algebraic3d\nsolid channel = orthobrick (0, 0, 0; {LENGTH}, {HEIGHT}, 0.2);\ntlo channel;\n"
CASE = f"""geometry.file = "model.geo"
size.target = 0.08

[[geometry.name]]
name = "inlet"
patch = {{ normal = [-1, 0, 0], box = {{ min = [0, 0, 0], max = [0, 1, 1] }} }}

[[geometry.name]]
name = "outlet"
patch = {{ normal = [1, 0, 0], box = {{ min = [{LENGTH}, 0, 0], max = [{LENGTH}, 1, 1] }} }}

[[embed]]
name = "baffle"
polygon = [[2, {GAP}, -0.1], [2, 1.1, -0.1], [2, 1.1, 0.3], [2, {GAP}, 0.3]]

[[size.region]]
patch = "baffle"
size = 0.03
"""
SPLIT = """
[[split]]
patch = "baffle"
"""
LAYERS = """
[[layer]]
patch = "baffle"
first = 0.004
count = 3
"""


class Baffle(unittest.TestCase):
    def cases(self, folder):
        return [Case(part) for part in sorted(folder.glob("processor*"))] or [Case(folder)]

    def run_in(self, folder, *command):
        if len(self.cases(folder)) == 1:
            return run(command, folder=folder, env=OPENFOAM)
        return mpirun(PARTS, [*command, "-parallel"], folder=folder, env=OPENFOAM)

    def added_length(self, folder):
        """From the slope of the potential near both ends, where the flow is even."""
        for name, text in SYSTEM.items():
            (folder / "system" / name).write_text(with_head("dictionary", name, text))
        (folder / "constant").mkdir(exist_ok=True)
        (folder / "constant/transportProperties").write_text(
            with_head("dictionary", "transportProperties", "DT DT [0 2 -1 0 0 0 0] 1;\n")
        )
        values = {"inlet": "type fixedValue; value uniform 0;", "outlet": "type fixedValue; value uniform 1;"}
        for part in self.cases(folder):
            part.write_field(lambda name: values.get(name, "type zeroGradient;"))
        self.run_in(folder, "laplacianFoam")
        x = numpy.concatenate([part.cell_centres()[:, 0] for part in self.cases(folder)])
        potential = numpy.concatenate([part.temperatures() for part in self.cases(folder)])
        slopes = [numpy.polyfit(x[where], potential[where], 1)[0] for where in (x < 0.7, x > LENGTH - 0.7)]
        return 1.0 / numpy.mean(slopes) - LENGTH

    def test_the_flow_goes_around(self):
        mesh = made_of(MODEL, CASE + SPLIT, parts=PARTS)
        self.addCleanup(mesh.remove)
        found = []
        for folder in (mesh.convert(name) for name in ("openfoam-serial", "openfoam")):
            out = self.run_in(folder, "checkMesh", "-allGeometry", "-allTopology")
            self.assertEqual(re.findall(r"\*\*\*(.*)", out), [])
            self.assertIn("Mesh OK.", out)
            areas = dict.fromkeys(("baffle_plus", "baffle_minus"), 0.0)
            for part in self.cases(folder):
                for name in areas:
                    areas[name] += numpy.linalg.norm(part.face_areas[slice(*part.patches[name][1:3])], axis=1).sum()
            for area in areas.values():
                self.assertAlmostEqual(area, 0.2 * (HEIGHT - GAP), delta=1e-12)
            found.append(self.added_length(folder))
        print(f"added length: exact {ADDED:.5f}, in one mesh {found[0]:.5f}, in parts {found[1]:.5f}")
        self.assertLess(abs(found[0] / ADDED - 1.0), 0.035)  # 2.8 %, and 2.3 % with edges of half the length.
        self.assertAlmostEqual(found[1], found[0], delta=1e-5)

    def test_layers_on_both_sides_do_not_disturb_it(self):
        mesh = made_of(MODEL, CASE + SPLIT + LAYERS, parts=PARTS)
        self.addCleanup(mesh.remove)
        folder = mesh.convert("openfoam-serial")
        out = self.run_in(folder, "checkMesh")
        self.assertIn("Mesh OK.", out)
        self.assertGreater(int(re.search(r"prisms: +(\d+)", out)[1]), 1000)
        found = self.added_length(folder)
        print(f"added length with layers: {found:.5f}")
        self.assertLess(abs(found / ADDED - 1.0), 0.035)

    def test_without_a_split_it_goes_through(self):
        """So the test above looks at what it is meant to."""
        mesh = made_of(MODEL, CASE, parts=PARTS)
        self.addCleanup(mesh.remove)
        self.assertLess(abs(self.added_length(mesh.convert("openfoam-serial"))), 1e-3)


if __name__ == "__main__":
    solver_meshes.main()

# SPDX-License-Identifier: BSD-3-Clause
"""mesh.mesh: FreeFEM finds volumes by region and areas by label, and solves the patch test with P1 and P2."""
import re
import unittest

import solver_meshes
from solver_meshes import Mesh, run

# Prints "region TAG VOLUME", "label TAG AREA", "error SPACE VALUE".
SCRIPT = """
mesh3 Th = readmesh3("{file}");
cout.precision(16);
cout << "tets " << Th.nt << endl;
int[int] tags = [{materials}];
for (int i = 0; i < tags.n; i++)
  cout << "region " << tags[i] << " " << int3d(Th, tags[i])(1.) << endl;
int[int] labels = [{patches}];
for (int i = 0; i < labels.n; i++)
  cout << "label " << labels[i] << " " << int2d(Th, labels[i])(1.) << endl;
macro grad(u) [dx(u), dy(u), dz(u)] //
func linear = 1 + 2*x - 3*y + 0.5*z;
func quadratic = x*x - 2*y*y + z*z + x*y;
fespace Vh(Th, P1);
Vh u, v;
solve first(u, v, solver=CG, eps=1e-24)
  = int3d(Th)(grad(u)'*grad(v)) + on({outer}, u=linear);
cout << "error P1 " << sqrt(int3d(Th)(square(u - linear)) / int3d(Th)(square(linear))) << endl;
fespace Wh(Th, P2);
Wh p, q;
solve second(p, q, solver=CG, eps=1e-24)
  = int3d(Th)(grad(p)'*grad(q)) + on({outer}, p=quadratic);
cout << "error P2 " << sqrt(int3d(Th)(square(p - quadratic)) / int3d(Th)(square(quadratic))) << endl;
"""


def names_of(file, kind):
    """By tag, from the comments behind the end."""
    text = file.read_text(encoding="utf-8").partition("\nEnd\n")[2]
    return {int(tag): name for tag, name in re.findall(rf"^# {kind} (\d+) (.*)$", text, re.MULTILINE)}


class FreeFem(unittest.TestCase):
    def solve(self, mesh, file):
        outer = mesh.outer_areas()
        patches = names_of(file, "patch")
        # The quadratic function is harmonic, so P2 has it exactly where boundary values are given.
        script = mesh.folder / "solve.edp"
        script.write_text(
            SCRIPT.format(
                file=file,
                materials=",".join(map(str, names_of(file, "material"))),
                patches=",".join(map(str, patches)),
                outer=",".join(str(tag) for tag, name in patches.items() if name in outer),
            ),
            encoding="utf-8",
        )
        out = run(["FreeFem++", "-nw", "-ne", "-v", "0", script])
        return {
            word: {tag: float(value) for tag, value in re.findall(rf"^{word} (\w+) (\S+)$", out, re.MULTILINE)}
            for word in ("region", "label", "error")
        }

    def check(self, case):
        mesh = Mesh(case, 3)
        self.addCleanup(mesh.remove)
        file = mesh.convert("medit") / "mesh.mesh"
        found = self.solve(mesh, file)
        for word, kind, expected in (("region", "material", mesh.volumes()), ("label", "patch", mesh.areas())):
            names = names_of(file, kind)
            self.assertEqual(set(names.values()), set(expected))
            for tag, name in names.items():
                self.assertAlmostEqual(found[word][str(tag)] / expected[name], 1.0, delta=1e-9)
        total = sum(found["region"].values())
        self.assertAlmostEqual(total / mesh.report()["volume"], 1.0, delta=1e-9)
        self.assertLess(found["error"]["P1"], 1e-10)
        self.assertLess(found["error"]["P2"], 1e-10)

    def test_three_materials(self):
        self.check("core")

    def test_bracket(self):
        self.check("bracket")


if __name__ == "__main__":
    solver_meshes.main()

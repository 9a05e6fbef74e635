# SPDX-License-Identifier: BSD-3-Clause
"""output.parts: balanced parts of whole subdomains, one file each, the same for any number of ranks."""
import itertools
import unittest
import xml.etree.ElementTree

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

import program
from program import OK, WRONG_INPUT


def read(file):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def point_ids(file):
    return set(vtk_to_numpy(read(file).GetPointData().GetArray("GlobalPointIds")).tolist())


def neighbours(file):
    """The field data of a mesh's file. Of an index VTK shows none."""
    if file.suffix == ".pvtu":
        array = xml.etree.ElementTree.parse(file).find(".//FieldData/DataArray[@Name='neighbours']")
        rows = [[int(word) for word in line.split()] for line in array.text.strip().splitlines()]
        assert len(rows) == int(array.get("NumberOfTuples"))
        return rows
    return vtk_to_numpy(read(file).GetFieldData().GetArray("neighbours")).tolist()


def shared_points(folder):
    """[file, other file, points that both have], as report.json has it."""
    ids = [point_ids(file) for file in sorted((folder / "mesh").iterdir())]
    pairs = itertools.combinations(range(len(ids)), 2)
    counts = [[a, b, len(ids[a] & ids[b])] for a, b in pairs]
    return [count for count in counts if count[2] > 0]


class Parts(program.ProgramTest):
    def setUp(self):
        super().setUp()
        self.case = self.write_case(max_size=0.6, subdomains=40)

    def test_any_number_of_ranks(self):
        alone = self.mesh(self.case, "alone", "--set", "output.parts=3")
        figures = program.figures(alone)
        self.assertEqual(len(figures["parts"]["tets"]), 3)
        self.assertEqual(sum(figures["parts"]["tets"]), figures["num_tets"])
        # Shared out by predicted tets, which for pieces of some hundred are a fifth off.
        self.assertLess(figures["parts"]["balance"], 1.3)
        self.assertEqual(figures["file_neighbours"], shared_points(alone))
        self.assertEqual(neighbours(alone / "mesh.pvtu"), shared_points(alone))
        self.assertEqual(sorted(f.name for f in (alone / "mesh").iterdir()), [f"piece_{i:06}.vtu" for i in range(3)])
        other = self.mesh(self.case, "three", "--set", "output.parts=3", ranks=3)
        self.assertEqual(program.figures(other), figures)
        self.assertEqual(program.mesh_files(other), program.mesh_files(alone))
        outcome = self.run_program("check", alone / "mesh.pvtu")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)

    def test_subdivision_writes_parts_in_one_pass(self):
        out = self.mesh(self.case, "out", "--set", "output.parts=4", "--set", "fill.kernel=subdivide", ranks=2)
        parts = program.figures(out)["parts"]
        self.assertEqual(len(parts["tets"]), 4)
        self.assertLess(parts["balance"], 1.1)
        outcome = self.run_program("check", out / "mesh.pvtu")
        self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        self.check_other_commands(out)

    def check_other_commands(self, mesh):
        """The files of `repartition` and `convert` say who shares points, too."""
        again = self.folder / "again"
        outcome = self.run_program("repartition", mesh / "mesh.pvtu", "--parts", 3, "--output", again, ranks=2)
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertGreater(len(shared_points(again)), 1)
        self.assertEqual(neighbours(again / "mesh.pvtu"), shared_points(again))
        outcome = self.run_program("convert", mesh / "mesh.pvtu", "--format", "pvtu-cells", "--output", "cells")
        self.assertEqual(outcome.code, OK, outcome.err)
        pairs = shared_points(mesh)
        self.assertEqual(neighbours(self.folder / "cells/cells.pvtu"), pairs)
        for piece, file in enumerate(sorted((self.folder / "cells/cells").iterdir())):
            own = [[a, b, n] for a, b, n in pairs if a == piece] + [[b, a, n] for a, b, n in pairs if b == piece]
            self.assertEqual(neighbours(file), sorted(own))

    def test_automatic_subdomains_are_enough_for_the_parts(self):
        for kernel in ("netgen", "subdivide"):
            out = self.mesh(self.case, kernel, "--set", "output.parts=2", "--set",
                            "decompose.subdomains=auto", "--set", f"fill.kernel={kernel}")
            self.assertGreaterEqual(program.figures(out)["num_subdomains"], 32)

    def test_as_many_subdomains_as_there_are_coarse_tets(self):
        wanted = "decompose.subdomains=100000"
        for kernel in ("netgen", "subdivide"):
            out = self.mesh(self.case, kernel, "--set", wanted, "--set", "coarse.max_size=1", "--set",
                            f"fill.kernel={kernel}")
            report = program.figures(out)
            self.assertGreater(report["num_subdomains"], 20)
            self.assertEqual(report["num_subdomains"], report["coarse"]["num_tets"])
            self.assertEqual(len(report["warnings"]), 1)
            for words in ("decompose.subdomains is 100000", f"only {report['num_subdomains']} tets"):
                self.assertIn(words, report["warnings"][0])
            self.assertIn(report["warnings"][0], (out / "log/run.log").read_text())
            outcome = self.run_program("check", out / "mesh.pvtu")
            self.assertEqual(outcome.code, OK, outcome.err + outcome.out)
        few = self.mesh(self.case, "few")
        self.assertEqual(program.figures(few)["warnings"], [])

    def test_what_cannot_be_had(self):
        for arguments, words in (
            (("output.parts=41", "decompose.subdomains=2"), ("/ball.geo: output.parts is 41", "decompose.subdomains")),
            (("output.parts=2", "output.files=2"), ("output.parts excludes output.files",)),
        ):
            sets = [word for argument in arguments for word in ("--set", argument)]
            outcome = self.run_program("mesh", self.case, "--output", "out", *sets, "--overwrite")
            self.assert_refused(outcome, WRONG_INPUT, *words)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""processorN/constant/polyMesh and constant/polyMesh: OpenFOAM's checkMesh finds them sound, and
laplacianFoam solves on them, on three ranks as on one."""
import os
import pathlib
import re
import shutil
import sys
import unittest

import numpy
import solver_meshes
from solver_meshes import Mesh, mpirun, run

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from poly_mesh import PolyMesh, read_list  # noqa: E402

PARTS = 3

# The package has its binaries in PATH and its data here; nothing else is needed.
OPENFOAM = os.environ | {"WM_PROJECT_DIR": "/usr/share/openfoam"}

SYSTEM = {
    "fvSchemes": """ddtSchemes { default steadyState; }
gradSchemes { default leastSquares; }
divSchemes { default none; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
""",
    "fvSolution": """solvers { T { solver PCG; preconditioner DIC; tolerance 1e-13; relTol 0; } }
SIMPLE { nNonOrthogonalCorrectors 40; }
""",
}


def with_head(kind, name, text):
    return f"FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n{text}"


class Case(PolyMesh):
    """A processor or the whole of a case, with the field T."""

    def temperatures(self):
        """Of the cells, after the solve."""
        content = (self.folder / "1/T").read_bytes()
        begin = content.index(b"nonuniform List<scalar>") + len(b"nonuniform List<scalar>")
        return read_list(content, "<f8", begin)[0]

    def write_field(self, value_of_patch):
        """0/T, from what is wanted on each patch."""
        entries = [f"{name} {{ {value_of_patch(name)} }}" for name in self.outer_patches()]
        entries += [
            f"{name} {{ type {patch[0]}; value uniform 0; }}"
            for name, patch in self.patches.items() if patch[0] in ("processor", "cyclic", "processorCyclic")
        ]  # fmt: skip
        (self.folder / "0").mkdir(exist_ok=True)
        (self.folder / "0/T").write_text(
            with_head(
                "volScalarField", "T",
                "dimensions [0 0 0 1 0 0 0];\ninternalField uniform 0;\nboundaryField\n{\n"
                + "\n".join(entries) + "\n}\n",
            )
        )  # fmt: skip

    def values_where_normals_meet(self, name, field):
        """A field where the normals through the cells' centres meet the faces of a patch. There
        OpenFOAM takes the values of a boundary, so a linear field is met exactly."""
        faces = slice(*self.patches[name][1:3])
        normals = self.face_areas[faces]
        normals = normals / numpy.linalg.norm(normals, axis=1)[:, None]
        centres = self.cell_centres()[self.owner[faces]]
        away = numpy.einsum("ij,ij->i", self.face_centres[faces] - centres, normals)
        values = field(centres + away[:, None] * normals)
        numbers = "\n".join(map(repr, values.tolist()))
        return f"type fixedValue; value nonuniform List<scalar> {len(values)}(\n{numbers}\n);"


def linear(points):
    return 3.0 + points @ numpy.array([0.5, -0.25, 0.125])


class Openfoam(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.meshes = {case: Mesh(case, PARTS) for case in ("core", "bracket")}
        cls.folders = {}
        for case, mesh in cls.meshes.items():
            cls.addClassCleanup(mesh.remove)
            cls.folders[case] = {name: mesh.convert(name) for name in ("openfoam", "openfoam-serial")}

    def serial(self, case):
        return Case(self.folders[case]["openfoam-serial"])

    def processors(self, case):
        folder = self.folders[case]["openfoam"]
        self.assertEqual(len(list(folder.glob("processor*"))), PARTS)
        return [Case(folder / f"processor{p}") for p in range(PARTS)]

    def run_both(self, case, *command):
        """Standard output on one rank, and on as many as there are parts."""
        folders = self.folders[case]
        return (
            run(command, folder=folders["openfoam-serial"], env=OPENFOAM),
            mpirun(PARTS, [*command, "-parallel"], folder=folders["openfoam"], env=OPENFOAM),
        )

    def test_check_mesh(self):
        """All that checkMesh can check; by default no tet has fewer than three inner faces."""
        for case in self.meshes:
            for options in ((), ("-allGeometry", "-allTopology")):
                for out in self.run_both(case, "checkMesh", *options):
                    with self.subTest(case, options=options):
                        self.assertIn("Upper triangular ordering OK.", out)
                        self.assertEqual(re.findall(r"\*\*\*(.*)", out), [])
                        self.assertIn("Mesh OK.", out)
                        if options:
                            self.assertIn("Coupled point location match (average 0) OK.", out)

    def test_check_mesh_finds_corners_that_are_not_split(self):
        """So the test above looks at what it is meant to."""
        mesh = Mesh("core", PARTS, "fill.split_corners=false")
        self.addCleanup(mesh.remove)
        folder = mesh.convert("openfoam-serial")
        made = Case(folder)
        num_outer = numpy.bincount(made.owner[len(made.neighbour) :], minlength=made.num_cells())
        expected = int((num_outer > 1).sum())
        self.assertGreater(expected, 0)
        errors = re.findall(
            r"\*\*\*(.*)", run(["checkMesh", "-allGeometry", "-allTopology"], folder=folder, env=OPENFOAM)
        )
        self.assertEqual(len(errors), 1, errors)
        self.assertRegex(errors[0], rf"small determinant .* number of cells: {expected}$")

    def test_volumes_by_zone(self):
        for case, mesh in self.meshes.items():
            expected = mesh.volumes()
            for meshes in (self.processors(case), [self.serial(case)]):
                with self.subTest(case, parts=len(meshes)):
                    sums = dict.fromkeys(expected, 0.0)
                    for part in meshes:
                        volumes = part.cell_volumes()
                        self.assertGreater(volumes.min(), 0.0)
                        self.assertEqual(list(part.zones), list(expected))
                        every = numpy.sort(numpy.concatenate(list(part.zones.values())))
                        self.assertEqual(every.tolist(), list(range(part.num_cells())))
                        for name, cells in part.zones.items():
                            sums[name] += volumes[cells].sum()
                    for name, volume in expected.items():
                        self.assertAlmostEqual(sums[name], volume, delta=1e-10 * volume)
                    total = mesh.report()["volume"]
                    self.assertAlmostEqual(sum(sums.values()), total, delta=1e-10 * total)

    def test_areas_by_patch(self):
        for case, mesh in self.meshes.items():
            expected = mesh.outer_areas()
            for meshes in (self.processors(case), [self.serial(case)]):
                with self.subTest(case, parts=len(meshes)):
                    sums = dict.fromkeys(expected, 0.0)
                    for part in meshes:
                        self.assertEqual(set(part.outer_patches()), set(expected))
                        for name, (_, begin, end, _) in part.outer_patches().items():
                            sums[name] += numpy.linalg.norm(part.face_areas[begin:end], axis=1).sum()
                    for name, area in expected.items():
                        self.assertAlmostEqual(sums[name], area, delta=1e-10 * area)

    def test_processor_patches(self):
        """The same faces on both sides, in one order, turned round, from the same point on."""
        num_faces = 0
        for case in self.meshes:
            parts = self.processors(case)
            for part in parts:
                kinds = [patch[0] for patch in part.patches.values()]
                self.assertEqual(kinds, sorted(kinds))  # Those of processors are the last.
                for kind, begin, end, pair in part.patches.values():
                    if kind != "processor":
                        continue
                    other = parts[pair[1]]
                    _, first, last, _ = other.patches[f"procBoundary{pair[1]}to{pair[0]}"]
                    own_corners = part.points[part.faces[begin:end]]
                    other_corners = other.points[other.faces[first:last]]
                    numpy.testing.assert_array_equal(own_corners, other_corners[:, [0, 2, 1]])
                    num_faces += end - begin
        self.assertGreater(num_faces, 0)

    def solve(self, case, text_of_patch):
        """Temperatures of all cells, serial and parallel; in one order, as parts follow each other."""
        for folder, meshes in (
            (self.folders[case]["openfoam"], self.processors(case)),
            (self.folders[case]["openfoam-serial"], [self.serial(case)]),
        ):
            for name, text in SYSTEM.items():
                (folder / "system" / name).write_text(with_head("dictionary", name, text))
            (folder / "constant").mkdir(exist_ok=True)
            (folder / "constant/transportProperties").write_text(
                with_head("dictionary", "transportProperties", "DT DT [0 2 -1 0 0 0 0] 1;\n")
            )
            for part in meshes:
                part.write_field(lambda name, part=part: text_of_patch(part, name))
        self.run_both(case, "laplacianFoam")
        parallel = numpy.concatenate([part.temperatures() for part in self.processors(case)])
        return self.serial(case).temperatures(), parallel

    def test_linear_temperature(self):
        """The patch test: fixed values of a linear field are met by the field."""
        for case in self.meshes:
            with self.subTest(case):
                fields = self.solve(case, lambda part, name: part.values_where_normals_meet(name, linear))
                exact = linear(self.serial(case).cell_centres())
                for found in fields:
                    numpy.testing.assert_allclose(found, exact, rtol=0.0, atol=1e-7 * numpy.ptp(exact))

    def test_conduction_between_two_patches(self):
        """Three ranks find what one finds."""
        values = {"patch_4": 1.0, "patch_7": 0.0}
        self.assertLessEqual(set(values), set(self.serial("bracket").patches))

        def text_of(_, name):
            return f"type fixedValue; value uniform {values[name]};" if name in values else "type zeroGradient;"

        serial, parallel = self.solve("bracket", text_of)
        self.assertGreater(numpy.ptp(serial), 0.9)
        self.assertTrue((-1e-6 < serial).all() and (serial < 1.0 + 1e-6).all())
        numpy.testing.assert_allclose(parallel, serial, rtol=0.0, atol=1e-8)

    def test_reconstructed_from_parts(self):
        """reconstructPar brings the fields of the parts to the serial mesh beside them."""
        serial, _ = self.solve("core", lambda part, name: part.values_where_normals_meet(name, linear))
        folder = self.folders["core"]["openfoam"]
        shutil.copytree(
            self.folders["core"]["openfoam-serial"] / "constant/polyMesh", folder / "constant/polyMesh"
        )
        run(["reconstructPar"], folder=folder, env=OPENFOAM)
        found = Case(folder).temperatures()
        numpy.testing.assert_allclose(found, serial, rtol=0.0, atol=1e-8 * numpy.ptp(serial))


if __name__ == "__main__":
    solver_meshes.main()

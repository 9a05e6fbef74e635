# SPDX-License-Identifier: BSD-3-Clause
"""Laminar flow through a pipe (Hagen-Poiseuille) by OpenFOAM's simpleFoam: the shear stress at the wall, with
layers and with about as many tets alone, against the exact one."""
import os
import pathlib
import re
import sys
import tempfile
import unittest

import numpy
import solver_meshes
from solver_meshes import run

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from poly_mesh import PolyMesh, body_of, read_list  # noqa: E402

OPENFOAM = os.environ | {"WM_PROJECT_DIR": "/usr/share/openfoam"}
RADIUS, LENGTH, MEAN_SPEED, VISCOSITY = 0.5, 4.0, 1.0, 0.1
EXACT = 4.0 * VISCOSITY * MEAN_SPEED / RADIUS  # Over the density.
WALL, INLET, OUTLET = "patch_1", "patch_2", "patch_3"

PIPE = f"""algebraic3d
solid pipe = cylinder (0, 0, 0; 0, 0, {LENGTH}; {RADIUS})
    and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, {LENGTH}; 0, 0, 1);
tlo pipe;
"""

CASE = """geometry.file = "pipe.geo"
coarse.max_size = {size}
refine.levels = 1
output.formats = ["openfoam-serial"]
"""

LAYERS = f"""[[layer]]
patch = "{WALL}"
first = 0.01
count = 5
"""

SYSTEM = {
    "controlDict": """application simpleFoam;
startFrom startTime; startTime 0; stopAt endTime; endTime 500; deltaT 1;
writeControl timeStep; writeInterval 500; writeFormat binary;
functions { wall { type wallShearStress; libs ("libfieldFunctionObjects.so"); writeControl writeTime; } }
""",
    # Second order in all; gradients by least squares, as cells are prisms and tets.
    "fvSchemes": """ddtSchemes { default steadyState; }
gradSchemes { default leastSquares; }
divSchemes { default none; div(phi,U) bounded Gauss linearUpwind grad(U);
             div((nuEff*dev2(T(grad(U))))) Gauss linear; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
""",
    "fvSolution": """solvers
{
    p { solver GAMG; smoother GaussSeidel; tolerance 1e-9; relTol 0.01; }
    U { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-10; relTol 0.01; }
}
SIMPLE { nNonOrthogonalCorrectors 2; consistent yes; residualControl { p 1e-6; U 1e-7; } }
relaxationFactors { equations { U 0.9; } fields { p 0.9; } }
""",
}


def with_head(kind, name, text):
    return f"FoamFile {{ version 2.0; format ascii; class {kind}; object {name}; }}\n{text}"


class Flow:
    """A case in a folder, from its mesh to the stress at the wall."""

    def __init__(self, folder):
        self.folder = folder
        boundary = folder / "constant/polyMesh/boundary"
        text = boundary.read_bytes()
        boundary.write_bytes(re.sub(rb"(%b\s*\{\s*type\s+)patch;" % WALL.encode(), rb"\1wall;", text))
        self.mesh = PolyMesh(folder)
        for name, text in SYSTEM.items():
            (folder / "system" / name).write_text(with_head("dictionary", name, text))
        models = {"transportProperties": f"transportModel Newtonian; nu {VISCOSITY};",
                  "turbulenceProperties": "simulationType laminar;"}
        for name, text in models.items():
            (folder / "constant" / name).write_text(with_head("dictionary", name, text))
        (folder / "0").mkdir()
        self.write_field("volVectorField", "U", "[0 1 -1 0 0 0 0]", f"(0 0 {MEAN_SPEED})", {
            INLET: f"type fixedValue; value nonuniform List<vector> {self.parabola()};",
            OUTLET: "type zeroGradient;", WALL: "type noSlip;"})
        self.write_field("volScalarField", "p", "[0 2 -2 0 0 0 0]", "0", {
            INLET: "type zeroGradient;", OUTLET: "type fixedValue; value uniform 0;", WALL: "type zeroGradient;"})

    def write_field(self, kind, name, dimensions, inside, patches):
        entries = " ".join(f"{patch} {{ {text} }}" for patch, text in patches.items())
        (self.folder / "0" / name).write_text(with_head(
            kind, name, f"dimensions {dimensions};\ninternalField uniform {inside};\nboundaryField {{ {entries} }}\n"))

    def middles(self, patch):
        """Of its faces: means of their corners."""
        _, begin, end, _ = self.mesh.patches[patch]
        corners = self.mesh.points[self.mesh.quads[begin:end]]
        num = self.mesh.num_corners[begin:end, None]
        return numpy.where(num == 4, corners.mean(axis=1), corners[:, :3].mean(axis=1))

    def parabola(self):
        x, y, _ = self.middles(INLET).T
        speeds = 2.0 * MEAN_SPEED * (1.0 - (x**2 + y**2) / RADIUS**2)
        return f"{len(speeds)} (" + "\n".join(f"(0 0 {speed!r})" for speed in map(float, speeds)) + ")"

    def error_of_stress(self):
        """Of the mean over the middle half of the wall, relative."""
        said = run(["simpleFoam"], folder=self.folder, env=OPENFOAM)
        assert "SIMPLE solution converged" in said, said[-2000:]
        last = max((file for file in self.folder.iterdir() if file.name.isdigit()), key=lambda file: int(file.name))
        content = body_of(last / "wallShearStress")
        begin = content.index(b"List<vector>", content.index(WALL.encode())) + len(b"List<vector>")
        stress = numpy.linalg.norm(read_list(content, PolyMesh.VECTOR, begin)[0], axis=1)
        _, first, end, _ = self.mesh.patches[WALL]
        along = self.middles(WALL)[:, 2]
        area = numpy.linalg.norm(self.mesh.face_areas[first:end], axis=1)
        area[(along < 0.25 * LENGTH) | (along > 0.75 * LENGTH)] = 0.0
        return abs(float((stress * area).sum() / area.sum()) / EXACT - 1.0)


class Pipe(unittest.TestCase):
    def flow(self, folder, name, size, more=""):
        (folder / "pipe.geo").write_text(PIPE)
        (folder / f"{name}.toml").write_text(CASE.format(size=size) + more)
        tessera = solver_meshes.arguments()[0].tessera
        run([tessera, "mesh", folder / f"{name}.toml", "--output", folder / name])
        return Flow(folder / name)

    def test_layers_give_the_stress_at_the_wall(self):
        with tempfile.TemporaryDirectory() as scratch:
            layers = self.flow(pathlib.Path(scratch), "layers", 0.2, LAYERS)
            tets = self.flow(pathlib.Path(scratch), "tets", 0.17)
            self.assertGreater(tets.mesh.num_cells(), 0.95 * layers.mesh.num_cells())
            with_layers, without = layers.error_of_stress(), tets.error_of_stress()
        print(f"wall shear stress: {layers.mesh.num_cells()} cells with layers off by {with_layers:.2%}, "
              f"{tets.mesh.num_cells()} tets by {without:.2%}")
        self.assertLess(with_layers, 0.02)
        self.assertLess(with_layers, without / 2.5)


if __name__ == "__main__":
    solver_meshes.main()

# SPDX-License-Identifier: BSD-3-Clause
"""Meshes with periodic sides, solved: OpenFOAM has them as cyclic patches, in one mesh and in parts; GetFEM finds what a
packing of balls conducts, and one sector of a wheel, by the pairs of nodes that mesh_v2.msh lists."""
import itertools
import math
import pathlib
import re
import sys
import unittest

import getfem
import h5py
import numpy
import solver_meshes
from getfem_test import Problem
from openfoam_test import OPENFOAM, SYSTEM, Case, with_head
from scipy.sparse import coo_matrix, csc_matrix, diags
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import cg
from scipy.spatial import cKDTree
from solver_meshes import made_of, mpirun, run

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from periodic_models import PIPE, packing_model  # noqa: E402

PARTS = 3
NUM_BALLS, RADIUS = 12, 0.126
NUM_SECTORS = 12
PAIRS = (("left", "right"), ("front", "back"), ("bottom", "top"))
SOURCE = {
    "fvOptions": "heat { type scalarSemiImplicitSource; active true; selectionMode all; volumeMode specific; "
    "injectionRateSuSp { T (1 0); } }\n"
}


def packing_of_balls():
    """Centres of balls in the unit cube and of their images that reach into it. None is near to another one, nor
    near to touching a side, an edge or a corner."""
    random, centres = numpy.random.RandomState(5), []
    while len(centres) < NUM_BALLS:
        centre = random.rand(3)
        away = numpy.minimum(centre, 1.0 - centre)
        edges = [math.hypot(away[i], away[j]) for i, j in itertools.combinations(range(3), 2)]
        if any(abs(d - RADIUS) < 0.03 for d in (*away, *edges, math.hypot(*away))):
            continue
        between = [numpy.array(other) - centre for other in centres]
        if all(numpy.linalg.norm(d - numpy.round(d)) > 2.0 * RADIUS + 0.05 for d in between):
            centres.append(tuple(centre))
    return [
        image for centre in centres for shift in itertools.product((-1, 0, 1), repeat=3)
        for image in [tuple(numpy.add(centre, shift))]
        if math.dist(image, numpy.clip(image, 0.0, 1.0)) < RADIUS
    ]  # fmt: skip


def balls_model():
    return packing_model([(*(round(x, 6) for x in centre), RADIUS) for centre in packing_of_balls()])


def balls_case(sizes):
    """`sizes`: lines of the case that say how fine."""
    text = f'geometry.file = "model.geo"\n{sizes}\n'
    for axis, (low, high) in enumerate(PAIRS):
        for name, sign in ((low, -1), (high, 1)):
            normal = [sign * (i == axis) for i in range(3)]
            text += f'[[geometry.name]]\nname = "{name}"\npatch = {{ normal = {normal} }}\n'
    return text + "".join(f'[[periodic]]\nfrom = "{a}"\nto = "{b}"\n' for a, b in PAIRS)


def wheel_model(num_sectors):
    """A wheel, or some sectors of it. Holes are not in their middles, so heat flows through the sides."""
    holes = [math.radians(360.0 / NUM_SECTORS * i + 9.5) for i in range(num_sectors)]
    centres = [(0.7 * math.cos(angle), 0.7 * math.sin(angle)) for angle in holes]
    drills = "".join(
        f"solid hole{i} = cylinder ({x:.9f}, {y:.9f}, 0; {x:.9f}, {y:.9f}, 1; 0.1);\n" for i, (x, y) in enumerate(centres)
    )
    sides = "and plane (0, 0, 0; 0, -1, 0) and plane (0, 0, 0; -0.5, 0.8660254037844386, 0)" if num_sectors == 1 else ""
    return (
        "algebraic3d\nsolid disk = cylinder (0, 0, 0; 0, 0, 1; 1) and plane (0, 0, 0; 0, 0, -1) and plane (0, 0, 0.2; 0, 0, 1);\n"
        f"solid hub = cylinder (0, 0, 0; 0, 0, 1; 0.4);\n{drills}solid wheel = disk {sides} and not hub "
        + "".join(f"and not hole{i} " for i in range(num_sectors)) + ";\ntlo wheel;\n"
    )  # fmt: skip


def wheel_case(num_sectors, size):
    text = (
        f'geometry.file = "model.geo"\nsize.target = {size}\n[[geometry.name]]\nname = "hub"\n'
        "patch = { box = { min = [-0.41, -0.41, -1], max = [0.41, 0.41, 1] } }\n"
    )
    if num_sectors > 1:
        return text
    for name, normal in (("start", [0, -1, 0]), ("end", [-0.5, 0.8660254037844386, 0])):
        text += f'[[geometry.name]]\nname = "{name}"\npatch = {{ normal = {normal} }}\n'
    return text + '[[periodic]]\nfrom = "start"\nto = "end"\nrotation = { axis = [0, 0, 1], angle = 30 }\n'


def pipe_case(size):
    """Along its axis, with layers on its wall."""
    text = f'geometry.file = "model.geo"\nsize.target = {size}\n'
    for name, sign in (("low", -1), ("high", 1)):
        text += f'[[geometry.name]]\nname = "{name}"\npatch = {{ normal = [0, 0, {sign}] }}\n'
    return text + '[[periodic]]\nfrom = "low"\nto = "high"\n[[layer]]\npatch = "*"\nfirst = 0.01\ncount = 4\n'


class PeriodicProblem(Problem):
    """Conduction where temperatures rise by one from side to side."""

    def __init__(self, file):
        super().__init__(file)
        lines = file.read_text(encoding="utf-8").splitlines()
        first = lines.index("$Nodes") + 2
        nodes = numpy.array([line.split()[1:] for line in lines[first : first + int(lines[first - 1])]], float)
        pairs, place = [], lines.index("$Periodic") + 2
        while lines[place] != "$EndPeriodic":  # Entities, "Affine …", how many, the pairs.
            count = int(lines[place + 2])
            pairs += [tuple(map(int, line.split())) for line in lines[place + 3 : place + 3 + count]]
            place += 3 + count
        _, dof_of_node = cKDTree(self.points().T).query(nodes)
        graph = coo_matrix((numpy.ones(len(pairs)), numpy.array(pairs).T - 1), shape=(len(nodes),) * 2)
        _, orbit = connected_components(graph, directed=False)
        self.orbit = numpy.empty(len(nodes), int)
        self.orbit[dof_of_node] = orbit

    def conductivity(self, of_materials):
        """The mean over the directions of what flows along each."""
        num_dofs = len(self.orbit)
        joined = csc_matrix((numpy.ones(num_dofs), (numpy.arange(num_dofs), self.orbit)))
        stiffness = csc_matrix((num_dofs, num_dofs))
        for name, k in of_materials.items():
            part = getfem.asm_generic(
                self.integration, 2, f"{k}*Grad_u.Grad_Test_u", self.tags[3][name], "u", 1, self.temperatures, numpy.zeros(num_dofs)
            )
            begins, rows = part.csc_ind()
            stiffness += csc_matrix((part.csc_val(), rows, begins), shape=(num_dofs, num_dofs))
        of_orbits, flows = (joined.T @ stiffness @ joined).tocsr(), []
        for along in self.points():  # A linear field, and what is periodic beside it.
            beside, left = cg(of_orbits, -joined.T @ (stiffness @ along), M=diags(1.0 / of_orbits.diagonal()), atol=0.0)
            assert left == 0
            field = along + joined @ beside
            flows.append(field @ (stiffness @ field))  # Its error is the square of that of the field.
        return float(numpy.mean(flows))


class Periodic(unittest.TestCase):
    def openfoam(self, mesh):
        """Its folders: in one mesh, and in parts."""
        return [mesh.convert(name) for name in ("openfoam-serial", "openfoam")]

    def run_in(self, folder, *command):
        parts = len(list(folder.glob("processor*")))
        if parts == 0:
            return run(command, folder=folder, env=OPENFOAM)
        return mpirun(parts, [*command, "-parallel"], folder=folder, env=OPENFOAM)

    def cases(self, folder):
        return [Case(part) for part in sorted(folder.glob("processor*"))] or [Case(folder)]

    def test_check_mesh(self):
        """In three directions, around an axis, and with layers; in one mesh and in parts."""
        for mesh, num_patches in (
            (made_of(balls_model(), balls_case("size.target = 0.1"), parts=PARTS), 6),
            (made_of(wheel_model(1), wheel_case(1, 0.048), parts=PARTS), 2),
            (made_of(PIPE, pipe_case(0.1), parts=PARTS), 2),
        ):
            self.addCleanup(mesh.remove)
            num_through = 0
            for folder in self.openfoam(mesh):
                for part in self.cases(folder):
                    kinds = [patch[0] for patch in part.patches.values()]
                    self.assertEqual(kinds.count("cyclic"), num_patches)
                    num_through += kinds.count("processorCyclic")
                out = self.run_in(folder, "checkMesh", "-allGeometry", "-allTopology")
                self.assertEqual(re.findall(r"\*\*\*(.*)", out), [])
                self.assertIn("Mesh OK.", out)
                average = re.search(r"Coupled point location match \(average (\S+)\) OK", out)
                self.assertLess(float(average.group(1)), 1e-12)
            self.assertGreater(num_through, 0)

    def test_faces_are_partners(self):
        """In one mesh: face by face and corner by corner, but seen from the other side."""
        mesh = made_of(balls_model(), balls_case("size.target = 0.15"), parts=PARTS)
        self.addCleanup(mesh.remove)
        part = Case(mesh.convert("openfoam-serial"))
        for axis, pair in enumerate(PAIRS):
            low, high = (part.points[part.faces[slice(*part.patches[name][1:3])]] for name in pair)
            shift = numpy.eye(3)[axis]
            numpy.testing.assert_allclose(low + shift, high[:, [0, 2, 1]], rtol=0.0, atol=1e-14)

    def test_hdf5_has_pairs_of_points(self):
        """All points of a patch, each where the image of its partner is."""
        mesh = made_of(wheel_model(1), wheel_case(1, 0.1), parts=PARTS)
        self.addCleanup(mesh.remove)
        with h5py.File(mesh.convert("xdmf") / "mesh.h5") as file:
            points, patch = file["geometry/vertices"][:], file["boundary/patch"][:].ravel()
            triangles = file["boundary/triangles"][:]
            self.assertEqual(list(file["periodic"]), ["1"])
            pairs, there = file["periodic/1/points"], file["periodic/1/transform"][:]
            for column, side in enumerate(("to_patch", "from_patch")):
                expected = numpy.unique(triangles[patch == pairs.attrs[side]])
                numpy.testing.assert_array_equal(numpy.sort(pairs[:, column]), expected)
            images = points[pairs[:, 1]] @ there[:, :3].T + there[:, 3]
            numpy.testing.assert_allclose(points[pairs[:, 0]], images, rtol=0.0, atol=1e-14)

    def heat(self, folder):
        """The mean temperature of a wheel that is heated all over and cooled at its hub."""
        for name, text in (SYSTEM | SOURCE).items():
            (folder / "system" / name).write_text(with_head("dictionary", name, text))
        (folder / "constant").mkdir(exist_ok=True)
        (folder / "constant/transportProperties").write_text(
            with_head("dictionary", "transportProperties", "DT DT [0 2 -1 0 0 0 0] 1;\n")
        )
        for part in self.cases(folder):
            part.write_field(lambda name: "type fixedValue; value uniform 0;" if name == "hub" else "type zeroGradient;")
        self.run_in(folder, "laplacianFoam")
        heats, volumes = [], []
        for part in self.cases(folder):
            volume = part.cell_volumes()
            heats.append((volume * part.temperatures()).sum())
            volumes.append(volume.sum())
        return sum(heats) / sum(volumes)

    def test_a_sector_is_as_warm_as_the_wheel(self):
        size = 0.065
        sector, wheel = (made_of(wheel_model(num), wheel_case(num, size), parts=PARTS) for num in (1, NUM_SECTORS))
        insulated = made_of(wheel_model(1), wheel_case(1, size).split("[[periodic]]")[0], parts=PARTS)
        for mesh in (sector, wheel, insulated):
            self.addCleanup(mesh.remove)
        serial, parts = (self.heat(folder) for folder in self.openfoam(sector))
        whole = self.heat(wheel.convert("openfoam"))
        wrong = self.heat(insulated.convert("openfoam-serial"))
        print(f"mean temperature: wheel {whole:.6f}, sector {serial:.6f}, in parts {parts:.6f}, insulated {wrong:.6f}")
        self.assertAlmostEqual(parts / serial, 1.0, delta=1e-6)
        self.assertLess(abs(serial / whole - 1.0), 0.005)
        self.assertGreater(abs(wrong / whole - 1.0), 4.0 * abs(serial / whole - 1.0))

    def test_a_packing_conducts_as_maxwell_says(self):
        """Twelve balls that conduct ten times as well: a tenth of the volume, so that they hardly know of each other."""
        getfem.util_trace_level(0)
        found = []
        for levels in (0, 1, 2):
            case = balls_case(f"coarse.max_size = 0.22\nrefine.levels = {levels}")
            mesh = made_of(balls_model(), case, parts=PARTS)
            self.addCleanup(mesh.remove)
            problem = PeriodicProblem(mesh.convert("msh2") / "mesh_v2.msh")
            found.append(problem.conductivity({"matrix": 1.0, "grains": 10.0}))
        share = NUM_BALLS * 4.0 / 3.0 * math.pi * RADIUS**3
        maxwell = (12.0 + 2.0 * share * 9.0) / (12.0 - share * 9.0)
        print("conductivity:", ", ".join(f"{k:.5f}" for k in found), f"Maxwell {maxwell:.5f}")
        self.assertLess(abs(found[2] - found[1]), 0.5 * abs(found[1] - found[0]))
        self.assertLess(abs(found[2] / maxwell - 1.0), 0.015)


if __name__ == "__main__":
    solver_meshes.main()

# SPDX-License-Identifier: BSD-3-Clause
"""A mesh that the user brings as the coarse mesh, with its CAD model and without; and Gmsh as the coarse mesher."""
import json
import math
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

import program
from program import CONFIGS, FAILED, NO_PAGE, OK, WRONG_INPUT, sets

HEAD = 'SetFactory("OpenCASCADE");\n'

# name -> (Gmsh's script, volume). Each script makes one model and its mesh.
MODELS = {
    "ball": (
        'Sphere(1) = {0, 0, 0, 1};\nPhysical Volume("core", 7) = {1};\n'
        'Physical Surface("skin", 3) = {1};\nMesh.MeshSizeMax = 0.6;\n',
        4 / 3 * math.pi,
    ),
    "cylinder": (
        'Cylinder(1) = {0, 0, 0, 0, 0, 2, 1};\nPhysical Volume("rod", 7) = {1};\n'
        'Physical Surface("mantle", 3) = {1};\nPhysical Surface("ends", 4) = {2, 3};\nMesh.MeshSizeMax = 0.7;\n',
        2 * math.pi,
    ),
    "torus": ("Torus(1) = {0, 0, 0, 2, 0.7};\nMesh.MeshSizeMax = 0.6;\n", 2 * math.pi**2 * 2 * 0.7**2),
    "holed": (
        "Box(1) = {0, 0, 0, 3, 2, 1};\nCylinder(2) = {1, 1, 0, 0, 0, 1, 0.5};\n"
        "BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\nMesh.MeshSizeMax = 0.5;\n",
        6 - math.pi / 4,
    ),
    # A rod through a block, and a block beside it: three materials.
    "three": (
        "Box(1) = {0, 0, 0, 1, 1, 1};\nCylinder(2) = {0.5, 0.5, 0, 0, 0, 1, 0.25};\nBox(3) = {1, 0, 0, 0.5, 1, 1};\n"
        "BooleanFragments{ Volume{1, 2, 3}; Delete; }{}\n"
        'Physical Volume("rod", 10) = {2};\nPhysical Volume("side", 11) = {3};\nPhysical Volume("block", 12) = {4};\n'
        'Physical Surface("mantle", 5) = Surface In BoundingBox{0.2, 0.2, -0.01, 0.8, 0.8, 1.01};\n'
        "Mesh.MeshSizeMax = 0.35;\n",
        1.5,
    ),
}
SUBDIVIDE = "fill.kernel=subdivide"


def gmsh(folder, *arguments):
    subprocess.run(["gmsh", "-v", "1", "-nt", "1", *arguments], cwd=folder, check=True, timeout=program.HANG_S)


def report_of(folder):
    return json.loads((folder / "report.json").read_text())


def setUpModule():
    """Makes the models and their meshes, for all tests."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="tessera_e2e_"))
    unittest.addModuleCleanup(shutil.rmtree, folder)
    OwnMeshTest.models = folder
    for name, (script, _) in MODELS.items():
        (folder / f"{name}.geo").write_text(HEAD + script)
        (folder / f"{name}_brep.geo").write_text(f'{HEAD}{script}Save "{name}.brep";\n')
        gmsh(folder, "-0", f"{name}_brep.geo")
        gmsh(folder, "-3", "-format", "msh41", f"{name}.geo", "-o", f"{name}.msh")


class OwnMeshTest(program.ProgramTest):
    def case(self, mesh, cad=None, levels=1, more=""):
        cad_line = f"geometry.cad = '{cad}'\n" if cad else ""
        return self.write("case.toml", f"geometry.file = '{mesh}'\n{cad_line}refine.levels = {levels}\n{NO_PAGE}{more}")

    def of_model(self, name, **options):
        return self.case(self.models / f"{name}.msh", self.models / f"{name}.brep", **options)


class WithItsCadModel(OwnMeshTest):
    def test_the_volume_converges_with_the_square_of_the_size(self):
        for name, (_, volume) in MODELS.items():
            with self.subTest(name):
                errors = []
                for levels in (2, 3):
                    out = self.mesh(self.of_model(name, levels=levels), f"{name}_{levels}", *sets(SUBDIVIDE))
                    report = report_of(out)
                    self.assertLess(report["model_distance_max"], 1e-8)
                    errors.append(abs(report["volume"] - volume))
                self.assert_checked(out, 1e-9)
                if name == "three":  # Its outside is flat.
                    self.assertLess(errors[-1], 1e-12)
                    continue
                order = math.log2(errors[-2] / errors[-1])
                self.assertGreater(order, 1.9, errors)

    def test_has_the_same_bits_for_any_number_of_ranks(self):
        alone = self.mesh(self.of_model("three"), "one")
        for ranks in (2, 3):
            other = self.mesh(self.of_model("three"), f"ranks_{ranks}", ranks=ranks)
            self.assertEqual(program.mesh_files(other), program.mesh_files(alone))

    def test_names_of_materials_and_surfaces_are_kept(self):
        report = report_of(self.mesh(self.of_model("three"), "out", *sets(SUBDIVIDE)))
        self.assertEqual([one["name"] for one in report["materials"]], ["rod", "side", "block"])
        self.assertEqual(report["patch_names"].count("mantle"), 1)

    def test_tets_of_second_order_and_sizes_work(self):
        more = "output.order = 2\nsize.target = 0.3\n"
        out = self.mesh(self.case(self.models / "ball.msh", self.models / "ball.brep", levels=2, more=more), "out")
        report = self.assert_checked(out, 1e-9)[0]
        self.assertAlmostEqual(report["volume"], MODELS["ball"][1], delta=2e-3)

    def test_csg_is_a_cad_model_too(self):
        self.write("ball.geo", program.BALL)
        out = self.mesh(self.case(self.models / "ball.msh", "ball.geo", levels=2), "out", *sets(SUBDIVIDE), ranks=2)
        report = self.assert_checked(out, 1e-9)[0]
        self.assertLess(report["model_distance_max"], 1e-8)
        self.assertEqual(report["patch_names"], ["skin"])

    def test_an_stl_file_is_a_cad_model_too(self):
        plate = CONFIGS / "geometry" / "plate_with_hole.stl"
        case = self.write("plate.toml", f"geometry.file = '{plate}'\ncoarse.max_size = 20\nrefine.levels = 0\n{NO_PAGE}")
        coarse = self.mesh(case, "coarse", *sets(SUBDIVIDE))
        converted = self.run_program("convert", coarse / "mesh.pvtu", "--format", "msh", "--output", "msh")
        self.assertEqual(converted.code, OK, converted.err)
        out = self.mesh(self.case("msh/mesh.msh", plate, levels=2), "out", ranks=2)
        report = self.assert_checked(out, 1e-9)[0]
        self.assertLess(report["model_distance_max"], 1e-6)

    def test_it_may_be_optimized_and_its_pieces_split(self):
        more = "fill.kernel = 'optimize'\nfill.levels = 1\ncoarse.optimize = true\n"
        out = self.mesh(self.of_model("ball", levels=3, more=more), "out", ranks=2)
        report = self.assert_checked(out, 1e-9)[0]
        self.assertAlmostEqual(report["volume"], MODELS["ball"][1], delta=2e-3 * MODELS["ball"][1])

    def test_a_mesh_of_another_model_is_refused_with_the_place(self):
        case = self.case(self.models / "ball.msh", self.models / "torus.brep")
        self.assert_refused(
            self.run_program("mesh", case, "--output", "out", ranks=2),
            WRONG_INPUT, "ball.msh: does not fit the CAD model: the boundary vertex at (", "the largest distance",
        )  # fmt: skip
        # Half of it is missing.
        self.write("half.geo", f"{HEAD}Box(1) = {{0, 0, 0, 1.5, 2, 1}};\nMesh.MeshSizeMax = 0.5;\n")
        gmsh(self.folder, "-3", "half.geo", "-o", "half.msh")
        self.write("box.geo", f'{HEAD}Box(1) = {{0, 0, 0, 3, 2, 1}};\nSave "box.brep";\n')
        gmsh(self.folder, "-0", "box.geo")
        outcome = self.run_program("mesh", self.case("half.msh", "box.brep"), "--output", "half")
        self.assert_refused(outcome, WRONG_INPUT, "half.msh: does not fit the CAD model")

    def test_a_run_is_resumed_with_the_same_files_only(self):
        shutil.copy(self.models / "ball.msh", self.folder)
        case = self.case("ball.msh", self.models / "ball.brep")
        self.mesh(case, "out")
        again = self.run_program("mesh", case, "--output", "out", "--resume")
        self.assertEqual(again.code, OK, again.err)
        text = (self.folder / "ball.msh").read_text()
        self.write("ball.msh", text.replace('"core"', '"kern"'))
        self.assertEqual(self.run_program("mesh", case, "--output", "out", "--resume").code, WRONG_INPUT)


class WithoutCadModel(OwnMeshTest):
    def test_the_surface_is_refined_as_it_is(self):
        for name in MODELS:
            with self.subTest(name):
                coarse = self.mesh(self.case(self.models / f"{name}.msh", levels=0), f"{name}_0", *sets(SUBDIVIDE))
                kernel, ranks = ("fill.kernel=netgen", 3) if name == "ball" else (SUBDIVIDE, None)
                case = self.case(self.models / f"{name}.msh", levels=2)
                fine = self.mesh(case, f"{name}_2", *sets(kernel), ranks=ranks)
                report = self.assert_checked(fine, 1e-9)[0]
                self.assertAlmostEqual(report["volume"], report_of(coarse)["volume"], places=9)

    def test_a_smooth_surface_is_much_nearer_to_what_was_meant(self):
        for name, gain in (("ball", 20), ("cylinder", 20), ("torus", 5)):
            with self.subTest(name):
                errors = []
                for smooth, levels in (("false", 0), ("true", 3)):  # Without, levels do not change the surface.
                    more = f"geometry.smooth = {smooth}\ncoarse.feature_angle_deg = 50\n"
                    case = self.case(self.models / f"{name}.msh", levels=levels, more=more)
                    out = self.mesh(case, f"{name}_{smooth}", *sets(SUBDIVIDE), ranks=2 if name == "torus" else None)
                    errors.append(abs(report_of(out)["volume"] - MODELS[name][1]))
                self.assert_checked(out, 1e-9)
                self.assertLess(gain * errors[1], errors[0])

    def test_a_smooth_mesh_has_the_same_bits_for_any_number_of_ranks(self):
        case = self.case(self.models / "ball.msh", more="geometry.smooth = true\n")
        alone = self.mesh(case, "one")
        self.assertEqual(program.mesh_files(self.mesh(case, "three", ranks=3)), program.mesh_files(alone))

    def test_info_and_a_size_work_without_a_case(self):
        info = self.run_program("info", self.models / "three.msh")
        self.assertEqual(info.code, OK, info.err)
        self.assertRegex(info.out, r"1  rod +volume 0.18")
        self.mesh(self.models / "three.msh", "out", "--size", 0.1, ranks=2)
        self.assert_checked(self.folder / "out", 1e-9)

    def test_parts_get_names(self):
        more = "[[geometry.name]]\nname = 'foot'\npatch.normal = [0, 0, -1]\n"
        report = report_of(self.mesh(self.case(self.models / "three.msh", more=more), "out", *sets(SUBDIVIDE)))
        self.assertEqual(report["patch_names"].count("foot"), 1)
        self.assertEqual(report["patch_names"].count("mantle"), 1)

    def test_a_dry_run_predicts(self):
        outcome = self.run_program("mesh", self.case(self.models / "ball.msh"), "--dry-run")
        self.assertEqual(outcome.code, OK, outcome.err)

    def test_a_vtu_of_our_own_is_a_coarse_mesh(self):
        first = self.mesh(self.case(self.models / "three.msh", levels=0), "first", *sets(SUBDIVIDE))
        piece = next((first / "mesh").glob("*.vtu"))
        out = self.mesh(self.case(piece), "out", *sets(SUBDIVIDE))
        self.assert_checked(out, 1e-9)


class ABrokenMesh(OwnMeshTest):
    def refused(self, name, text, *words):
        self.write(name, text)
        self.assert_refused(
            self.run_program("mesh", self.case(name), "--output", f"out_{name}"), WRONG_INPUT, name, *words
        )
        self.assertFalse((self.folder / f"out_{name}" / "mesh.pvtu").exists())

    def test_is_refused_with_the_place(self):
        good = (self.models / "ball.msh").read_text()
        self.refused("cut.msh", good[: len(good) // 2], "truncated")
        self.refused("text.msh", "this is no mesh\n", "does not begin with $MeshFormat")
        self.refused("empty.msh", "", "is empty")
        tet = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0.3 0.3 {}\n$EndNodes\n"
        tet += "$Elements\n{}$EndElements\n"
        one = "1\n17 4 2 1 1 1 2 3 4\n"
        self.refused("flat.msh", tet.format(0, one), "tet 17 at (0.325, 0.325, 0) is flat")
        self.refused("nan.msh", tet.format("nan", one), ":9: a coordinate is not a finite number")
        self.refused("none.msh", tet.format(1, "0\n"), "it has no tets")
        self.refused("hex.msh", tet.format(1, "1\n3 5 2 1 1 1 2 3 4 1 2 3 4\n"), "the mesh has hexahedra")

    def test_keys_that_need_something_else_are_refused(self):
        ball = self.models / "ball.msh"
        for text, word in (
            (f"geometry.file = '{ball}'\ncoarse.max_size = 1.0\n", "coarse.max_size is for a CAD model"),
            (f"geometry.file = '{ball}'\ncoarse.mesher = 'gmsh'\n", "is the coarse mesh"),
            ("geometry.file = 'a.step'\ngeometry.cad = 'b.step'\ncoarse.max_size = 1\n", "geometry.cad is for a mesh"),
            (f"geometry.file = '{ball}'\ngeometry.cad = 'b.step'\ngeometry.smooth = true\n", "excludes"),
            (f"geometry.file = '{ball}'\ngeometry.cad = 'no.step'\n", "no such file"),
        ):
            outcome = self.run_program("mesh", self.write("case.toml", text), "--output", "out")
            self.assert_refused(outcome, WRONG_INPUT, word)


class Gmsh(OwnMeshTest):
    def gmsh_case(self, model, max_size, more=""):
        return self.write(
            "case.toml",
            f"geometry.file = '{model}'\ncoarse.max_size = {max_size}\ncoarse.mesher = 'gmsh'\nrefine.levels = 1\n{NO_PAGE}{more}",
        )

    def fake_gmsh(self, commands):
        self.write("gmsh", f"#!/bin/sh\n{commands}\n").chmod(0o755)

    def test_makes_the_coarse_mesh_of_a_cad_model(self):
        for name, size in (("bracket.step", 10.0), ("two_blocks.step", 5.0), ("frustum.iges", 0.5)):
            with self.subTest(name):
                model = CONFIGS / "geometry" / name
                alone = self.mesh(self.gmsh_case(model, size), f"{name}_1", *sets(SUBDIVIDE))
                report = self.assert_checked(alone, 1e-9)[0]
                self.assertLess(report["model_distance_max"], 1e-6)
        three = self.mesh(self.gmsh_case(model, size), "on_3", *sets(SUBDIVIDE), ranks=3)
        self.assertEqual(program.mesh_files(three), program.mesh_files(alone))

    def test_is_refused_where_it_is_not_installed_or_cannot_help(self):
        bracket = CONFIGS / "geometry" / "bracket.step"
        self.fake_gmsh("exit 127")  # What stands for a program that is not there.
        without = {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}
        case = self.gmsh_case(bracket, 10.0)
        outcome = self.run_program("mesh", case, "--output", "out", env=without)
        self.assert_refused(outcome, WRONG_INPUT, "install it", 'coarse.mesher = "netgen"')
        self.write("ball.geo", program.BALL)
        outcome = self.run_program("mesh", self.gmsh_case("ball.geo", 1.0), "--output", "ball")
        self.assert_refused(outcome, WRONG_INPUT, "is for .step, .iges and .brep")

    def test_that_fails_is_quoted(self):
        self.fake_gmsh("echo 'Error   : no luck today'\nexit 1")
        with_fake = {**os.environ, "PATH": f"{self.folder}:{os.environ['PATH']}"}
        case = self.gmsh_case(CONFIGS / "geometry" / "bracket.step", 10.0)
        outcome = self.run_program("mesh", case, "--output", "out", env=with_fake)
        self.assertEqual(outcome.code, FAILED, outcome.err)
        self.assertIn("no luck today", outcome.err)


if __name__ == "__main__":
    unittest.main()

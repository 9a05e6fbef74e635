# SPDX-License-Identifier: BSD-3-Clause
"""The Python package: runs the program, reads its meshes, and shows them. What needs solvers is in tests/solvers."""
import contextlib
import gc
import io
import itertools
import os
import pathlib
import re
import signal
import struct
import subprocess
import sys
import tempfile
import unittest
import unittest.mock
import warnings
import zlib

import numpy as np
import program

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "src" / "python"
sys.path.insert(0, str(PACKAGE))
os.environ["TESSERA"] = program.PROGRAM

import tessera  # noqa: E402  From the sources.

EXAMPLE = pathlib.Path(__file__).resolve().parents[1] / "examples" / "python" / "part.py"
# One fill sleeps, so that no run ends before it is interrupted.
INTERRUPTED = (
    "import os, sys, tessera\n"
    "os.environ['TESSERA_TEST_FAULT'] = 'fill=sleep@7'\n"
    "tessera.mesh(sys.argv[1], output='out', ranks=int(sys.argv[2]))\n"
)


def volumes(mesh):
    a, b, c, d = (mesh.points[mesh.cells[:, i]] for i in range(4))
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6.0


def pixels(png):
    """Of a PNG of three bytes a pixel whose lines have no filter."""
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    at, parts = 8, {}
    while at < len(png):
        (length,) = struct.unpack(">I", png[at : at + 4])
        kind, content = png[at + 4 : at + 8], png[at + 8 : at + 8 + length]
        assert struct.unpack(">I", png[at + 8 + length : at + 12 + length])[0] == zlib.crc32(kind + content)
        parts[kind] = content
        at += 12 + length
    width, height = struct.unpack(">II", parts[b"IHDR"][:8])
    lines = np.frombuffer(zlib.decompress(parts[b"IDAT"]), np.uint8).reshape(height, 1 + 3 * width)
    assert not lines[:, 0].any()
    return lines[:, 1:].reshape(height, width, 3)


class Package(program.ProgramTest):
    """Each test has one small mesh of two materials."""

    @classmethod
    def setUpClass(cls):
        cls.maker = cls.make_maker()
        model = cls.maker.write("two.geo", program.TWO_MATERIALS)
        with contextlib.redirect_stdout(io.StringIO()) as cls.shown:
            cls.mesh_of_two = tessera.mesh(
                model, 0.5, parts=3, ranks=2, kernel="subdivide", output=cls.maker.folder / "out"
            )

    def test_arrays_have_the_sums_of_the_report(self):
        mesh = self.mesh_of_two
        self.assertEqual(mesh.report["num_tets"], len(mesh.cells))
        self.assertEqual(mesh.report["num_vertices"], len(mesh.points))
        self.assertEqual(mesh.num_global_points, len(mesh.points))
        self.assertEqual(mesh.num_global_cells, len(mesh.cells))
        volume = volumes(mesh)
        self.assertGreater(volume.min(), 0.0)
        self.assertAlmostEqual(volume.sum() / mesh.report["volume"], 1.0, delta=1e-12)
        self.assertEqual(mesh.names.materials, ["core", "shell"])
        self.assertEqual(sorted(set(mesh.materials)), [1, 2])
        # The core is a ball of radius 1 in one of radius 2.
        self.assertLess(abs(volume[mesh.materials == mesh.material_tags("core")[0]].sum() / (4 / 3 * np.pi) - 1), 0.2)
        self.assertEqual(sorted(set(mesh.subdomains)), list(range(mesh.report["num_subdomains"])))
        np.testing.assert_array_equal(mesh.point_ids, np.arange(len(mesh.points)))
        np.testing.assert_array_equal(np.sort(mesh.cell_ids), np.arange(len(mesh.cells)))
        self.assertEqual((set(mesh.owner), set(mesh.cell_ranks), mesh.num_ghost_cells), ({0}, {0}, 0))
        self.assertEqual((len(mesh.sharers), len(mesh.sharers[0])), (len(mesh.points), 0))
        self.assertEqual(mesh.num_owned_points, len(mesh.points))

    def test_triangles_are_faces_seen_from_outside(self):
        mesh = self.mesh_of_two
        behind = mesh.cells[mesh.triangle_cells]
        on_tet = (mesh.triangles[:, :, None] == behind[:, None, :]).any(axis=2)
        self.assertTrue(on_tet.all())
        a, b, c = (mesh.points[mesh.triangles[:, i]] for i in range(3))
        normal = np.cross(b - a, c - a)
        outwards = np.einsum("ij,ij->i", normal, a - mesh.points[behind].mean(axis=1))
        self.assertTrue((outwards > 0.0).all())
        radius = np.linalg.norm(a, axis=1)
        outer = radius > 1.5
        area = 0.5 * np.linalg.norm(normal, axis=1)
        self.assertAlmostEqual(area[outer].sum() / mesh.report["boundary_area"], 1.0, delta=1e-12)
        self.assertEqual(len(set(mesh.patches[outer]) & set(mesh.patches[~outer])), 0)
        self.assertLess(mesh.patches.max(), len(mesh.names.patches))
        self.assertEqual(mesh.num_global_triangles, len(mesh.triangles))

    def test_progress_is_plain_lines_where_there_is_no_terminal(self):
        shown = self.shown.getvalue()
        self.assertRegex(shown, r"(?m)^fill ")
        self.assertNotIn("\x1b", shown)
        with contextlib.redirect_stdout(io.StringIO()) as shown:
            tessera.mesh(self.write_case(), quiet=True)
        self.assertEqual(shown.getvalue(), "")

    def test_read_takes_folder_index_and_piece(self):
        whole = self.mesh_of_two
        for what in (whole.folder, whole.folder / "mesh.pvtu", str(whole.folder)):
            mesh = tessera.read(what)
            for name in ("points", "cells", "cell_ids", "materials", "triangles", "patches", "triangle_cells"):
                np.testing.assert_array_equal(getattr(mesh, name), getattr(whole, name), name)
            self.assertEqual(mesh.report, whole.report)
        pieces = [tessera.read(file) for file in sorted((whole.folder / "mesh").iterdir())]
        self.assertEqual(len(pieces), 3)
        self.assertEqual(sum(len(piece.cells) for piece in pieces), len(whole.cells))
        for piece in pieces:
            np.testing.assert_array_equal(piece.points, whole.points[piece.point_ids])
            self.assertIsNone(piece.report)

    def test_numbers_can_be_made_consecutive(self):
        whole, mesh = self.mesh_of_two, tessera.read(self.mesh_of_two.folder, consecutive=True)
        np.testing.assert_array_equal(mesh.point_ids, np.arange(len(mesh.points)))
        np.testing.assert_array_equal(mesh.points[mesh.cells], whole.points[whole.cells])

    def test_what_is_damaged_is_an_input_error(self):
        out = program.shutil.copytree(self.mesh_of_two.folder, self.folder / "out")
        piece = sorted((out / "mesh").iterdir())[1]
        content = piece.read_bytes()
        for damage in (content[: len(content) // 2], b"", content.replace(b"GlobalIds", b"LocalIds_")):
            piece.write_bytes(damage)
            with self.assertRaises(tessera.InputError) as caught:
                tessera.read(out)
            self.assertEqual(caught.exception.exit_code, program.WRONG_INPUT)
            self.assertIn(piece.name, caught.exception.message)
        piece.unlink()
        for gone in (out, out / "boundary.pvtu", self.folder / "nowhere", self.folder / "no.pvtu"):
            with self.assertRaises(tessera.InputError):
                tessera.read(gone)

    def test_exceptions_carry_code_and_message(self):
        case = self.write_case()
        (self.folder / "full").mkdir()
        self.write("full/file", "")
        for error, code, words, call in (
            (tessera.InputError, 64, "nowhere.step", lambda: tessera.mesh(self.folder / "nowhere.step", 1)),
            (tessera.InputError, 64, "refine.level", lambda: tessera.mesh(case, keys={"refine.level": 1})),
            (tessera.InputError, 64, "--size", lambda: tessera.mesh(case, size=0.1, ranks=2)),
            (tessera.OutputError, 73, "full", lambda: tessera.mesh(case, output=self.folder / "full")),
        ):
            with contextlib.redirect_stdout(io.StringIO()), self.assertRaises(error) as caught:
                call()
            self.assertIsInstance(caught.exception, tessera.TesseraError)
            self.assertEqual(caught.exception.exit_code, code)
            self.assertIn(words, caught.exception.message)
            self.assertNotIn("mpirun", caught.exception.message)
        for wrong in (dict(ranks=0), dict(resume=True)):
            with self.assertRaises(ValueError):
                tessera.mesh(case, **wrong)

    def test_degraded_is_a_mesh_and_a_warning(self):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            mesh = tessera.mesh(self.write_case(), keys={"quality.min_mean_ratio": 0.99}, quiet=True, ranks=2)
        self.assertEqual([warning.category for warning in caught], [tessera.DegradedWarning])
        self.assertIn("mean ratio", str(caught[0].message))
        self.assertEqual(mesh.report["exit_code"], program.DEGRADED)
        self.assertGreater(len(mesh.cells), 0)

    def test_a_temporary_folder_lasts_as_long_as_the_mesh(self):
        place = self.folder / "temporary"
        place.mkdir()
        patched = unittest.mock.patch.object(tempfile, "tempdir", str(place))
        patched.start()
        self.addCleanup(patched.stop)
        mesh = tessera.mesh(self.write_case(), quiet=True)
        folder = mesh.folder
        self.assertEqual(folder.parent, place)
        self.assertTrue((folder / "mesh.pvtu").is_file())
        self.assertEqual(len(mesh.cells), mesh.report["num_tets"])
        del mesh
        gc.collect()
        self.assertFalse(folder.exists())
        with self.assertRaises(tessera.InputError):
            tessera.mesh(self.folder / "nowhere.step", 1)
        self.assertEqual([*place.iterdir()], [])

    def test_the_program_is_looked_for_and_the_error_says_where(self):
        def found(**changes):
            environment = {k: v for k, v in os.environ.items() if k not in ("TESSERA", "PATH", "PYTHONPATH")} | changes
            code = "import tessera; print(tessera.find_program())"
            environment.setdefault("PYTHONPATH", str(PACKAGE))
            return subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True)

        here = str(pathlib.Path(program.PROGRAM).parent)
        self.assertEqual(found(TESSERA=program.PROGRAM).stdout.strip(), program.PROGRAM)
        self.assertRegex(found(TESSERA="/nowhere/tessera").stderr, r"ProgramNotFound: TESSERA=/nowhere/tessera")
        # As installed: without the sources around it.
        installed = self.folder / "prefix/lib/python3/dist-packages"
        copy_package(installed)
        self.assertEqual(found(PATH=here, PYTHONPATH=str(installed)).stdout.strip(), f"{here}/tessera")
        (self.folder / "prefix/bin").mkdir()
        (self.folder / "prefix/bin/tessera").symlink_to(program.PROGRAM)
        beside = found(PATH=here, PYTHONPATH=str(installed)).stdout.strip()
        self.assertEqual(beside, str(self.folder / "prefix/bin/tessera"))
        (self.folder / "prefix/bin/tessera").unlink()
        nowhere = found(PATH="", PYTHONPATH=str(installed)).stderr
        self.assertRegex(nowhere, "(?s)ProgramNotFound.*pipeline/run.*TESSERA")

    def test_the_version_is_the_programs(self):
        said = self.run_program("--version").out.split()[1]
        self.assertEqual(tessera.__version__, said)

    def test_an_interrupted_run_leaves_no_process(self):
        case = self.write_case(subdomains=8)
        for ranks, number in itertools.product((1, 2), (signal.SIGINT, signal.SIGKILL)):
            with self.subTest(ranks=ranks, signal=number.name):
                process = self.start_command(
                    [sys.executable, "-c", INTERRUPTED, str(case), str(ranks)],
                    env={**os.environ, "PYTHONPATH": str(PACKAGE)},
                )
                started = program.wait_until(lambda: self.filling(process), "the fill begins")
                process.send_signal(number)
                outcome = self.finish(process)
                program.wait_until(lambda: not any(map(program.is_running, started)), "all processes end", within_s=20.0)
                if number == signal.SIGINT:
                    self.assertIn("KeyboardInterrupt", outcome.err)
                    self.assertFalse((self.folder / "out/mesh.pvtu").exists())
                    self.assertTrue((self.folder / "out/pieces").exists())
                program.shutil.rmtree(self.folder / "out")

    def test_a_stopped_run_goes_on(self):
        case = self.write_case(subdomains=8)
        code = (
            "import os, sys, tessera\n"
            "os.environ['TESSERA_TEST_FAULT'] = 'fill=sleep@7'\n"
            "try: tessera.mesh(sys.argv[1], output='out')\n"
            "except tessera.Interrupted as error: print('stopped with', error.exit_code)\n"
            "del os.environ['TESSERA_TEST_FAULT']\n"
            "print(tessera.mesh(sys.argv[1], output='out', resume=True, quiet=True).report['resumed'])\n"
        )
        process = self.start_command(
            [sys.executable, "-c", code, str(case)], env={**os.environ, "PYTHONPATH": str(PACKAGE)}
        )
        program.wait_until(lambda: self.filling(process), "the fill begins")
        os.kill(program.ranks_of(process)[0], signal.SIGTERM)
        outcome = self.finish(process)
        self.assertEqual(outcome.out.splitlines()[-2:], ["stopped with 75", "True"], outcome.err)

    def filling(self, process):
        """All processes below, once the fill has begun."""
        stage = self.folder / "out/log/run.log"
        started = stage.is_file() and re.search(r"^.*plan ", stage.read_text(), re.MULTILINE)
        return program.descendants(process.pid) if started else None

    def test_it_runs_where_mpi_has_started(self):
        code = (
            "from mpi4py import MPI\nimport sys, tessera\n"
            "if MPI.COMM_WORLD.rank == 0:\n"
            "    for ranks in (1, 2): print(len(tessera.mesh(sys.argv[1], ranks=ranks, quiet=True).cells))\n"
        )
        for command in ([sys.executable], [program.MPIEXEC, "-n", "2", sys.executable]):
            process = self.start_command(
                [*command, "-c", code, str(self.write_case())], env={**os.environ, "PYTHONPATH": str(PACKAGE)}
            )
            outcome = self.finish(process)
            self.assertEqual(outcome.code, 0, outcome.err)
            sizes = outcome.out.split()
            self.assertEqual((len(sizes), len(set(sizes))), (2, 1), outcome.out)

    def test_to_vtk_has_what_the_files_have(self):
        from vtkmodules.util.numpy_support import vtk_to_numpy

        mesh = self.mesh_of_two
        for boundary in (False, True):
            grid = mesh.to_vtk(boundary)
            cells = mesh.triangles if boundary else mesh.cells
            self.assertEqual(grid.GetNumberOfCells(), len(cells))
            found = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(cells.shape)
            np.testing.assert_array_equal(found, cells)
            np.testing.assert_array_equal(vtk_to_numpy(grid.GetPoints().GetData()), mesh.points)
            np.testing.assert_array_equal(vtk_to_numpy(grid.GetPointData().GetGlobalIds()), mesh.point_ids)
            name, values = ("patch", mesh.patches) if boundary else ("attribute", mesh.materials)
            np.testing.assert_array_equal(vtk_to_numpy(grid.GetCellData().GetArray(name)), values)
            names = grid.GetFieldData().GetAbstractArray("material_names")
            self.assertEqual([names.GetValue(i) for i in range(2)], mesh.names.materials)

    def test_what_is_missing_is_named_with_its_package(self):
        code = (
            "import sys, tessera\n"
            "mesh = tessera.read(sys.argv[1])\n"
            "for name in ('meshio', 'pyvista', 'petsc4py', 'dolfinx', 'vtkmodules.vtkIOXML'):\n"
            "    sys.modules[name] = None\n"
            "again = lambda: tessera.read(sys.argv[1])\n"
            "for call in (mesh.to_meshio, mesh.to_pyvista, mesh.to_petsc, mesh.to_dolfinx, again):\n"
            "    try: call()\n"
            "    except ImportError as error: print(error)\n"
        )
        done = subprocess.run(
            [sys.executable, "-c", code, str(self.mesh_of_two.folder)],
            env={**os.environ, "PYTHONPATH": str(PACKAGE)},
            capture_output=True,
            text=True,
        )
        said = done.stdout.splitlines()
        packages = ("python3-meshio", "pip install pyvista", "python3-petsc4py", "python3-dolfinx", "python3-vtk9")
        self.assertEqual(len(said), len(packages), done.stderr)
        for line, package in zip(said, packages):
            self.assertIn(package, line)

    def test_a_notebook_gets_a_picture(self):
        mesh = self.mesh_of_two
        image = pixels(mesh._repr_png_())
        self.assertEqual(image.shape, (500, 800, 3))
        drawn = (image != 255).any(axis=2)
        # A ball of a height of almost all 500 pixels, in the middle.
        self.assertAlmostEqual(drawn.sum() / (np.pi * 240**2), 1.0, delta=0.1)
        self.assertTrue(drawn[250, 400] and not drawn[5, 5])
        self.assertIn("data:image/png;base64,", mesh._repr_html_())
        self.assertEqual(pixels(mesh.picture(200, 100, "material")).shape, (100, 200, 3))
        self.assertTrue(mesh.picture(color="subdomain") != mesh.picture(), "subdomains have no colours")
        with self.assertRaises(ValueError):
            mesh.picture(color="blue")
        self.assertIsNone(tessera.Mesh(points=np.empty((0, 3)))._repr_png_())
        self.assertIsNone(tessera.Mesh()._repr_html_())

    def test_the_nearest_triangle_is_seen(self):
        # Two crossing triangles before the eye: of each the half is nearer.
        right, up, eye = tessera._picture._axes()
        corners = [-right - up - eye, right - up + eye, up, -right - up + eye, right - up - eye, up]
        mesh = tessera.Mesh(
            points=np.array(corners), triangles=np.array([[0, 1, 2], [3, 4, 5]]), patches=np.array([0, 1]),
            materials=np.array([1]), subdomains=np.array([0]), triangle_cells=np.array([0, 0]), comm=None,
        )  # fmt: skip
        image = pixels(mesh.picture(200, 200))
        colors = {tuple(image[190, x]) for x in (40, 60)}, {tuple(image[190, x]) for x in (140, 160)}
        self.assertEqual([len(side) for side in colors], [1, 1])
        self.assertNotEqual(*colors)

    def test_the_example_of_the_page_runs(self):
        process = self.start_command(
            [sys.executable, str(EXAMPLE), str(program.CONFIGS / "geometry/two_blocks.step")],
            env={**os.environ, "PYTHONPATH": str(PACKAGE)},
        )
        outcome = self.finish(process)
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertRegex(outcome.out, r"(?m)^\w+: volume [\d.]+")
        self.assertTrue((self.folder / "mesh.png").read_bytes().startswith(b"\x89PNG"))


def copy_package(folder):
    no_bytes = program.shutil.ignore_patterns("__pycache__")
    program.shutil.copytree(PACKAGE / "tessera", folder / "tessera", ignore=no_bytes)
    metadata = folder / f"tessera-{tessera.__version__}.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text(f"Metadata-Version: 2.1\nName: tessera\nVersion: {tessera.__version__}\n")


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: BSD-3-Clause
"""The view of pages, without a browser: what it shows is what the files have. tests/solvers/viewer_test.py turns it."""
import html
import json
import os
import pathlib
import re
import sys
import unittest
import unittest.mock

import numpy as np
import program
from program import OK, WRONG_INPUT
from viewer_page import ViewerPage, block_of

PACKAGE = pathlib.Path(__file__).resolve().parents[2] / "src" / "python"
sys.path.insert(0, str(PACKAGE))
os.environ["TESSERA"] = program.PROGRAM

import tessera  # noqa: E402  From the sources.

GEOMETRY = program.CONFIGS / "geometry"
THREE_JS = pathlib.Path("/usr/share/javascript/three/three.min.js")
MOST_BYTES = 8_000_000


def mean_ratios(corners):
    """12 (3 V)^(2/3) over the sum of the squares of the edges, of tets of shape (n, 4, 3)."""
    a, b, c, d = (corners[:, i] for i in range(4))
    volume = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6.0
    edges = sum(((corners[:, i] - corners[:, j]) ** 2).sum(axis=1) for i in range(4) for j in range(i))
    return 12.0 * np.cbrt(3.0 * volume) ** 2 / edges


class ViewTest(program.ProgramTest):
    def text(self, file):
        text = (self.folder / file).read_text(encoding="utf-8")
        self.assertLess(len(text), MOST_BYTES)
        self.assertNotRegex(text, r"https?:")
        self.assertNotRegex(text, r"<(script|img|link|iframe)[^>]*(src|href)=(?!\"data:)")
        self.assertIn("default-src 'none'", text)
        return text

    def page(self, file):
        return ViewerPage(self.text(file))

    def assert_shows(self, page, mesh):
        """Each triangle of the mesh, in the order of the files, with all that is told of it."""
        atol = 0.51 * max(page.data["step"])
        self.assertGreater(len(mesh.triangles), 100)
        np.testing.assert_allclose(page.points[page.corners], mesh.points[mesh.triangles[:, :3]], atol=atol)
        np.testing.assert_array_equal(page.arrays["face"], mesh.patches)
        np.testing.assert_array_equal(page.arrays["subdomain"], mesh.subdomains[mesh.triangle_cells])
        np.testing.assert_array_equal(page.arrays["material"], mesh.materials[mesh.triangle_cells] - 1)
        behind = mean_ratios(mesh.points[mesh.cells[mesh.triangle_cells, :4]])
        np.testing.assert_allclose(page.arrays["quality"] / 250.0, behind, atol=0.003)
        self.assertEqual(len(page.points), len(np.unique(mesh.point_ids[mesh.triangles[:, :3]])))


class Report(ViewTest):
    def test_report_shows_the_triangles_of_the_files(self):
        self.write("two.geo", program.TWO_MATERIALS)
        case = self.write_case(geometry="two.geo", max_size=1.2, page=True)
        views = []
        for ranks, folder in ((1, "one"), (3, "three")):
            self.mesh(case, folder, ranks=ranks)
            page = self.page(f"{folder}/report.html")
            self.assert_shows(page, tessera.read(self.folder / folder))
            views.append((block_of(page.text, "data"), block_of(page.text, "arrays")))
        self.assertEqual(views[0], views[1], "the view depends on the number of ranks")
        report = json.loads((self.folder / "one/report.json").read_text())
        self.assertEqual(page.data["worst"], report["quality"]["worst"])
        self.assertEqual([face["area"] for face in page.data["faces"][:-1]], [p["area"] for p in report["patches"]])
        self.assertEqual([face["numbers"] for face in page.data["faces"][:-1]], [p["faces"] for p in report["patches"]])
        self.assertFalse(page.data["is_coarse"])
        self.assertEqual(page.three_js(), THREE_JS.read_bytes())
        self.assertEqual([c["array"] for c in page.data["colourings"]], ["face", "subdomain", "material", "quality"])

    def test_second_order_is_drawn_by_four_triangles_a_face(self):
        self.mesh(self.write_case(page=True), "out", "--set", "output.order=2")
        page, mesh = self.page("out/report.html"), tessera.read(self.folder / "out")
        self.assertEqual(len(page.corners), 4 * len(mesh.triangles))
        drawn = np.linalg.norm(page.points, axis=1)
        np.testing.assert_allclose(drawn, 1.0, atol=1e-3)  # All nodes are on the ball.

    def test_part_of_a_mesh_is_shown_closed_by_coarse_triangles(self):
        self.mesh(self.write_case(page=True), "part", "--set", "fill.kernel=subdivide", "--only-subdomains", "1,2")
        page = self.page("part/report.html")
        self.assertTrue(page.data["is_coarse"])
        self.assertEqual(set(page.arrays["subdomain"]), {1, 2})
        edges = np.sort(np.concatenate([page.corners[:, [i, (i + 1) % 3]] for i in range(3)]), axis=1)
        _, counts = np.unique(edges, axis=0, return_counts=True)
        self.assertTrue((counts % 2 == 0).all(), "the surface is open")
        self.assertEqual(page.data["faces"][page.arrays["face"].max()]["name"], "not made")

    def test_names_cannot_change_the_page(self):
        self.write_case("case.toml", page=True)
        name = "</script><script>alert(1)</script>&\"ü"
        case = self.write(
            "named.toml",
            (self.folder / "case.toml").read_text()
            + f"[[geometry.name]]\nname = '{name}'\npatch = {{ faces = [1] }}\n",
        )
        self.mesh(case, "out", "--set", "fill.kernel=subdivide")
        page = self.page("out/report.html")
        self.assertEqual(page.data["faces"][0]["name"], name)
        self.assertEqual(page.text.count("<script"), 4)

    def test_without_three_js_there_are_pictures_alone(self):
        env = os.environ | {"TESSERA_THREE_JS": str(self.folder / "none.js")}
        self.mesh(self.write_case(page=True), "out", env=env)
        text = self.text("out/report.html")
        self.assertNotIn("<script", text)
        self.assertIn("picture-subdomains", text)
        for words in ("libjs-three", "none.js", "TESSERA_THREE_JS"):
            self.assertIn(words, text)


class Model(ViewTest):
    def model(self, name, *arguments, **options):
        outcome = self.run_program("info", GEOMETRY / name, "--html", "page.html", *arguments, **options)
        self.assertEqual(outcome.code, OK, outcome.err)
        return self.page("page.html"), outcome.out

    def test_page_says_what_json_says(self):
        for name in ("two_blocks.step", "core.geo", "plate_with_hole.stl", "frustum.iges", "cone.brep"):
            with self.subTest(model=name):
                page, out = self.model(name, "--json")
                told = json.loads(out)
                self.assertEqual([f["numbers"] for f in page.data["faces"]], [[f["number"]] for f in told["faces"]])
                self.assertEqual([f["solids"] for f in page.data["faces"]], [f["solids"] for f in told["faces"]])
                self.assertEqual(
                    [(e["number"], e["length"]) for e in page.data["edges"]],
                    [(e["number"], e["length"]) for e in told["edges"]],
                )
                self.assert_areas(page, told)
                self.assert_edges(page, told)
                self.assert_sizes(page, told)

    def assert_areas(self, page, told):
        a, b, c = (page.points[page.corners[:, i]] for i in range(3))
        areas = np.bincount(page.arrays["face"], 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1))
        np.testing.assert_allclose(areas, [f["area"] for f in told["faces"]], rtol=0.02)

    def assert_edges(self, page, told):
        """Lines as long as the edge, in its box, on its faces; and faces touch both ways."""
        lines = page.places("line_x", "line_y", "line_z").reshape(-1, 2, 3)
        self.assertEqual(sum(e["num_lines"] for e in page.data["edges"]), len(lines))
        begin, atol = 0, 2 * max(page.data["step"])
        for edge, of_json in zip(page.data["edges"], told["edges"]):
            mine = lines[begin : begin + edge["num_lines"]]
            begin += edge["num_lines"]
            length = np.linalg.norm(mine[:, 1] - mine[:, 0], axis=1).sum()
            self.assertAlmostEqual(length / edge["length"], 1.0, delta=0.05)
            self.assertTrue((mine >= np.array(of_json["box"]["low"]) - atol).all())
            self.assertTrue((mine <= np.array(of_json["box"]["high"]) + atol).all())
            self.assertIn(len(edge["faces"]), (1, 2, 3, 4))
            for face in edge["faces"]:
                on_face = page.points[page.corners[page.arrays["face"] == face]].reshape(-1, 3)
                distance = np.linalg.norm(on_face - mine[0, 0], axis=1).min()
                self.assertLess(distance, 4 * atol)
        for row, face in enumerate(page.data["faces"]):
            for other in face["touches"]:
                self.assertIn(row, page.data["faces"][other]["touches"])

    def assert_sizes(self, page, told):
        """The formula of the slider predicts what info says."""
        sizes = page.data["sizes"]
        for suggested in told["sizes"]:
            size = suggested["size"]
            thinness = sizes["area"] * size / sizes["volume"]
            tets = (sizes["per_cube"] + sizes["per_thinness"] * thinness**2) * sizes["volume"] / size**3
            self.assertAlmostEqual(tets / suggested["num_tets"], 1.0, delta=1e-9)
            self.assertLess(sizes["low"], size)
            self.assertGreater(sizes["high"], size)

    def test_faces_between_solids_and_what_touches(self):
        page, _ = self.model("two_blocks.step", ranks=2)
        between = [f for f in page.data["faces"] if len(f["solids"]) == 2]
        self.assertEqual(len(between), 1)
        # Four sides of the smaller block, and what is left around it of a side of the larger one.
        self.assertEqual(len(between[0]["touches"]), 5)
        self.assertEqual([s["name"] for s in page.data["solids"]], ["steel", "copper"])

    def test_page_of_a_case_is_refused(self):
        case = self.write_case()
        outcome = self.run_program("info", case, "--html", "page.html")
        self.assert_refused(outcome, WRONG_INPUT, "--html")
        self.assertFalse((self.folder / "page.html").exists())


class MeshPage(ViewTest):
    def test_page_of_a_mesh_and_show(self):
        self.write("two.geo", program.TWO_MATERIALS)
        folder = self.mesh(self.write_case(geometry="two.geo", max_size=1.2, page=True), "out")
        mesh = tessera.read(folder)
        outcome = self.run_program("info", folder / "mesh.pvtu", "--html", "mesh.html", ranks=2)
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertIn("mesh: ", outcome.out)
        page = self.page("mesh.html")
        self.assert_shows(page, mesh)
        of_report = self.page("out/report.html")
        self.assertEqual(page.data, of_report.data)
        (folder / "report.json").unlink()
        written = mesh.show(self.folder / "shown.html")
        self.assertEqual(written, self.folder / "shown.html")
        alone = self.page("shown.html")
        self.assert_shows(alone, mesh)
        self.assertEqual([f["name"] for f in alone.data["faces"]], [f["name"] for f in page.data["faces"]])
        self.assertEqual(alone.data["worst"], [])

    def test_show_in_a_notebook_is_a_frame(self):
        self.mesh(self.write_case(), "out")
        mesh = tessera.read(self.folder / "out")
        shown = []
        with unittest.mock.patch.object(tessera._view, "_notebook_display", lambda: shown.append):
            self.assertIsNone(mesh.show(height=500))
        (frame,) = shown
        source = re.search(r'srcdoc="([^"]*)"', frame).group(1)
        self.assert_shows(ViewerPage(html.unescape(source)), mesh)
        self.assertIn('height="500"', frame)

    def test_mesh_without_a_boundary_is_refused(self):
        folder = self.mesh(self.write_case(), "out")
        (folder / "boundary.pvtu").unlink()
        outcome = self.run_program("info", folder / "mesh.pvtu", "--html", "mesh.html")
        self.assert_refused(outcome, WRONG_INPUT, "boundary.pvtu")
        with self.assertRaises(tessera.InputError):
            tessera.read(folder).show(self.folder / "x.html")


if __name__ == "__main__":
    unittest.main()

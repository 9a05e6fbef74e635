# SPDX-License-Identifier: BSD-3-Clause
"""report.html, the report for people, and `tessera compare`."""
import base64
import html.parser
import json
import os
import re
import unittest
import zlib

from program import CANNOT_WRITE, DEGRADED, FAILED, OK, WRONG_INPUT, ProgramTest

VOID = {"meta", "img", "br", "input"}  # Elements that are not closed.


class Page(html.parser.HTMLParser):
    """A page that was read strictly: every element is closed, in order."""

    def __init__(self, text):
        super().__init__()
        self.open = []
        self.elements = []  # (tag, attributes)
        self.text = ""
        self.by_key = {}  # Of the key figures, by their place in report.json.
        self.rows = []
        self.feed(text)
        self.close()
        if self.open:
            raise ValueError(f"not closed: {self.open}")

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.elements.append((tag, attributes))
        if tag == "tr":
            self.rows.append([])
        if tag in ("td", "th"):
            self.rows[-1].append("")
        if tag not in VOID:
            self.open.append((tag, attributes.get("data-key")))

    def handle_startendtag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        if not self.open or self.open[-1][0] != tag:
            raise ValueError(f"</{tag}> closes {self.open[-1:]}")
        self.open.pop()

    def handle_data(self, data):
        self.text += data
        for tag, key in self.open:
            if key:
                self.by_key[key] = self.by_key.get(key, "") + data
            if tag in ("td", "th"):
                self.rows[-1][-1] += data

    def pictures(self):
        return {
            attributes["id"]: attributes["src"] for tag, attributes in self.elements if tag == "img"
        }


def colours_of(source):
    """The colours of a picture in the page, by their palette numbers."""
    prefix = "data:image/png;base64,"
    assert source.startswith(prefix)
    data = base64.b64decode(source[len(prefix) :], validate=True)
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    place, chunks = 8, {}
    while place < len(data):
        size = int.from_bytes(data[place : place + 4], "big")
        kind, body = data[place + 4 : place + 8], data[place + 8 : place + 8 + size]
        assert zlib.crc32(kind + body) == int.from_bytes(data[place + 8 + size : place + 12 + size], "big")
        chunks[kind] = chunks.get(kind, b"") + body
        place += 12 + size
    width, height = (int.from_bytes(chunks[b"IHDR"][i : i + 4], "big") for i in (0, 4))
    rows = zlib.decompress(chunks[b"IDAT"])
    assert len(rows) == height * (width + 1)
    return set(rows[1 : width + 1]).union(*(rows[r * (width + 1) + 1 : (r + 1) * (width + 1)] for r in range(height)))


class PageTest(ProgramTest):
    """What tests of pages share."""

    def page(self, folder):
        return Page((self.folder / folder / "report.html").read_text(encoding="utf-8"))

    def report(self, folder):
        return json.loads((self.folder / folder / "report.json").read_text())

    def assert_needs_nothing(self, page):
        for tag, attributes in page.elements:
            self.assertNotIn(tag, ("link", "iframe", "object", "embed"))
            self.assertNotIn("href", attributes)
            if "src" in attributes:
                self.assertRegex(attributes["src"], r"^data:image/png;base64,[A-Za-z0-9+/=]+$")

    def assert_pictures(self, page, names):
        pictures = page.pictures()
        self.assertEqual(sorted(pictures), sorted(names))
        for name, source in pictures.items():
            self.assertGreater(len(colours_of(source)), 5, name)


class ReportTest(PageTest):
    def test_same_page_of_any_number_of_ranks(self):
        case = self.write_case(page=True)
        pages = []
        for ranks, folder in ((1, "one"), (3, "three")):
            self.mesh(case, folder, ranks=ranks)
            page, report = self.page(folder), self.report(folder)
            self.assert_needs_nothing(page)
            self.assert_pictures(page, ["picture-subdomains", "picture-patches", "picture-cut"])
            self.assertIn("A valid mesh is saved", page.text)
            self.assertEqual(page.by_key["/num_tets"], f"{report['num_tets']:,}")
            self.assertEqual(page.by_key["/num_vertices"], f"{report['num_vertices']:,}")
            self.assertEqual(page.by_key["/num_ranks"], str(ranks))
            self.assertEqual(float(page.by_key["/quality/mean_ratio/min"]),
                             float(f"{report['quality']['mean_ratio']['min']:.5g}"))
            self.assert_worst_tets(page, report)
            self.assertIn("pictures", [stage["name"] for stage in report["stages"]])
            pages.append(page)
        self.assertEqual(pages[0].pictures(), pages[1].pictures())

    def assert_worst_tets(self, page, report):
        worst, quality = report["quality"]["worst"], report["quality"]
        self.assertEqual(len(worst), 10)
        self.assertEqual(worst[0]["mean_ratio"], quality["mean_ratio"]["min"])
        self.assertEqual(worst, sorted(worst, key=lambda tet: (tet["mean_ratio"], tet["subdomain"])))
        rows = [row for row in page.rows if row[0].isdigit()]
        self.assertEqual(len(rows), 10)
        for row, tet in zip(rows, worst):
            self.assertEqual([float(x) for x in row[1:4]], [float(f"{x:.6g}") for x in tet["centre"]])
            self.assertEqual(int(row[4]), tet["subdomain"])
            self.assertEqual(row[5], f"{tet['mean_ratio']:.4f}")
            self.assertLess(sum(x * x for x in tet["centre"]), 1.0)  # In the ball.
        for counts in quality["dihedral_deg_histogram"].values():
            self.assertEqual(len(counts), 36)
            self.assertEqual(sum(counts), report["num_tets"])
        smallest = quality["dihedral_deg_histogram"]["smallest_of_tet"]
        lowest = next(b for b, count in enumerate(smallest) if count > 0)
        self.assertEqual(lowest, int(quality["min_dihedral_deg"] // 5))

    def test_degraded_run_shows_every_reason(self):
        case = self.write_case(page=True)
        outcome = self.run_program("mesh", case, "--output", "out", "--set", "quality.min_dihedral_deg=60",
                                   "--set", "quality.min_mean_ratio=0.99")
        self.assertEqual(outcome.code, DEGRADED, outcome.err)
        page, report = self.page("out"), self.report("out")
        self.assertEqual(len(report["reasons"]), 2)
        self.assertEqual(report["reason"], "; ".join(report["reasons"]))
        self.assertIn("Degraded", page.text)
        for reason in report["reasons"]:
            self.assertIn(reason, page.text)
        self.assertIn("A wanted quality was missed", page.text)

    def test_failed_run_says_why_and_what_to_do(self):
        case = self.write_case(page=True)
        fault = os.environ | {"TESSERA_TEST_FAULT": "coarse=segv remesh=segv"}
        outcome = self.run_program("mesh", case, "--output", "out", ranks=2, env=fault)
        self.assertEqual(outcome.code, FAILED, outcome.err)
        page = self.page("out")
        self.assert_needs_nothing(page)
        self.assertIn("no coarse mesh could be made", page.text)
        self.assertIn("What to do", page.text)
        self.assertIn("--resume", page.text)

    def test_names_of_the_model_cannot_change_the_page(self):
        self.write_case("case.toml", page=True)
        case = self.write(
            "<b>&'é.toml",
            (self.folder / "case.toml").read_text()
            + "[[geometry.name]]\nname = '</ul><script>\"ü'\npatch = { faces = [1] }\n",
        )
        self.mesh(case, "out dir", "--set", "fill.kernel=subdivide")
        page = self.page("out dir")
        self.assert_needs_nothing(page)
        self.assertIn("</ul><script>\"ü", page.text)
        self.assertIn("<b>&'é.toml", page.text)
        self.assertIn("tessera mesh 'out dir/case.toml'", page.text)

    def test_other_outputs_have_pictures_too(self):
        for folder, keys in (
            ("second", ["output.order=2"]),
            ("split", ["refine.levels=3", "fill.levels=2"]),
            ("one_file", ["output.files=1", "fill.kernel=subdivide"]),
        ):
            with self.subTest(folder):
                arguments = [argument for key in keys for argument in ("--set", key)]
                self.mesh(self.write_case(page=True), folder, *arguments, ranks=2)
                self.assert_pictures(self.page(folder), ["picture-subdomains", "picture-patches", "picture-cut"])

    def test_part_of_a_mesh_is_drawn_closed(self):
        self.mesh(self.write_case(page=True), "part", "--set", "fill.kernel=subdivide", "--only-subdomains", "1,2")
        self.assert_pictures(self.page("part"), ["picture-subdomains", "picture-patches", "picture-cut"])

    def test_can_be_turned_off_and_on_again(self):
        case = self.write_case(page=True)
        folder = self.mesh(case, "out", "--set", "output.report_html=false")
        self.assertFalse((folder / "report.html").exists())
        self.assertNotIn("pictures", [stage["name"] for stage in self.report("out")["stages"]])
        digest = self.report("out")["digest"]
        self.mesh(case, "out", "--overwrite")
        self.assertTrue((folder / "report.html").exists())
        self.assertEqual(self.report("out")["digest"], digest)
        self.mesh(case, "out", "--overwrite", "--set", "output.report_html=false")
        self.assertFalse((folder / "report.html").exists(), "it was of another run")

    def test_command_of_the_page_makes_the_same_mesh_again(self):
        self.mesh(self.write_case(page=True), "out", "--set", "fill.kernel=subdivide")
        digest = self.report("out")["digest"]
        command = re.search(r"tessera (mesh [^\n]*)\n", self.page("out").text).group(1)
        outcome = self.run_program(*command.split())
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertEqual(self.report("out")["digest"], digest)


class CompareTest(PageTest):
    @classmethod
    def setUpClass(cls):
        cls.made = cls.make_maker()
        case = cls.made.write_case(page=True)
        cls.made.mesh(case, "a")
        cls.made.mesh(case, "b", "--set", "refine.levels=2", "--set", "fill.kernel=subdivide", ranks=2)
        cls.made.mesh(case, "same", "--set", "output.report_html=false")

    def compare(self, *arguments, ranks=None):
        arguments = [self.made.folder / name if name in ("a", "b", "same") else name for name in arguments]
        return self.run_program("compare", *arguments, ranks=ranks)

    def test_two_runs_side_by_side(self):
        outcome = self.compare("a", "b", ranks=2)
        self.assertEqual(outcome.code, OK, outcome.err)
        page = Page((self.folder / "compare.html").read_text(encoding="utf-8"))
        self.assert_needs_nothing(page)
        self.assert_pictures(
            page, [f"picture-{run}-{name}" for run in "ab" for name in ("subdomains", "patches", "cut")]
        )
        reports = [json.loads((self.made.folder / run / "report.json").read_text()) for run in "ab"]
        tets = [report["num_tets"] for report in reports]
        expected = ["tets", *(f"{count:,}" for count in tets), f"{tets[1] / tets[0]:.3f}"]
        self.assertIn(expected, page.rows)
        line = next(line for line in outcome.out.splitlines() if line.startswith("tets "))
        self.assertEqual(line.split(), expected)
        self.assertIn("The two meshes differ", outcome.out)

    def test_same_mesh_is_seen_as_such(self):
        outcome = self.compare("a", "same", "--output", "x.html")
        self.assertEqual(outcome.code, OK, outcome.err)
        self.assertIn("the same, bit for bit", outcome.out)
        page = Page((self.folder / "x.html").read_text(encoding="utf-8"))
        self.assert_pictures(page, [f"picture-a-{name}" for name in ("subdomains", "patches", "cut")])

    def test_what_is_no_run_is_refused(self):
        (self.folder / "empty").mkdir()
        (self.folder / "broken").mkdir()
        self.write("broken/report.json", '{"schema": 1, "status"')
        for arguments, code, words in (
            (("a", "none"), WRONG_INPUT, ["none", "no such folder"]),
            (("empty", "a"), WRONG_INPUT, ["empty", "report.json"]),
            (("a", "broken"), WRONG_INPUT, ["broken", "damaged"]),
            (("a",), WRONG_INPUT, ["DIR_B"]),
            (("a", "b", "--output", "none/x.html"), CANNOT_WRITE, ["none/x.html"]),
        ):
            with self.subTest(arguments):
                outcome = self.compare(*arguments)
                self.assertEqual(outcome.code, code, outcome.err)
                for word in words:
                    self.assertIn(word, outcome.err)
                self.assertFalse((self.folder / "compare.html").exists())


if __name__ == "__main__":
    unittest.main()

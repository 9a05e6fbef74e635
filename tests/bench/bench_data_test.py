# SPDX-License-Identifier: BSD-3-Clause
"""Results as data, and what make_pages writes of them. No mesh is made."""
import importlib.machinery
import importlib.util
import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import bench_data

HERE = pathlib.Path(__file__).resolve().parent


def load_script(name):
    loader = importlib.machinery.SourceFileLoader(name, str(HERE / name))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
    loader.exec_module(module)
    return module


make_pages = load_script("make_pages")
with_data = load_script("with_data")
GOOD = {"command": "tests/bench/sizes BIN/tessera", "commit": "0123456789abcdef", "date": "2026-11-24",
        "machine": {"cpu": "a cpu", "cores": 2, "memory_gb": 8, "system": "Debian 12"}, "libraries": {},
        "rows": [{"model": "a", "tets": 1234567, "ks": None}, {"model": "b", "tets": 10, "ks": 0.25}]}


def filled(template, data=None):
    with tempfile.TemporaryDirectory() as folder:
        results = pathlib.Path(folder) / "results"
        (pathlib.Path(folder) / "pages").mkdir()
        results.mkdir()
        (pathlib.Path(folder) / "pages" / "page.md").write_text(template)
        bench_data.save(results / "one.json", data or GOOD)
        with mock.patch.multiple(make_pages, HERE=pathlib.Path(folder), RESULTS=results):
            return make_pages.Page("page.md", make_pages.read_results(), "../").made()


class Data(unittest.TestCase):
    def test_a_file_has_all_that_a_page_needs(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "one.json"
            bench_data.write(file, [{"tets": 3, "mean": 0.123456789}], {"netgen": "6"})
            data = json.loads(file.read_text())
        self.assertEqual(data["rows"], [{"tets": 3, "mean": 0.123457}])
        data["commit"] = data["commit"].rstrip(bench_data.UNCOMMITTED) or GOOD["commit"]  # None in sources without git.
        self.assertEqual(list(make_pages.defects("one", data)), [])

    def test_a_command_names_no_folder_of_the_machine(self):
        root = bench_data.ROOT
        words = [f"{root}/tests/bench/own_cases", f"{root}/build/ci/bin/tessera", f"{root}/configs/cases/core.toml",
                 "/somewhere/part1.stl=0.5,0.3", "--data", "/somewhere/file.json", "--set=fill.kernel=netgen"]
        with mock.patch.object(sys, "argv", words):
            self.assertEqual(bench_data.command(), "tests/bench/own_cases BIN/tessera configs/cases/core.toml "
                                                   "part1.stl=0.5,0.3 --set=fill.kernel=netgen")

    def test_figures_in_a_sentence_are_a_row(self):
        said = ("4 ranks, 3072 tets each, 1229 moved in all: best of 5 0.003 s, 0.002 s of CPU, 0.14 M moved tets/s a "
                "rank and second of CPU; at most 3 neighbours, 5 messages, 0.03 MB sent by a rank\n")
        self.assertEqual(with_data.rows_of("migrate_bench", f"another line\n{said}"),
                         [{"ranks": 4, "tets": 3072, "seconds": 0.003, "rate_m": 0.14, "neighbours": 3, "messages": 5,
                           "mb": 0.03}])

    def test_what_a_file_lacks_is_named(self):
        for key, value in (("commit", ""), ("commit", "0123456789abcdef+"), ("command", ""), ("rows", []),
                           ("machine", {"cpu": "a cpu"})):
            found = list(make_pages.defects("one", GOOD | {key: value}))
            self.assertTrue(found and found[0].startswith("one: "), (key, found))


class Pages(unittest.TestCase):
    def test_a_pattern_becomes_a_row_for_each_row_of_the_data(self):
        made = filled("<!-- data: one -->\n| model | tets | KS |\n|---|---|---|\n| {model} | {tets:,} | {ks:.2f} |\n")
        self.assertIn("| a | 1,234,567 | – |\n| b | 10 | 0.25 |\n", made)
        self.assertIn("of commit `01234567`, 2026-11-24: `tests/bench/sizes BIN/tessera`", made)

    def test_rows_are_chosen(self):
        made = filled("<!-- data: one model=b -->\n| model |\n|---|\n| {model} |\n")
        self.assertNotIn("| a |", made)
        self.assertIn("| b |", made)

    def test_sentences_have_figures_of_the_data(self):
        self.assertEqual(filled("At most {{max(r.tets for r in one)|,}} tets.\n"), "At most 1,234,567 tets.\n")

    def test_unknown_data_end_the_program(self):
        for template in ("<!-- source: two -->\n", "<!-- data: one model=c -->\n| a |\n|---|\n| {model} |\n"):
            with self.assertRaises(SystemExit):
                filled(template)


if __name__ == "__main__":
    unittest.main()

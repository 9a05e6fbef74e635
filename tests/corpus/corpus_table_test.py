# SPDX-License-Identifier: BSD-3-Clause
"""What the corpus calls worse, on rows that are made up; no mesh is made."""
import dataclasses
import pathlib
import tempfile
import unittest
from unittest import mock

import corpus_files
from corpus_table import (COLUMNS, OUTCOMES, Row, better_outcomes, compare, nearest_table, read_table, table_file,
                          write_table)

BEFORE = Row("part", "ok", 12345, 10.0, 20.0, 0.7, 2.0)
REFERENCE_S = 4.0


def findings(now, before=BEFORE, **options):
    return [finding.figure for finding in compare({before.name: before}, [now], REFERENCE_S, **options)]


def changed(**figures):
    return dataclasses.replace(BEFORE, **figures)


class Judgement(unittest.TestCase):
    def test_the_same_is_not_worse(self):
        self.assertEqual(findings(BEFORE), [])

    def test_better_is_not_worse(self):
        self.assertEqual(findings(changed(G=5.0, angle=40.0, p01=0.9, cpu=0.1, tets=10)), [])

    def test_each_outcome_is_worse_than_those_before_it(self):
        for i, before in enumerate(OUTCOMES):
            for j, now in enumerate(OUTCOMES):
                expected = ["outcome"] if j > i else []
                self.assertEqual(findings(changed(outcome=now), changed(outcome=before)), expected, (before, now))

    def test_a_mesh_that_is_no_more_is_one_finding(self):
        lost = Row("part", "failed", None, None, None, None, 2.0)
        self.assertEqual(findings(lost), ["outcome"])
        self.assertEqual(findings(BEFORE, lost), [])

    def test_more_tets_at_equal_size(self):
        self.assertEqual(findings(changed(G=10.19)), [])
        self.assertEqual(findings(changed(G=10.21)), ["G"])

    def test_first_percentile(self):
        self.assertEqual(findings(changed(p01=0.687)), [])
        self.assertEqual(findings(changed(p01=0.685)), ["1st percentile"])

    def test_smallest_angle(self):
        self.assertEqual(findings(changed(angle=19.1)), [])
        self.assertEqual(findings(changed(angle=18.9)), ["smallest angle"])

    def test_a_small_angle_is_judged_as_a_large_one(self):
        self.assertEqual(findings(changed(angle=0.0190), changed(angle=0.0189)), [])
        self.assertEqual(findings(changed(angle=0.0170), changed(angle=0.0189)), ["smallest angle"])

    def test_cpu_time_takes_both_to_be_worse(self):
        self.assertEqual(findings(changed(cpu=2.99)), [])  # 4 s more, but not 1.5 times.
        self.assertEqual(findings(changed(cpu=3.01)), ["CPU seconds"])
        few = changed(cpu=0.2)
        self.assertEqual(findings(changed(cpu=0.69), few), [])  # Thrice, but not 2 s more.
        self.assertEqual(findings(changed(cpu=0.71), few), ["CPU seconds"])

    def test_cpu_time_is_judged_of_a_file_without_a_mesh_too(self):
        refused = Row("part", "refused", None, None, None, None, 2.0)
        self.assertEqual(findings(dataclasses.replace(refused, cpu=4.0), refused), ["CPU seconds"])

    def test_all_that_is_worse_is_found(self):
        worse = changed(outcome="degraded", G=11.0, p01=0.5, angle=5.0, cpu=9.0)
        self.assertEqual(findings(worse), ["outcome", "G", "1st percentile", "smallest angle", "CPU seconds"])

    def test_another_version_is_judged_by_outcomes_alone(self):
        worse = changed(G=11.0, p01=0.5, angle=5.0, cpu=9.0)
        self.assertEqual(findings(worse, by_outcomes_alone=True), [])
        self.assertEqual(findings(dataclasses.replace(worse, outcome="failed"), by_outcomes_alone=True), ["outcome"])

    def test_a_file_without_a_row_is_a_finding(self):
        self.assertEqual(findings(changed(name="other")), ["row"])

    def test_the_message_has_file_figure_before_and_now(self):
        (finding,) = compare({"part": BEFORE}, [changed(G=11.0)], REFERENCE_S)
        self.assertEqual(str(finding), "part: G 10 before, 11 now")

    def test_a_better_outcome_is_told(self):
        table = {"part": changed(outcome="failed")}
        self.assertEqual([str(better) for better in better_outcomes(table, [BEFORE])],
                         ["part: outcome failed before, ok now"])
        self.assertEqual(better_outcomes({"part": BEFORE}, [BEFORE]), [])


class Tables(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.file = table_file(self.folder, "6.2.1905")

    def write(self, *rows, names=("part", "other", "refused")):
        write_table(self.file, rows, set(names), REFERENCE_S)
        return read_table(self.file)

    def test_what_is_written_is_read_and_sorted(self):
        refused = Row("other", "refused", None, None, None, None, 0.1)
        self.assertEqual(self.write(BEFORE, refused), {"part": BEFORE, "other": refused})
        self.assertEqual([line.split("\t")[0] for line in self.file.read_text().splitlines()],
                         ["name", "other", "part"])

    def test_a_run_of_some_files_keeps_the_others(self):
        self.write(BEFORE, changed(name="other"))
        self.assertEqual(self.write(changed(tets=5))["other"].tets, BEFORE.tets)

    def test_a_file_that_left_the_list_leaves_the_table(self):
        self.write(BEFORE, changed(name="other"))
        self.assertEqual(set(self.write(BEFORE, names=("part",))), {"part"})

    def test_cpu_time_stays_where_it_hardly_changed(self):
        self.write(BEFORE)
        self.assertEqual(self.write(changed(cpu=2.4))["part"].cpu, 2.0)
        self.assertEqual(self.write(changed(cpu=2.6))["part"].cpu, 2.6)
        self.assertEqual(self.write(changed(cpu=1.0))["part"].cpu, 1.0)

    def test_a_damaged_table_is_no_table(self):
        self.file.write_text("name\toutcome\n")
        with self.assertRaises(ValueError):
            read_table(self.file)
        self.file.write_text("\t".join(COLUMNS) + "\npart\tfine\t1\t1\t1\t1\t1\n")
        with self.assertRaises(ValueError):
            read_table(self.file)

    def test_another_version_takes_the_last_table_before_it(self):
        for version in ("6.2.1905", "6.2.2401"):
            table_file(self.folder, version).write_text("")
        for version, expected in (("6.2.1905", "6.2.1905"), ("6.2.2105", "6.2.1905"), ("6.2.2501", "6.2.2401"),
                                  ("6.1.0", "6.2.1905")):
            self.assertEqual(nearest_table(self.folder, version), table_file(self.folder, expected))

    def test_no_table_is_an_error(self):
        with self.assertRaises(FileNotFoundError):
            nearest_table(self.folder, "6.2.1905")


class Lists(unittest.TestCase):
    def test_a_line_has_a_name_a_source_a_file_and_settings(self):
        (entry,) = corpus_files.parse_list("# what it is\nrod occt-misc data/rod.step full a.b=1 c.d=2 # why\n")
        self.assertEqual(entry, corpus_files.Entry("rod", "occt-misc", "data/rod.step", False, ("a.b=1", "c.d=2")))

    def test_a_line_that_is_too_short_or_twice_the_same_is_refused(self):
        for text in ("rod occt-misc rod.step", "rod occt-misc rod.step often", "rod a b full\nrod c d full"):
            with self.assertRaises(ValueError, msg=text):
                corpus_files.parse_list(text)

    def test_a_missing_file_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            models = corpus_files.Models(pathlib.Path(folder), pathlib.Path(folder))
            (entry,) = corpus_files.parse_list("rod repository there/is_no_such.step full")
            with self.assertRaisesRegex(corpus_files.MissingInput, "is_no_such.step"):
                models.path_of(entry)

    def test_a_generator_that_is_not_built_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            models = corpus_files.Models(pathlib.Path(folder), pathlib.Path(folder))
            (entry,) = corpus_files.parse_list("rod hard_models rod.brep full")
            with self.assertRaisesRegex(corpus_files.MissingInput, "hard_models is not built"):
                models.path_of(entry)

    def test_a_package_that_does_not_exist_is_named_after_an_update(self):
        with tempfile.TemporaryDirectory() as folder, \
                mock.patch.object(corpus_files, "candidate_version", return_value=None), \
                mock.patch.object(corpus_files, "update_package_lists") as update:
            with self.assertRaisesRegex(corpus_files.MissingInput, "no package no-such-cad"):
                corpus_files.unpack_package("no-such-cad", pathlib.Path(folder))
            update.assert_called_once()

    def test_list_and_tables_are_of_the_same_files(self):
        entries = corpus_files.read_list()
        self.assertEqual(sum(entry.is_quick for entry in entries), 12)
        tables = list(corpus_files.HERE.glob("netgen-*.tsv"))
        self.assertTrue(tables)
        for table in tables:
            self.assertEqual(set(read_table(table)), {entry.name for entry in entries}, table.name)


if __name__ == "__main__":
    unittest.main()

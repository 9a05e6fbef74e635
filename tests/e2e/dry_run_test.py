# SPDX-License-Identifier: BSD-3-Clause
"""`tessera mesh --dry-run`: what it predicts becomes true, and it is in no run's way."""
import json
import pathlib
import re
import shutil
import signal
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
import program  # noqa: E402
from periodic_models import PACKING, packing_case  # noqa: E402
from program import CANNOT_WRITE, OK, STOPPED, WRONG_INPUT, sets  # noqa: E402

SUBDIVIDE = ("--set", "fill.kernel=subdivide")

# Wanted of a prediction, relative; of tets more than the samples usually miss.
TETS = 0.2
BYTES = 0.25


class DryRunTest(program.ProgramTest):
    def dry_run(self, case, output, *arguments, ranks=None):
        """A dry run that must end well: its prediction, and what it printed."""
        outcome = self.run_program(
            "mesh", case, "--dry-run", "--output", output, "--progress", "never", *arguments, ranks=ranks
        )
        self.assertEqual(outcome.code, OK, outcome.err)
        return json.loads((self.folder / output / "prediction.json").read_text()), outcome.out

    def assert_holds_only_the_prediction(self, folder):
        names = {entry.name for entry in folder.iterdir()}
        self.assertEqual(names - {".tessera.lock"}, {"prediction.json", "log"})


class Foretells(DryRunTest):
    def assert_foretells(self, case, *arguments):
        """Dry run, then the run itself in the same folder: its report compares the two."""
        shutil.rmtree(self.folder / "out", ignore_errors=True)
        predicted, _ = self.dry_run(case, "out", *arguments)
        self.assert_holds_only_the_prediction(self.folder / "out")
        report = json.loads((self.mesh(case, "out", *arguments) / "report.json").read_text())
        self.assert_compares(report, predicted)
        return report["prediction"]

    def assert_compares(self, report, predicted):
        compared = report["prediction"]
        self.assertEqual(compared["tets"]["actual"], report["num_tets"])
        self.assertEqual(compared["vertices"]["actual"], report["num_vertices"])
        self.assertEqual(compared["memory_per_rank_bytes"]["actual"], report["peak_rss_bytes_max"])
        for name in ("tets", "vertices", "files", "disk_bytes", "memory_per_rank_bytes", "wall_time_s"):
            figure = compared[name]
            self.assertEqual(figure["predicted"], predicted[name])
            self.assertAlmostEqual(figure["error"], figure["predicted"] / figure["actual"] - 1)
        self.assertEqual(
            compared["files"]["actual"], sum(1 for _ in (self.folder / "out").glob("*/piece_*.vtu"))
        )

    def assert_near(self, compared):
        for name, tolerance in (("tets", TETS), ("vertices", TETS), ("disk_bytes", BYTES)):
            self.assertLess(abs(compared[name]["error"]), tolerance, f"{name}: {compared[name]}")
        self.assertEqual(compared["files"]["error"], 0)
        self.assertEqual(compared["boundary_triangles"]["error"], 0)
        self.assertLess(abs(compared["memory_per_rank_bytes"]["error"]), 0.5)

    def test_a_filled_mesh(self):
        case = self.write_case(max_size=0.35, subdomains=10, levels=1)
        self.assert_near(self.assert_foretells(case))

    def test_a_subdivided_mesh(self):
        case = self.write_case(max_size=0.35, subdomains=10, levels=2)
        compared = self.assert_foretells(case, *SUBDIVIDE)
        self.assert_near(compared)
        self.assertEqual(compared["tets"]["error"], 0)
        self.assertEqual(compared["vertices"]["error"], 0)

    def test_files_of_several_pieces(self):
        case = self.write_case(max_size=0.35, subdomains=10, levels=2)
        for kernel in ((), SUBDIVIDE):
            with self.subTest(kernel=kernel):
                self.assert_near(self.assert_foretells(case, *kernel, "--set", "output.files=3"))


class Prediction(DryRunTest):
    def test_is_the_same_for_any_number_of_ranks_that_take_part(self):
        case = self.write_case(max_size=0.35, subdomains=10, levels=1)
        first, _ = self.dry_run(case, "one", ranks=None)
        second, _ = self.dry_run(case, "two", ranks=2)
        self.assertEqual((first["ranks"], second["ranks"]), (1, 2))
        for key in ("case", "model", "subdomains", "tets", "vertices", "boundary_triangles", "files",
                    "disk_bytes"):
            self.assertEqual(first[key], second[key], key)
        self.assertEqual(
            [sample["subdomains"] for sample in first["samples"]],
            [sample["subdomains"] for sample in second["samples"]],
        )

    def test_for_many_ranks_needs_none_of_them(self):
        case = self.write_case(max_size=0.35, subdomains=10, levels=1)
        predicted, said = self.dry_run(case, "out", "--ranks", "100000")
        self.assertEqual(predicted["ranks"], 100000)
        self.assertLess(predicted["busy_share"], 0.01)
        self.assertTrue(predicted["fits"])
        self.assertTrue(any("too few" in advice for advice in predicted["should_change"]))
        for words in ("100000 ranks", str(predicted["tets"]), "serial", "advice: "):
            self.assertIn(words, said)
        stages = {stage["name"]: stage for stage in predicted["stages"]}
        self.assertTrue(stages["coarse"]["serial"])
        self.assertFalse(stages["fill"]["serial"])
        # Ten jobs on so many ranks: the longest of them, some tenth of all.
        self.assertLess(stages["fill"]["wall_time_s"], stages["fill"]["cpu_s"] / 3)

    def test_says_what_will_not_fit(self):
        """A mesh of some 10^11 tets fits on no disk here; its dry run is short all the same."""
        case = self.write_case(max_size=0.35, subdomains=10, levels=10)
        predicted, said = self.dry_run(case, "out", *SUBDIVIDE)
        self.assertFalse(predicted["fits"])
        self.assertGreater(predicted["tets"], 1e11)
        self.assertIn("WILL NOT FIT", said)
        self.assertTrue(any("output.directory" in words for words in predicted["must_change"]))
        self.assertTrue(any("decompose.subdomains" in words for words in predicted["must_change"]))
        for key, arguments in (("decompose.subdomains", ()), ("output.files", ("--set", "output.files=2"))):
            outcome = self.run_program("mesh", case, "--output", "real", "--overwrite", *SUBDIVIDE, *arguments)
            self.assert_refused(outcome, WRONG_INPUT, f"{key}: file 0 of", "choose more")


class Plan(DryRunTest):
    """A run plans its stages once, before it fills. It has those stages and no others, and a dry run names the same."""

    def stages_of(self, case, *arguments):
        """Of the report of a run; its log has the plan."""
        out = self.mesh(case, "out", *arguments, "--overwrite")
        done = [stage["name"] for stage in json.loads((out / "report.json").read_text())["stages"]]
        planned = re.findall(r" stages: (.*)", (out / "log/run.log").read_text())
        self.assertEqual(planned[-1:], [", ".join(done)])
        return done

    def assert_plans(self, case, after_decompose, *arguments):
        predicted, said = self.dry_run(case, "out", *arguments)
        done = self.stages_of(case, *arguments)
        self.assertEqual(predicted["plan"], done)
        self.assertRegex(said, rf"(?m)^  stages +{', '.join(done)}$")
        self.assertEqual(done[done.index("decompose") + 1 :], after_decompose)
        return done

    def test_of_one_pass_and_of_seams_that_are_improved(self):
        case = self.write_case(page=True)
        self.assert_plans(case, ["plan", "fill", "improve", "verify", "write", "pictures"])
        self.assert_plans(case, ["plan", "fill", "verify", "pictures"], *SUBDIVIDE)

    def test_without_seams(self):
        self.assert_plans(self.write_case(subdomains=1), ["plan", "fill", "verify", "write"])

    def test_of_pieces_that_are_split(self):
        self.assert_plans(
            self.write_case(levels=2),
            ["plan", "fill", "improve", "verify", "refine", "verify"],
            *sets("fill.kernel=optimize", "fill.levels=1"),
        )

    def test_of_second_order_for_which_there_is_no_dry_run(self):
        done = self.stages_of(self.write_case(), *SUBDIVIDE, *sets("output.order=2"))
        self.assertEqual(done[-5:], ["plan", "fill", "verify", "curve", "verify"])

    def test_of_parts_and_formats(self):
        case = self.write_case()
        self.assert_plans(case, ["plan", "fill", "verify", "neighbours"], *SUBDIVIDE, *sets("output.parts=2"))
        self.assert_plans(
            case, ["plan", "fill", "verify", "export"], *SUBDIVIDE, *sets('output.formats=["pvtu", "msh"]')
        )

    def test_of_sides_that_are_periodic(self):
        self.write("model.geo", PACKING)
        case = self.write("case.toml", packing_case())
        done = self.assert_plans(case, ["plan", "fill", "verify", "partners"], *SUBDIVIDE)
        self.assertEqual(done[: done.index("decompose")], ["model", "names", "coarse", "periodic"])

    def test_of_sizes(self):
        case = self.write_case()
        case.write_text(case.read_text().replace("coarse.max_size = 0.7", "size.target = 0.3"))
        done = self.assert_plans(case, ["plan", "fill", "verify"], *SUBDIVIDE)
        self.assertEqual(done[: done.index("decompose")], ["model", "coarse", "levels"])


class Folder(DryRunTest):
    def test_a_dry_run_removes_nothing_of_a_run(self):
        case = self.write_case()
        out = self.mesh(case, "out")
        before = {file: file.read_bytes() for file in out.glob("**/*") if file.is_file()
                  and file.parent.name != "log"}
        self.dry_run(case, "out", "--overwrite")
        for file, content in before.items():
            if file.name != ".tessera.lock":
                self.assertEqual(file.read_bytes(), content, file)
        self.assertFalse((out / "dry_run").exists())
        refused = self.run_program("mesh", case, "--output", "out", "--set", "refine.levels=0")
        self.assert_refused(refused, CANNOT_WRITE, "--overwrite")

    def test_the_prediction_of_another_case_counts_for_nothing(self):
        case = self.write_case()
        self.dry_run(case, "out", "--set", "refine.levels=2")
        report = json.loads((self.mesh(case, "out") / "report.json").read_text())
        self.assertNotIn("prediction", report)

    def test_a_damaged_prediction_counts_for_nothing(self):
        case = self.write_case()
        for text in ("{", "[]", '{"stages": 3}'):
            (self.folder / "out").mkdir(exist_ok=True)
            self.dry_run(case, "out", "--overwrite")
            file = self.folder / "out" / "prediction.json"
            intact = json.loads(file.read_text())
            intact.update({"stages": "none"})
            for damaged in (text, json.dumps(intact)):
                file.write_text(damaged)
                report = json.loads((self.mesh(case, "out", "--overwrite") / "report.json").read_text())
                self.assertNotIn("prediction", report, damaged)

    def test_what_a_stopped_dry_run_leaves_is_in_no_runs_way(self):
        case = self.write_case(max_size=0.15, subdomains=4, levels=3)
        for how, code in ((signal.SIGTERM, STOPPED), (signal.SIGKILL, -signal.SIGKILL)):
            with self.subTest(signal=how):
                process = self.start("mesh", case, "--dry-run", "--output", "out")
                samples = self.folder / "out" / "dry_run"
                program.wait_until(samples.exists, "the samples")
                process.send_signal(how)
                self.assertEqual(self.finish(process).code, code)
                self.assertEqual(samples.exists(), how == signal.SIGKILL)
        self.assertFalse((self.folder / "out" / "prediction.json").exists())
        out = self.mesh(case, "out", "--set", "refine.levels=0")
        self.assertFalse((out / "dry_run").exists())

    def test_a_foreign_folder_is_refused(self):
        self.write_case()
        (self.folder / "mine").mkdir()
        (self.folder / "mine" / "letter.txt").write_text("dear")
        outcome = self.run_program("mesh", "case.toml", "--dry-run", "--output", "mine")
        self.assert_refused(outcome, CANNOT_WRITE, "mine")
        self.assertEqual([entry.name for entry in (self.folder / "mine").iterdir()], ["letter.txt"])

    def test_only_subdomains_that_are_not_possible_are_refused(self):
        case = self.write_case()
        for ranks in (None, 2):
            outcome = self.run_program(
                "mesh", case, "--dry-run", "--only-subdomains", "0", "--output", "out", ranks=ranks
            )
            self.assert_refused(outcome, WRONG_INPUT, "--only-subdomains", "subdivide")
            self.assertFalse((self.folder / "out" / "report.json").exists())


if __name__ == "__main__":
    unittest.main()

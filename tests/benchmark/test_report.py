# SPDX-License-Identifier: GPL-2.0-or-later
"""Ratios and verdicts from Google Benchmark's output."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

import report


def entry(name, nanoseconds, right=None, aggregate="median"):
    counters = {} if right is None else {"right": right}
    return {"run_name": name, "aggregate_name": aggregate, "cpu_time": nanoseconds, **counters}


def named(rows, case):
    return {row.quantity: row for row in rows if row.case == case}


class Rows(unittest.TestCase):
    def rows(self, *entries):
        return report.rows(report.timings({"benchmarks": list(entries)}))

    def test_the_ratio_is_peer_over_ours(self):
        rows = self.rows(entry("warm/ours/wavy/31", 50.0, 1.0), entry("warm/opencascade/wavy/31", 1500.0, 0.9))
        wavy = named(rows, "wavy 31x31")
        self.assertEqual(wavy["warm_speedup_over_opencascade"].value, 30.0)
        self.assertEqual(wavy["opencascade_warm_time"].value, 1500.0)
        self.assertEqual(wavy["opencascade_warm_fraction_right"].value, 0.9)

    def test_the_target_itself_passes_and_more_does_too(self):
        for ours, verdict in ((80.0, False), (75.0, True), (5.0, True)):
            with self.subTest(ours=ours):
                rows = self.rows(
                    entry("warm/ours/saddle/31", ours, 1.0), entry("warm/opencascade/saddle/31", 1500.0, 1.0)
                )
                self.assertIs(named(rows, "saddle 31x31")["warm_speedup_over_opencascade"].passes, verdict)

    def test_targets_of_the_cold_search_by_number_of_elements(self):
        rows = self.rows(
            *(entry(f"cold/ours/plate/{n}", 1000.0, 1.0) for n in (31, 124)),
            *(entry(f"cold/opencascade/plate/{n}", 50000.0, 1.0) for n in (31, 124)),
        )
        cold = "cold_speedup_over_opencascade"
        self.assertIs(named(rows, "plate 31x31")[cold].passes, True)
        self.assertIs(named(rows, "plate 124x124")[cold].passes, False)
        self.assertEqual(named(rows, "plate 124x124")["cold_growth_from_31x31"].value, 1.0)

    def test_flat_plate_has_no_target_against_opencascade(self):
        rows = self.rows(entry("warm/ours/plate/31", 50.0, 1.0), entry("warm/opencascade/plate/31", 100.0, 1.0))
        self.assertIsNone(named(rows, "plate 31x31")["warm_speedup_over_opencascade"].passes)

    def test_batches_are_compared_within_one_instruction_set(self):
        rows = self.rows(
            entry("warm/avx512/wavy/31", 60.0, 1.0),
            entry("batch/avx512/wavy/31", 30.0, 1.0),
            entry("batch/avx2/wavy/31", 10.0, 1.0),
        )
        ratio = named(rows, "wavy 31x31")["batch_speedup_over_single_avx512"]
        self.assertEqual((ratio.value, ratio.passes), (2.0, True))

    def test_the_cost_of_a_step_is_the_mean_over_the_surfaces(self):
        for slowest, verdict in ((140.0, True), (141.0, False)):
            with self.subTest(slowest=slowest):
                rows = self.rows(
                    *(entry(f"step/ours/{s}/31", 100.0) for s in report.SURFACES[:3]),
                    entry(f"step/ours/{report.SURFACES[3]}/31", slowest),
                )
                figure = named(rows, "all 31x31")["rebuild_projection_distribution_per_contact_and_step"]
                self.assertEqual(figure.value, (300.0 + slowest) / 4)
                self.assertIs(figure.passes, verdict)

    def test_only_medians_count(self):
        rows = self.rows(entry("rebuild/ours/wavy/31", 7.0), entry("rebuild/ours/wavy/31", 9.0, aggregate="mean"))
        self.assertEqual([row.value for row in rows], [7.0])


class Files(unittest.TestCase):
    def test_summary_of_a_run_with_a_slow_result(self):
        """A stand-in for the executable; the report succeeds though the ratio is missed."""
        output = {
            "context": {"compiled_for": "x86-64", "dispatched_to": "avx2"},
            "benchmarks": [entry("warm/ours/wavy/31", 50.0, 1.0), entry("warm/opencascade/wavy/31", 60.0, 1.0)],
        }
        with tempfile.TemporaryDirectory() as folder:
            executable = Path(folder) / "benchmark"
            executable.write_text(
                "#!/usr/bin/python3\nimport sys\n"
                "out = next(w for w in sys.argv if w.startswith('--benchmark_out=')).split('=')[1]\n"
                f"open(out, 'w').write({json.dumps(output)!r})\n"
            )
            executable.chmod(0o755)
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                report.main(str(executable), "no program", folder, "--benchmark_filter=wavy")
            summary = json.loads((Path(folder) / "summary.json").read_text())
        self.assertEqual(summary["deck"], "benchmark")
        ratio = next(r for r in summary["rows"] if r["quantity"] == "warm_speedup_over_opencascade")
        self.assertEqual((ratio["value"], ratio["reference"], ratio["pass"]), (1.2, 20.0, False))
        self.assertIn("FAIL", printed.getvalue())


if __name__ == "__main__":
    unittest.main()

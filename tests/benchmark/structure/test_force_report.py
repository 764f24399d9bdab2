# SPDX-License-Identifier: GPL-2.0-or-later
"""Times per dof, shares of the machine and verdicts from Google Benchmark's output."""

import contextlib
import io
import json
import tempfile
import unittest
from pathlib import Path

import force_report as report

PLATE = "linear_elastic/plate/p2"


def entry(name, milliseconds, aggregate="median", **counters):
    common = {"run_name": name, "aggregate_name": aggregate, "cpu_time": milliseconds, "time_unit": "ms"}
    return {**common, **counters}


PROBES = (
    entry("probe/read", 10.0, bytes=1e8),  # 10 GB/s
    entry("probe/read_huge_pages", 5.0, bytes=1e8),  # 20 GB/s
    entry("probe/multiply_add", 1.0, flops=1e8),  # 100 GFlop/s
)


def rows(*entries):
    found = report.rows(report.timings({"benchmarks": list(entries)}))
    return {(row.case, row.quantity): row for row in found}


class Rows(unittest.TestCase):
    def test_times_are_per_dof(self):
        found = rows(entry(f"force/plain/{PLATE}", 2.0, dofs=1e4))
        self.assertAlmostEqual(found["plate p2", "force_plain_linear_elastic_time_per_dof"].value, 200.0)

    def test_a_step_has_its_own_clock_and_is_held_against_the_force(self):
        for over_force, verdict in ((1.15, True), (1.16, False)):
            with self.subTest(over_force=over_force):
                step = entry(f"step/plain/{PLATE}/manual_time", 9.0, real_time=2.0, dofs=1e4, over_force=over_force)
                found = rows(step)
                self.assertAlmostEqual(found["plate p2", "step_plain_linear_elastic_time_per_dof"].value, 200.0)
                self.assertIs(found["plate p2", "step_plain_linear_elastic_over_force"].passes, verdict)

    def test_speedups_pass_from_their_target_upwards(self):
        for ours, verdict in ((1.01, False), (1.0, True), (0.5, True)):
            with self.subTest(ours=ours):
                found = rows(entry(f"force/auto/{PLATE}", ours, dofs=10), entry(f"force/csr/{PLATE}", 7.0, dofs=10))
                self.assertIs(found["plate p2", "speedup_over_csr"].passes, verdict)

    def test_a_law_may_cost_a_quarter_more(self):
        rotating = f"force/auto/{PLATE}".replace("linear_elastic", "saint_venant_kirchhoff")
        for time, verdict in ((1.25, True), (1.26, False)):
            with self.subTest(time=time):
                found = rows(entry(f"force/auto/{PLATE}", 1.0), entry(rotating, time))
                ratio = found["plate p2", "saint_venant_kirchhoff_over_linear_elastic"]
                self.assertIs(ratio.passes, verdict)

    def test_shares_are_of_the_better_probe(self):
        found = rows(*PROBES, entry(f"force/stored/{PLATE}", 1.0, dofs=10, bytes=1.6e7, flops=2e7))
        read = found["plate p2", "force_stored_linear_elastic_share_of_bandwidth"]
        self.assertAlmostEqual(read.value, 0.8)
        self.assertEqual(read.reference, 0.8)
        flops = found["plate p2", "force_stored_linear_elastic_share_of_multiply_add"]
        self.assertAlmostEqual(flops.value, 0.2)

    def test_only_stored_geometry_is_asked_for_bandwidth(self):
        found = rows(*PROBES, entry(f"force/plain/{PLATE}", 1.0, bytes=1.0, flops=1.0))
        self.assertIsNone(found["plate p2", "force_plain_linear_elastic_share_of_bandwidth"].passes)

    def test_a_wrong_force_fails(self):
        for error, verdict in ((1e-13, True), (1e-11, False), (float("nan"), False)):
            with self.subTest(error=error):
                found = rows(entry(f"force/plain/{PLATE}", 1.0, error=error))
                self.assertIs(found["plate p2", "force_plain_linear_elastic_error"].passes, verdict)

    def test_aims_are_those_of_linear_forces_with_full_quadrature(self):
        share = "share_of_multiply_add"
        for method, law, aim in (
            ("auto", "linear_elastic", 0.5),
            ("auto_reduced", "linear_elastic", None),
            ("auto", "saint_venant_kirchhoff", None),
        ):
            with self.subTest(method=method, law=law):
                found = rows(*PROBES, entry(f"force/{method}/{law}/plate/p2", 1.0, bytes=1.0, flops=1.0))
                self.assertEqual(found["plate p2", f"force_{method}_{law}_{share}"].reference, aim)

    def test_rational_bodies_may_store_more(self):
        for body, verdict in (("plate", False), ("rational", True)):
            with self.subTest(body=body):
                found = rows(entry(f"force/stored/linear_elastic/{body}/p2", 1.0, dofs=1.0, bytes=700.0, flops=1.0))
                self.assertIs(found[f"{body} p2", "force_stored_linear_elastic_bytes_per_dof"].passes, verdict)

    def test_only_medians_count(self):
        found = rows(entry(f"force/csr/{PLATE}", 1.0), entry(f"force/csr/{PLATE}", 5.0, aggregate="mean"))
        self.assertEqual([row.value for row in found.values()], [1e6])


class Files(unittest.TestCase):
    def test_a_slow_run_is_reported(self):
        """A stand-in for the executable; the report succeeds though the ratio is missed."""
        benchmarks = [
            *PROBES,
            entry(f"force/auto/{PLATE}", 1.0, dofs=10, bytes=1e6, flops=1e6, error=1e-15),
            entry(f"force/blocks/{PLATE}", 2.0, dofs=10, bytes=1e6, flops=1e6),
        ]
        output = {"context": {"dispatched_to": "avx2"}, "benchmarks": benchmarks}
        with tempfile.TemporaryDirectory() as folder:
            executable = Path(folder) / "benchmark"
            executable.write_text(
                "#!/usr/bin/python3\nimport sys\n"
                "out = next(w for w in sys.argv if w.startswith('--benchmark_out=')).split('=')[1]\n"
                f"open(out, 'w').write({json.dumps(output)!r})\n"
            )
            executable.chmod(0o755)
            with contextlib.redirect_stdout(io.StringIO()) as printed:
                report.main(str(executable), folder)
            summary = json.loads((Path(folder) / "summary.json").read_text())
        ratio = next(r for r in summary["rows"] if r["quantity"] == "speedup_over_blocks")
        self.assertEqual((ratio["value"], ratio["reference"], ratio["pass"]), (2.0, 5.0, False))
        self.assertIn("FAIL", printed.getvalue())
        self.assertRegex(printed.getvalue(), r"plate p2 +force auto linear_elastic +1e\+05 +100000 +100000")


if __name__ == "__main__":
    unittest.main()

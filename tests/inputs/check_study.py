# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs a study as a user does, whole or some cases of it, and checks what it left, by this file's own numbers.

usage: check_study.py DECK inputs/run DIR [CASE...]
"""

import csv
import json
import math
import re
import shutil
import subprocess
import sys
from pathlib import Path

# case: peak force [N], duration [us] of the exact solution for a fixed wall (independent values).
BALL_PLATE = {
    "hertz_lambda_0.6": (5.450859, 7.011585),
    "hertz_lambda_0.8": (6.115619, 6.249435),
    "hertz_lambda_1.0": (6.686586, 5.715796),
    "hertz_lambda_1.2": (7.192452, 5.313788),
    "hertz_E_50GPa": (5.901825, 6.475821),
    "hertz_E_74.6GPa": (6.686586, 5.715796),
    "hertz_E_100GPa": (7.271409, 5.256087),
    "hertz_E_200GPa": (8.599050, 4.444580),
    "hertz_E_300GPa": (9.280603, 4.118177),
    "hertz_nu_0.1": (6.599905, 5.790866),
    "hertz_nu_0.2285": (6.686586, 5.715796),
    "hertz_nu_0.3": (6.767668, 5.647317),
    "hertz_nu_0.4": (6.927448, 5.517062),
    "linear_lambda_0.03": (4.93456, 6.61366),
    "linear_lambda_0.040165": (5.70970, 5.715796),
    "linear_lambda_0.055": (6.68143, 4.88451),
    "linear_lambda_0.055085": (6.686586, 4.88074),
    "linear_lambda_0.07": (7.53767, 4.32965),
    "quadratic_lambda_10": (5.74601, 7.60501),
    "quadratic_lambda_15.7585": (6.686586, 6.53524),
    "quadratic_lambda_20": (7.23952, 6.03610),
    "quadratic_lambda_23.5542": (7.64521, 5.715796),
    "quadratic_lambda_30": (8.28718, 5.27302),
}
# (case, quantity): value, largest relative error of what was measured.
ALSO = {
    "ball_plate": {
        ("table2", "peak_force"): (6.68524, 2e-4),
        ("table2", "restitution"): (0.99962, 2.001e-4),
        ("table2", "plate_displacement_at_peak"): (3.26e-10, 0.05),
        ("table2", "plate_displacement_at_end"): (7.63e-10, 0.05),
        ("table2", "stable_time_step"): (9.19e-7, 0.04),
        **{(f"plate_{law}", "peak_force"): (6.68524, 2e-4)
           for law in ("saint_venant_kirchhoff", "neo_hooke", "orthotropic_elastic")},
        ("free_block_centre", "impulse"): (2.052223e-5, 1e-3),
        ("free_block_centre", "block_velocity"): (2.42065e-2, 1e-3),
        ("free_block_centre", "peak_force"): (6.5764, 1e-3),
        ("free_block_centre", "duration"): (5.730e-6, 2e-3),
        ("free_block_offset", "impulse"): (2.038747e-5, 1e-3),
        ("free_block_offset", "block_velocity"): (2.404750e-2, 1e-3),
        ("free_block_offset", "angular_velocity"): (8.657, 1e-3),
    },
    "thin_plate": {
        ("Z1", "restitution"): (0.7619, 3e-3),
        ("Z1", "peak_force"): (4.876, 3e-3),
        ("Z2", "restitution"): (0.5403, 3e-3),
        ("Z2", "peak_force"): (9.558, 3e-3),
        ("Z3", "restitution"): (0.2560, 3e-3),
        ("Z3", "peak_force"): (15.910, 3e-3),
        ("Z1_corrected", "impulse"): (1.82682e-5, 0.002 / 1.7586),
        ("Z2_corrected", "impulse"): (5.0428e-5, 0.002 / 1.5336),
        ("Z3_corrected", "impulse"): (1.38521e-4, 0.002 / 1.2482),
        # shear-deformable plate, another program
        ("sides_clamped", "restitution_minus_supported"): (0.00254, 0.001 / 0.00254),
        ("sides_supported", "restitution"): (0.76666, 3e-5),  # solid_plate.py
        ("sides_clamped", "restitution"): (0.76865, 3e-5),
    },
}
# case: restitution, peak force [N], duration [us], displacement of the plate at the end [um] of three-dimensional elasticity:
# axisymmetric finite elements that resolve the contact.
ELASTIC = {
    "Z1_corrected": (0.7586, 4.911, 6.881, 0.582),
    "Z2_corrected": (0.5336, 9.658, 9.798, 1.591),
    "Z3_corrected": (0.2482, 16.058, 17.246, 4.330),
    "steel_1.0mm_corrected": (0.8967, 6.299, 5.764, 0.208),
    "steel_0.75mm_corrected": (0.8272, 6.021, 5.816, 0.353),
    "steel_0.5mm_corrected": (0.6609, 5.344, 5.992, 0.716),
    "steel_0.3mm_corrected": (0.3263, 3.922, 6.821, 1.573),
}
Z2_DURATION = 9.81243e-6
# Quantity of the cubic walls: largest value; contact is never lost.
SMOOTH_WALL = {"rms_error_same_surface": 1e-3, "rms_error_sine": 2e-3, "steps_without_contact": 0.0}
# Quantity of every run of trb: largest value.
TRB = {"impulse_error": 1e-10, "energy_drift": 1e-3, "overlap_at_start": 1e-4}
# Force over the weight in troughs and on crests, 1 +- v^2 kappa / (g (1 -+ kappa r)), v = 0.2995 m/s in the troughs.
TROUGH, CREST = 1.432, 0.678
# The drum: 5,000 particles of 2.1 to 2.9 mm and 2500 kg/m3 weigh 8.21 N; (case, quantity): value, largest error of it.
DRUM = {
    ("settle", "force_at_rest"): (8.212, 0.01),
    ("nurbs/triangles", "angle_of_repose"): (40.5, 1.5),
    ("nurbs/triangles", "power"): (0.422, 0.01),
    **{(f"ranks_{n}", f"{what}_difference"): (0.0, 1e-9) for n in (2, 4) for what in ("position", "velocity")},
    **{(f"alone_{n}", f"{what}_difference"): (0.0, 1e-14) for n in (2, 4) for what in ("position", "velocity")},
}
OMEGA, STEADY = 2.0 * math.pi / 4.0, 1.2  # of the drum [1/s], [s]
BALANCE = {
    "ball_plate": ["free_block_centre", "free_block_offset"],
    "thin_plate": [*ELASTIC, *(case.removesuffix("_corrected") for case in ELASTIC)],
}
FIGURES = {
    "ball_plate": [f"fig{n:02d}.png" for n in range(6, 12)],
    "thin_plate": ["restitution.png", "force.png", "force_steel.png"],
    "smooth_wall": ["force.png"],
    "drum": ["drum.png"],
    "trb": ["fig13.png", "fig14.png", "stress.png", "energy.png", "overlaps.png"],
}
WITH_REFERENCE = {
    "ball_plate": 23 * 4 + 5 + 3 * 3 + 5 + 4,
    "thin_plate": 7 * 3 + 7 * 6 + 2 * 2 + 1 + 2,
    "smooth_wall": 3 + 3 + 1,
    "drum": 3 + 2 + 2 * 2 + 2 * 2,
    "trb": 5 * 7 + 1 + 14 + 2 + 2,
}
# Cases that tests ask for: rows with a reference that others have, and their figures.
LEFT_OUT = {
    ("settle", "ranks_*", "alone_*"): (4, ["drum.png"]),  # whole turns
    ("cubic*", "quadratic", "triangles_2k", "triangles_30k"): (0, []),  # finer triangles: no reference
    ("sphere_*", "linear_elastic", "saint_venant_kirchhoff", "packing_*", "one_rank"): (0, []),  # correction: no reference
}


def check(condition: bool, complaint: str) -> None:
    if not condition:
        sys.exit(f"check_study: {complaint}")


def check_rule(row: dict) -> None:
    """Error and pass as the summary's readers expect them, worked out anew."""
    name = f"{row['case']} {row['quantity']}"
    if row["reference"] is None:
        check(row["error"] is row["tolerance"] is row["pass"] is None, f"{name} is no information")
        return
    scale = row["reference"] or 1.0
    error = (row["value"] - row["reference"]) / scale
    check(abs(row["error"] - error) < 1e-12, f"{name}: error {row['error']}, expected {error}")
    check(row["pass"] is True, f"{name} = {row['value']} does not pass")
    check(abs(error) <= row["tolerance"], f"{name}: error {error} above {row['tolerance']}")


def check_values(deck: str, rows: dict) -> None:
    """Measured values against this file's references and tolerances."""
    expected = dict(ALSO[deck])
    if deck == "ball_plate":
        for case, (peak, duration_us) in BALL_PLATE.items():
            expected[case, "peak_force"] = (peak, 1e-3)
            expected[case, "duration"] = (duration_us * 1e-6, 2e-3)
            expected[case, "impulse"] = (2.0776399e-5, 1e-3)
            check(rows[case, "curve_error"]["value"] <= 5e-3, f"{case}: curve_error")
    if deck == "thin_plate":
        for case, (e, peak, duration_us, displacement_um) in ELASTIC.items():
            expected[case, "restitution"] = (e, 0.002 / e)
            expected[case, "peak_force"] = (peak, 0.004)
            expected[case, "duration"] = (duration_us * 1e-6, 0.004)
            expected[case, "plate_displacement_at_end"] = (displacement_um * 1e-6, 0.01)
    for key, (reference, tolerance) in expected.items():
        error = abs(rows[key]["value"] / reference - 1.0)
        value = rows[key]["value"]
        check(error <= tolerance, f"{key}: {value}, expected {reference} +- {tolerance}")
    for case in BALANCE[deck]:
        drift = rows[case, "momentum_balance"]["value"]
        check(0.0 < drift <= 1e-12, f"{case}: momentum_balance {drift}")


def check_force_history(path: Path, dt: float, least: int = 400) -> None:
    """t_n = n dt from step 1 on; positive force exactly where bodies overlap; then apart."""
    with open(path, newline="", encoding="utf-8") as file:
        header, *lines = csv.reader(file)
    check(header == ["t", "F", "overlap", "plate_displacement"], f"{path.name}: header {header}")
    samples = [tuple(map(float, line)) for line in lines]
    check(len(samples) > least, f"{path.name}: only {len(samples)} samples")
    for n, (t, F, overlap, _) in enumerate(samples, start=1):
        check(abs(t - n * dt) < 1e-6 * dt, f"{path.name}: sample {n} at t = {t}")
        check((F > 0.0) == (overlap > 0.0), f"{path.name}: F = {F}, overlap = {overlap} at t = {t}")
    check(samples[-1][1] == 0.0, f"{path.name}: the contact has not ended")


def check_smooth_wall(rows: dict, out: Path, asked_for: list[str]) -> None:
    """The smooth wall by its bounds and by the forces in troughs and on crests; triangles are far from it."""
    for case in ("cubic", "cubic_across_the_face"):
        for quantity, bound in SMOOTH_WALL.items():
            value = rows[case, quantity]["value"]
            check(0.0 <= value <= bound, f"{case} {quantity}: {value}, expected at most {bound}")
    quadratic = rows["quadratic", "rms_error_same_surface"]["value"]
    check(5e-3 < quadratic < 2e-2, f"quadratic rms_error_same_surface: {quadratic}, expected about 1e-2")
    for triangles in ("2k", "30k", "120k")[: 2 if asked_for else 3]:
        error = rows[f"triangles_{triangles}", "rms_error_sine"]["value"]
        check(0.5 < error < 10.0, f"triangles_{triangles} rms_error_sine: {error}, expected 1 to 4")
    with open(out / "contact_force_cubic.csv", newline="", encoding="utf-8") as file:
        samples = [(float(row["t"]), float(row["F"])) for row in csv.DictReader(file)]
    check(len(samples) == 12000, f"{len(samples)} samples")
    weight = 9.81 * 2500.0 * 4.0 / 3.0 * math.pi * 0.5e-3**3
    settled = [F / weight for t, F in samples if t > 0.02]
    for value, expected in ((max(settled), TROUGH), (min(settled), CREST)):
        check(abs(value / expected - 1.0) < 5e-3, f"cubic: force over weight {value}, expected {expected}")


def check_drum(rows: dict, out: Path) -> None:
    """The drum by its weight, and by torque times angular velocity, which is another column than the power."""
    for key, (expected, tolerance) in DRUM.items():
        if key not in rows:  # of a case that was not asked for
            continue
        value = rows[key]["value"]
        check(abs(value - expected) <= tolerance, f"{key}: {value}, expected {expected} +- {tolerance}")
    for case in {case for case, quantity in rows if quantity == "power" and "/" not in case}:
        with open(out / f"contact_force_{case}.csv", newline="", encoding="utf-8") as file:
            torque = [float(row["torque"]) for row in csv.DictReader(file) if float(row["t"]) > STEADY]
        power = OMEGA * sum(torque) / len(torque)
        value = rows[case, "power"]["value"]
        check(abs(value / power - 1.0) < 1e-6, f"{case}: power {value}, torque times angular velocity {power}")


def check_trb(rows: dict, out: Path) -> None:
    """The stream on the blank: exact balances, force and deflection from the file; what is kept for ParaView."""
    for case in ("linear_elastic", "saint_venant_kirchhoff", "packing_1", "packing_2", "packing_3"):
        for quantity, bound in TRB.items():
            value = rows[case, quantity]["value"]
            check(0.0 <= value <= bound, f"{case} {quantity}: {value}, expected at most {bound}")
    for law in ("linear_elastic", "saint_venant_kirchhoff"):
        with open(out / f"contact_force_{law}.csv", newline="", encoding="utf-8") as file:
            columns = ("t", "F", "plate_displacement")
            samples = [tuple(float(row[name]) for name in columns) for row in csv.DictReader(file)]
        check(len(samples) == 10000, f"{law}: {len(samples)} samples")
        check(all(F == 0.0 for t, F, _ in samples if t < 0.9999e-5), f"{law}: a force before 0.010 ms")
        check(max(F for t, F, _ in samples if t < 1.5e-5) > 100.0, f"{law}: no force after 0.010 ms")
        impulse = sum(1e-7 * F for _, F, _ in samples)
        check(abs(impulse / 0.142 - 1.0) < 0.10, f"{law}: impulse {impulse}, expected 0.142 +- 10 %")
        w = samples[-1][2]
        check(2.0e-3 < w < 2.8e-3, f"{law}: deflection {w}, expected 2.0 to 2.8 mm")
        for pattern, count in (("blank_*.vtu", 101), ("spheres_*.vtp", 101), ("blank.pvd", 1), ("packing.data", 1)):
            kept = len([path for path in (out / law).glob(pattern) if "boundingBox" not in path.name])
            check(kept == count, f"{law}: {kept} files {pattern}, expected {count}")
    linear, large = (rows[law, "centre_at_end"]["value"] for law in ("linear_elastic", "saint_venant_kirchhoff"))
    check(0.5 < large / linear < 0.999, f"St. Venant-Kirchhoff / linear deflection {large / linear}, expected stiffer")


def main(deck: str, run: str, out: Path, cases: list[str]) -> None:
    shutil.rmtree(out, ignore_errors=True)
    done = subprocess.run([run, deck, "--out", out, *(f"--case={case}" for case in cases)], check=False)
    check(done.returncode == 0, f"inputs/run {deck} ended with code {done.returncode}")
    summary = json.loads((out / "summary.json").read_text(encoding="utf-8"))
    check(summary["deck"] == deck, f"deck is {summary['deck']}")
    rows = {(row["case"], row["quantity"]): row for row in summary["rows"]}
    check(len(rows) == len(summary["rows"]), "a quantity stands twice")
    for row in summary["rows"]:
        check_rule(row)
    compared = sum(row["reference"] is not None for row in summary["rows"])
    left_out, not_drawn = LEFT_OUT[tuple(cases)] if cases else (0, [])
    check(compared == WITH_REFERENCE[deck] - left_out, f"{compared} rows have a reference")
    if deck == "smooth_wall":
        check_smooth_wall(rows, out, cases)
    elif deck == "drum":
        check_drum(rows, out)
    elif deck == "trb":
        check_trb(rows, out)
    else:
        check_values(deck, rows)
        for case in {row["case"] for row in summary["rows"]}:
            history, step = out / f"contact_force_{case}.csv", re.fullmatch(r"in_phase_(\d+)", case)
            if step:
                check_force_history(history, Z2_DURATION / int(step[1]), int(step[1]))
            else:
                check_force_history(history, dt=1e-8)
    for name in set(FIGURES[deck]) - set(not_drawn):
        check((out / name).stat().st_size > 20000, f"{name} is empty")


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], Path(sys.argv[3]), sys.argv[4:])

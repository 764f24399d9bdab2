#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Stands in for liggghts-nurbs: answers a deck with the closed form of a fixed wall.

FAIL_AT=VALUE in the environment: where lambda is VALUE it stops as LIGGGHTS does; HANG: it waits.
"""

import os
import re
import sys
import time
from pathlib import Path

import numpy as np

from study.reference import hertz

words = sys.argv[1:]
deck = Path(words[words.index("-in") + 1])
values = dict(re.findall(r"^variable\s+(\w+)\s+index\s+(\S+)", deck.read_text(), re.MULTILINE))
values |= {words[i + 1]: words[i + 2] for i, word in enumerate(words) if word == "-var"}
print("LIGGGHTS (closed form)")
if os.environ.get("FAIL_AT") == values["lambda"]:
    print("ERROR: Fix wall/nurbs (id plate): given nothing, expected something")
    sys.exit(1)

v = {name: float(word) for name, word in values.items() if name not in ("law", "plate", "compliance")}
E_star = hertz.effective_modulus(v["E_ball"], v["nu_ball"], 210.6e9, 0.286)
sphere = (v["r"], v["rho"], v["V"])
impact = hertz.penalty_impact(values.get("law", "hertz"), v["lambda"], E_star, *sphere)
t = v["dt"] * np.arange(1, int(v["steps"]) + 1)
overlap = np.where(t < impact.duration, impact.overlap(t), v["V"] * (impact.duration - t))
speed = np.gradient(-overlap, t)
speed[-1] = v["V"]
zero = 0.0 * t
columns = {
    "in.ball_plate": ("t,v,stable_time_step", [t, speed, zero]),
    "in.free_block": ("t,vx,vy,vz,px,py,pz,Ly", [t, zero, zero, speed] + 4 * [zero]),
    "in.thin_plate": ("t,v,p", [t, speed, zero]),
}


def write(file, header, data):
    np.savetxt(file, np.transpose(data), "%.15g", ",", header=header, comments="")


write("contact_force.csv", "t,F,overlap,plate_displacement", [t, impact.force(t), overlap, zero])
write("state.csv", *columns[deck.name])
if "HANG" in os.environ:
    time.sleep(60)

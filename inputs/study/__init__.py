# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the cases of a deck, compares them with their references and draws the figures.

cli      what the user typed (usage: words that name nothing)
case     a deck's study: its cases, their variables, what a run left behind
batch    the chosen cases, from their variables to the files in out/<deck>/
solver   starts the runs, a few at a time (progress: how far they are)
pulse    peak, duration and impulse of a contact force
hertz    closed forms of an impact on a rigid wall
zener    an impact on a thin plate
sliding  a ball that slides on a surface without friction
waves    a surface of waves: spline, model file, triangles
rotating_drum  a closed drum: model file, triangles; a bed in it and its slope
summary  rows, table, JSON
figures  contact force against time
"""

# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the cases of a deck, compares them with their references and draws the figures.

cli      what the user typed
case     a deck's study: its cases, their variables, what a run left behind
solver   starts the runs, a few at a time
pulse    peak, duration and impulse of a contact force
hertz    closed forms of an impact on a rigid wall
zener    an impact on a thin plate
summary  rows, table, JSON
figures  contact force against time
"""

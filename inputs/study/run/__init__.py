# SPDX-License-Identifier: GPL-2.0-or-later
"""From the user's words to runs, and from what they leave to rows and figures.

cli       what the user typed (usage: words that name nothing)
case      a deck's study: its cases, their variables, what a run left behind
batch     the chosen cases, from their variables to the files in out/<deck>/
solver    starts the runs, a few at a time (progress: how far they are)
pulse     peak, duration and impulse of a contact force
bed       the slope of particles in a turning drum
summary   rows, table, JSON
figures   contact force against time, restitution against inelasticity
"""

# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs the cases of a deck, compares them with their references and draws the figures.

build      writes what decks read: walls as splines and triangles, particles
run        from the user's words to runs, and from what they leave to rows and figures
reference  closed forms and exact motions: what results are compared with
"""

# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes what decks read: geometry and particles.

waves  a wall of waves: spline, model file, triangles
drum   a closed drum: model file, triangles, particles to fill it
stl    triangles as text
"""

# SPDX-License-Identifier: GPL-2.0-or-later
"""Closed forms and exact motions: what results are compared with.

hertz         an impact on a rigid wall, any power law
zener         an impact on a thin plate
mindlin       an impact on a plate that shears
sliding       a ball that slides on a surface without friction
wavy_surface  the wavy wall as a surface to slide on
"""

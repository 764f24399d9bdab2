# SPDX-License-Identifier: GPL-2.0-or-later
"""Forces over meshes: Table 2's ball on blocks, and balls on thin plates, of ever smaller elements."""

from __future__ import annotations

import sys
from pathlib import Path

from study.run.case import Study

sys.path.insert(0, str(Path(__file__).parent))
import thick_blocks  # noqa: E402  (files of this folder)
import thin_plates  # noqa: E402

STUDY = Study(
    cases=[*thick_blocks.CASES, *thin_plates.CASES],
    figures=[thick_blocks.FIGURE, thin_plates.FIGURE],
    comparisons=[*thick_blocks.COMPARISONS, *thin_plates.COMPARISONS],
)

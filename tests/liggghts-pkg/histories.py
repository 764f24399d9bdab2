# SPDX-License-Identifier: GPL-2.0-or-later
"""Histories of a solid (HDF5), as a user reads them."""

from pathlib import Path

import h5py
import numpy as np


def read(path: Path) -> dict[str, np.ndarray]:
    """The data sets by name, as many rows of each as are complete: those that `time` has."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.update({name: item[()]} if isinstance(item, h5py.Dataset) else {}))
    return {name: values[: len(found["time"])] for name, values in found.items()}

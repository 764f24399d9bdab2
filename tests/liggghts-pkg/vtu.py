# SPDX-License-Identifier: GPL-2.0-or-later
"""Reads what fix wall/nurbs writes for ParaView, with VTK's own reader."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy


@dataclass
class State:
    """One .vtu file: coefficients on points and constants on cells, and the points of each cell."""

    points: np.ndarray  # n x 3
    fields: dict[str, np.ndarray]  # n or n x 3
    elements: dict[str, np.ndarray]
    cells: list[list[int]]

    def integral_on_parallelograms(self, name: str, element_area: float) -> np.ndarray:
        """Of a field on equal flat elements with affine parameters: there Bernstein polynomials have one integral."""
        return element_area * sum(self.fields[name][cell].mean(axis=0) for cell in self.cells)


def read(path: Path) -> State:
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()

    def arrays(data) -> dict[str, np.ndarray]:
        return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}

    cells = []
    for c in range(grid.GetNumberOfCells()):
        cell = grid.GetCell(c)
        cells.append([cell.GetPointId(k) for k in range(cell.GetNumberOfPoints())])
    points = vtk_to_numpy(grid.GetPoints().GetData())
    return State(points, arrays(grid.GetPointData()), arrays(grid.GetCellData()), cells)


def series(path: Path) -> dict[float, Path]:
    """Time -> file of a .pvd."""
    entries = ElementTree.parse(path).getroot().iter("DataSet")
    return {float(e.attrib["timestep"]): path.parent / e.attrib["file"] for e in entries}

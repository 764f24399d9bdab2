# SPDX-License-Identifier: GPL-2.0-or-later
"""The rear half of the blank as it is bent, cut at y = 0 and coloured by von Mises stress, under the rear half of the spheres;
rendered off-screen.

usage: stress_picture.py FOLDER OUT.png STEP=FIELDS.vtu=LABEL ...      (in FOLDER: spheres_STEP.vtp and the fields)
Needs an X server: xvfb-run.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import vtk
from picture import HEIGHT, SUBDIVISION, WIDTH, colour_bar, render, spheres, words
from states import State
from vtk.util.numpy_support import vtk_to_numpy

MPA = 1e6
LARGEST = 40.0  # MPa, the end of the colours
COLOURS = (  # viridis
    (0.267, 0.005, 0.329), (0.275, 0.195, 0.496), (0.213, 0.359, 0.552), (0.153, 0.497, 0.558), (0.122, 0.633, 0.531),
    (0.290, 0.759, 0.428), (0.622, 0.854, 0.226), (0.993, 0.906, 0.144),
)  # fmt: skip


def colours() -> vtk.vtkColorTransferFunction:
    """Of MPa."""
    table = vtk.vtkColorTransferFunction()
    for i, colour in enumerate(COLOURS):
        table.AddRGBPoint(LARGEST * i / (len(COLOURS) - 1), *colour)
    return table


def blank(path: Path) -> vtk.vtkActor:
    """Displacements as they are; Bezier cells, and so coefficients, until the surface filter evaluates them."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutput()
    centres = vtk.vtkCellCenters()
    centres.SetInputData(grid)
    centres.Update()
    rear = vtk.vtkExtractCells()  # elements meet at y = 0
    rear.SetInputData(grid)
    cells = vtk.vtkIdList()
    for cell in np.flatnonzero(vtk_to_numpy(centres.GetOutput().GetPoints().GetData())[:, 1] > 0.0):
        cells.InsertNextId(int(cell))
    rear.SetCellList(cells)
    bent = vtk.vtkWarpVector()
    bent.SetInputConnection(rear.GetOutputPort())
    bent.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, "displacement")
    stress = vtk.vtkArrayCalculator()
    stress.SetInputConnection(bent.GetOutputPort())
    stress.AddScalarArrayName("von_mises")
    stress.SetFunction(f"von_mises / {MPA:g}")
    stress.SetResultArrayName("MPa")
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputConnection(stress.GetOutputPort())
    surface.SetNonlinearSubdivisionLevel(SUBDIVISION)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(surface.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("MPa")
    mapper.SetLookupTable(colours())
    mapper.UseLookupTableScalarRangeOn()
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()  # colours as in the legend
    return actor


def rear_half(path: Path, step: int) -> vtk.vtkActor:
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    data = reader.GetOutput()
    x, r = vtk_to_numpy(data.GetPoints().GetData()), vtk_to_numpy(data.GetPointData().GetArray("radius"))
    behind = x[:, 1] > 0.0
    none = (np.empty(0, dtype=int), np.empty(0))
    actor = spheres(State(step, x[behind], np.zeros((behind.sum(), 3)), r[behind], none))
    actor.GetMapper().ScalarVisibilityOff()
    actor.GetProperty().SetColor(0.80, 0.80, 0.78)
    actor.GetProperty().SetAmbient(0.25)
    return actor


def legend() -> vtk.vtkScalarBarActor:
    bar = colour_bar(colours())
    bar.SetOrientationToHorizontal()
    bar.SetTextPositionToPrecedeScalarBar()
    bar.SetPosition(0.35, 0.02)
    bar.SetWidth(0.61)
    bar.SetHeight(0.13)
    return bar


def view(folder: Path, step: int, fields: str, label: str) -> vtk.vtkRenderer:
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AddActor(blank(folder / fields))
    renderer.AddActor(rear_half(folder / f"spheres_{step}.vtp", step))
    renderer.AddActor2D(words(label, 16, HEIGHT - 40, 26))
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0.0005, 0.012, 0.0005)
    camera.SetPosition(-0.018, -0.106, 0.032)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(21.5)
    renderer.ResetCameraClippingRange()
    return renderer


def draw(folder: Path, out: Path, shown: list[list[str]]) -> None:
    renderers = [view(folder, int(step), fields, label) for step, fields, label in shown]
    renderers[0].AddActor2D(legend())
    renderers[0].AddActor2D(words("von Mises stress, MPa", 16, 30, 20))
    render(renderers, out)


if __name__ == "__main__":
    draw(Path(sys.argv[1]), Path(sys.argv[2]), [word.split("=", 2) for word in sys.argv[3:]])

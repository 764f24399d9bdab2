# SPDX-License-Identifier: GPL-2.0-or-later
"""Six states of a run side by side, rendered off-screen: spheres by vertical velocity, the blank's exact surface.

usage: picture.py FOLDER OUT.png STEP=LABEL ...      (in FOLDER: spheres.dump, contacts.dump, blank_STEP.vtu)
Needs an X server: xvfb-run.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Sequence

import vtk
from states import State, read_states
from vtk.util.numpy_support import numpy_to_vtk

WIDTH, HEIGHT = 720, 400  # of one state
FASTEST = 10.0  # m/s, the end of the colours
SUBDIVISION = 3  # of each Bezier cell's edges: 2^3 parts


def colours() -> vtk.vtkLookupTable:
    """Blue falls, red rises."""
    table = vtk.vtkColorTransferFunction()
    table.SetColorSpaceToDiverging()
    table.AddRGBPoint(-FASTEST, 0.11, 0.28, 0.66)
    table.AddRGBPoint(0.0, 0.90, 0.90, 0.88)
    table.AddRGBPoint(FASTEST, 0.72, 0.08, 0.10)
    return table


def spheres(state: State) -> vtk.vtkActor:
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(state.x, deep=True))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    for name, values in (("diameter", 2.0 * state.r), ("velocity", state.v[:, 2].copy())):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        data.GetPointData().AddArray(array)
    ball = vtk.vtkSphereSource()
    ball.SetThetaResolution(16)
    ball.SetPhiResolution(16)
    glyphs = vtk.vtkGlyph3DMapper()
    glyphs.SetInputData(data)
    glyphs.SetSourceConnection(ball.GetOutputPort())
    glyphs.SetScaleModeToScaleByMagnitude()
    glyphs.SetScaleArray("diameter")
    glyphs.SetScalarModeToUsePointFieldData()
    glyphs.SelectColorArray("velocity")
    glyphs.SetLookupTable(colours())
    glyphs.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(glyphs)
    return actor


def blank(path: Path) -> vtk.vtkActor:
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    surface = vtk.vtkDataSetSurfaceFilter()  # evaluates the Bezier cells
    surface.SetInputConnection(reader.GetOutputPort())
    surface.SetNonlinearSubdivisionLevel(SUBDIVISION)
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(surface.GetOutputPort())
    normals.SplittingOff()
    normals.FlipNormalsOn()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.62, 0.66, 0.70)
    actor.GetProperty().SetAmbient(0.35)
    return actor


def view(folder: Path, state: State, label: str) -> vtk.vtkRenderer:
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.AddActor(blank(folder / f"blank_{state.step}.vtu"))
    renderer.AddActor(spheres(state))
    renderer.AddActor2D(words(label, 16, HEIGHT - 40, 26))
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(0.003, -0.003, 0.0)
    camera.SetPosition(-0.030, -0.128, 0.052)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetViewAngle(25.0)
    renderer.ResetCameraClippingRange()
    return renderer


def words(text: str, x: int, y: int, size: int) -> vtk.vtkTextActor:
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    actor.GetTextProperty().SetColor(0.0, 0.0, 0.0)
    actor.GetTextProperty().SetFontSize(size)
    actor.SetPosition(x, y)
    return actor


def colour_bar(table: vtk.vtkScalarsToColors) -> vtk.vtkScalarBarActor:
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%.0f")
    bar.UnconstrainedFontSizeOn()
    font = bar.GetLabelTextProperty()
    font.SetColor(0.0, 0.0, 0.0)
    font.SetFontSize(20)
    font.ShadowOff()
    font.ItalicOff()
    return bar


def legend() -> vtk.vtkScalarBarActor:
    bar = colour_bar(colours())
    bar.SetPosition(0.86, 0.45)
    bar.SetWidth(0.12)
    bar.SetHeight(0.52)
    return bar


def draw(folder: Path, out: Path, labels: dict[int, str]) -> None:
    states = {state.step: state for state in read_states(folder)}
    renderers = [view(folder, states[step], label) for step, label in labels.items()]
    renderers[0].AddActor2D(legend())
    render(renderers, out)


def render(renderers: Sequence[vtk.vtkRenderer], out: Path) -> None:
    """Two in a row."""
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(4)
    rows = (len(renderers) + 1) // 2
    window.SetSize(2 * WIDTH, rows * HEIGHT)
    for i, renderer in enumerate(renderers):
        row, column = rows - 1 - i // 2, i % 2
        renderer.SetViewport(0.5 * column, row / rows, 0.5 * (column + 1), (row + 1) / rows)
        window.AddRenderer(renderer)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(out))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    wanted = (word.split("=", 1) for word in sys.argv[3:])
    draw(Path(sys.argv[1]), Path(sys.argv[2]), {int(step): label for step, label in wanted})

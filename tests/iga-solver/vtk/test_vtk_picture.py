# SPDX-License-Identifier: GPL-2.0-or-later
"""What ParaView draws: a rational sphere, coloured by the field z, rendered off-screen.  Its outline is a circle and
the grey of every pixel is its height.  Needs an X server: xvfb-run.  The picture goes to the path that stands first."""

from __future__ import annotations

import sys
import tempfile
import unittest

import numpy as np
import vtk
from test_vtk_reader import Patch, read
from vtk.util.numpy_support import vtk_to_numpy

PIXELS = 400
HALF_VIEW = 1.25  # of the picture's height; the sphere's radius is 1
PICTURE = sys.argv.pop(1) if len(sys.argv) > 1 and sys.argv[1].endswith(".png") else "sphere.png"


def sphere() -> Patch:
    """Piegl & Tiller (1997), example A8.1's result: four arcs of 90 degrees round, two from pole to pole."""
    s = np.sqrt(0.5)
    round_ = np.array([[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1], [1, 0]], dtype=float)
    meridian = np.array([[0, -1], [1, -1], [1, 0], [1, 1], [0, 1]], dtype=float)
    weights = np.outer([1, s, 1, s, 1], [1, s] * 4 + [1]).ravel()
    points = np.array([[rho * x, rho * y, z] for rho, z in meridian for x, y in round_])
    knots = [np.array([0.0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4]), np.array([0.0, 0, 0, 1, 1, 2, 2, 2])]
    return Patch([2, 2], knots, weights, points, points[:, 2:], points, np.arange(8.0))


def render(grid: vtk.vtkUnstructuredGrid, path: str) -> np.ndarray:
    """Grey (0 to 255) of the pixels, row 0 below; seen along y, black is z = -1, white z = 1, the background red."""
    drawing = vtk.vtkDataSetSurfaceFilter()
    drawing.SetInputData(grid)
    drawing.SetNonlinearSubdivisionLevel(4)
    grey = vtk.vtkLookupTable()
    grey.SetSaturationRange(0.0, 0.0)
    grey.SetValueRange(0.0, 1.0)
    grey.SetRampToLinear()
    grey.Build()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(drawing.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("scalar")
    mapper.SetScalarRange(-1.0, 1.0)
    mapper.SetLookupTable(grey)
    mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().LightingOff()
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1.0, 0.0, 0.0)
    renderer.AddActor(actor)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(0.0, -5.0, 0.0)
    camera.SetFocalPoint(0.0, 0.0, 0.0)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.ParallelProjectionOn()
    camera.SetParallelScale(HALF_VIEW)
    renderer.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(PIXELS, PIXELS)
    window.AddRenderer(renderer)
    window.Render()
    image = vtk.vtkWindowToImageFilter()
    image.SetInput(window)
    image.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(path)
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()
    return vtk_to_numpy(image.GetOutput().GetPointData().GetScalars()).reshape(PIXELS, PIXELS, 3).astype(float)


class Picture(unittest.TestCase):
    def test_a_sphere_is_round_and_shows_its_field(self):
        with tempfile.TemporaryDirectory() as folder:
            pixels = render(read([sphere()], folder), PICTURE)
        red = (pixels[..., 0] > 250) & (pixels[..., 1] < 5)
        pixel = 2.0 * HALF_VIEW / PIXELS
        self.assertAlmostEqual((~red).sum() * pixel**2 / np.pi, 1.0, delta=0.01)  # 8 flat cells: 0.64

        across, up = np.meshgrid(*[(np.arange(PIXELS) + 0.5) * pixel - HALF_VIEW] * 2)
        np.testing.assert_array_equal(red[np.hypot(across, up) > 1.0 + pixel], True)
        inside = np.hypot(across, up) < 1.0 - 2.0 * pixel
        np.testing.assert_array_equal(red[inside], False)
        height = pixels[..., 1] / 255.0 * 2.0 - 1.0
        np.testing.assert_allclose(height[inside], up[inside], atol=0.02)  # a grey is 0.008


if __name__ == "__main__":
    unittest.main()

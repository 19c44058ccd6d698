# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""What Python of VTK 9.4 and newer adds: properties in snake case and pipelines by >>."""
import unittest

from delaunayflip import vtkDelaunayFlip

from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkFiltersSources import vtkPlaneSource

HAS_PIPELINES = vtkVersion.GetVTKMajorVersion() * 100 + vtkVersion.GetVTKMinorVersion() >= 904


@unittest.skipUnless(HAS_PIPELINES, "needs VTK 9.4")
class NewVtk(unittest.TestCase):

    def test_properties(self):
        flip = vtkDelaunayFlip(geometry=2, live_update=True)
        self.assertEqual(flip.GetGeometry(), vtkDelaunayFlip.GEOMETRY_PLANAR_XY)
        self.assertTrue(flip.live_update)
        flip.maximum_iterations = 7
        self.assertEqual(flip.GetMaximumIterations(), 7)
        with self.assertRaises((AttributeError, TypeError)):
            vtkDelaunayFlip(geometri=2)

    def test_pipeline(self):
        plane = vtkPlaneSource(x_resolution=3, y_resolution=3)
        flip = vtkDelaunayFlip(number_of_threads=1)
        pipeline = plane >> flip
        mesh, table = pipeline.update().output
        self.assertEqual(mesh.GetNumberOfCells(), 18)
        self.assertEqual(table.GetColumnName(0), "Iteration")
        mesh, _ = (vtkDelaunayFlip() >> vtkDelaunayFlip())(mesh)
        self.assertEqual(mesh.GetNumberOfCells(), 18)


if __name__ == "__main__":
    unittest.main()

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The helpers for PyVista, trimesh and meshio, beside which the package must be installed, and the
notebook."""
import doctest
import importlib
import pathlib
import tempfile
import unittest
import warnings

import numpy

import delaunayflip

NOTEBOOK = pathlib.Path(__file__).parents[2] / "Examples" / "Python" / "pyvista_flips.ipynb"


def load(name):
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise unittest.SkipTest(f"no {name}: {error}") from None


class Docstrings(unittest.TestCase):

    def check(self, other):
        load(other)
        module = importlib.import_module(f"delaunayflip.{other}")
        results = doctest.testmod(module)
        self.assertGreater(results.attempted, 0)
        self.assertEqual(results.failed, 0)

    def test_pyvista(self):
        self.check("pyvista")

    def test_trimesh(self):
        self.check("trimesh")

    def test_meshio(self):
        self.check("meshio")


class MeshIO(unittest.TestCase):

    def test_other_cells_stay(self):
        meshio = load("meshio")
        from delaunayflip.meshio import flip
        points = [[0.0, 0, 0], [2, -1, 0], [4, 0, 0], [2, 1, 0]]
        cells = [("triangle", [[0, 1, 2]]), ("vertex", [[3]]), ("triangle", [[0, 2, 3]])]
        better = flip(meshio.Mesh(points, cells, cell_data={"n": [[5], [6], [7]]}))
        self.assertEqual([block.type for block in better.cells], ["triangle", "vertex", "triangle"])
        self.assertEqual(len(better.cells[2].data), 1)
        flipped = {frozenset(row) for row in better.cells_dict["triangle"].tolist()}
        self.assertEqual(flipped, {frozenset((0, 1, 3)), frozenset((1, 2, 3))})
        self.assertEqual([values.tolist() for values in better.cell_data["n"]], [[5], [6], [7]])
        fixed = flip(meshio.Mesh(points, [*cells, ("line", [[0, 2]])]))
        self.assertIn([0, 1, 2], fixed.cells[0].data.tolist())


class PyVista(unittest.TestCase):

    def setUp(self):
        self.pyvista = load("pyvista")
        if not hasattr(self.pyvista, "register_dataset_accessor"):
            self.skipTest("needs PyVista 0.48")
        self.mesh = self.pyvista.Plane(i_resolution=12, j_resolution=12)
        self.mesh.points[:, 0] += 2.5 * self.mesh.points[:, 1]  # quads, which become slivers
        self.mesh.cell_data["Number"] = numpy.arange(self.mesh.n_cells)

    def test_accessor_comes_with_the_package(self):
        """By its entry point; nothing of delaunayflip.pyvista is imported here."""
        better = self.mesh.delaunay.flip(quality=True, flip_counts=True, geometry="planar")
        self.assertEqual(better.n_cells, 2 * self.mesh.n_cells)
        self.assertEqual(int(better.field_data["DelaunayFlip:Converged"][0]), 1)
        numpy.testing.assert_array_equal(better.points, self.mesh.points)
        numpy.testing.assert_array_equal(better["Number"], numpy.repeat(self.mesh["Number"], 2))
        self.assertGreater(better["vtkDelaunayFlipCount"].max(), 0)
        self.assertEqual(self.mesh.n_cells, 144)
        arrays = delaunayflip.smallest_angles(better.points, better.faces.reshape(-1, 4)[:, 1:])
        numpy.testing.assert_array_equal(better.delaunay.smallest_angles(), arrays)
        self.assertGreater(arrays.min(), self.mesh.triangulate().delaunay.smallest_angles().min())

    def test_constraints(self):
        line = self.pyvista.Line(self.mesh.points[0], self.mesh.points[-1], resolution=1)
        better = self.mesh.delaunay.flip(constraints=line)
        self.assertGreater(int(better.field_data["DelaunayFlip:ConstraintEdges"][0]), 0)

    def test_errors(self):
        with self.assertRaisesRegex(delaunayflip.InvalidOptions, "tie rule"):
            self.mesh.delaunay.flip(geometry="surface", tie_rule="canonical")
        with self.assertRaisesRegex(ValueError, "planar-xy"):
            self.mesh.delaunay.flip(geometry="round")
        with self.assertRaisesRegex(TypeError, "geometri"):
            self.mesh.delaunay.flip(geometri="planar")
        self.mesh.points[5] = numpy.nan
        with self.assertWarnsRegex(UserWarning, "NaN|finite"):
            self.mesh.delaunay.flip()

    def test_pictures(self):
        with tempfile.TemporaryDirectory() as folder, warnings.catch_warnings():
            warnings.simplefilter("error", UserWarning)
            picture = pathlib.Path(folder, "quality.png")
            self.mesh.delaunay.plot_quality(off_screen=True, screenshot=str(picture))
            self.assertGreater(picture.stat().st_size, 1000)
            film = pathlib.Path(folder, "flips.gif")
            last = self.mesh.delaunay.animate(str(film), window_size=(160, 120))
            frames = load("imageio").mimread(film)
        self.assertGreaterEqual(len(frames), 3)
        self.assertGreater(numpy.abs(frames[0].astype(int) - frames[-1]).max(), 50)
        numpy.testing.assert_array_equal(last.faces, self.mesh.delaunay.flip().faces)


class Notebook(unittest.TestCase):

    def test_runs_and_draws(self):
        nbformat, nbclient = load("nbformat"), load("nbclient")
        load("pyvista")
        notebook = nbformat.read(NOTEBOOK, as_version=4)
        self.assertEqual([cell for cell in notebook.cells if cell.get("outputs")], [])
        with tempfile.TemporaryDirectory() as folder:
            nbclient.NotebookClient(
                notebook, timeout=300, resources={"metadata": {"path": folder}}).execute()
        outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
        kinds = [kind for output in outputs for kind in output.get("data", {})]
        self.assertGreaterEqual(kinds.count("image/png"), 2)


if __name__ == "__main__":
    unittest.main()

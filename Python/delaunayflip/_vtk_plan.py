# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Computes the progress of an update from the progress of its parts, one after the other."""

#: Times per item, relative to the engine's time per triangle.
_PER_POLYGON_POINT = 0.1
_PER_CONSTRAINT = 0.5
_PER_CELL = 0.3
_PER_OUTPUT = 0.4


class Plan:
    """The shares of time of the parts of a mesh's update: "polygons", "constraints" (with
    regions), "session" and "output"."""

    def __init__(self, mesh, others, settings, observer):
        """`observer` is called with the share of the whole update; returning False aborts."""
        self._observer = observer
        corners = sum(cells.GetNumberOfConnectivityIds()
                      for cells in (mesh.GetPolys(), mesh.GetStrips()))
        triangles = corners - 2 * (mesh.GetNumberOfPolys() + mesh.GetNumberOfStrips())
        constraints = others.GetNumberOfCells() if others is not None else 0
        constraints += mesh.GetNumberOfLines() if settings.lines else 0
        cells = mesh.GetNumberOfCells() if settings.region_array else 0
        only_triangles = mesh.GetNumberOfStrips() == 0 and corners == 3 * mesh.GetNumberOfPolys()
        work = {
            "polygons": 0 if only_triangles else _PER_POLYGON_POINT * corners,
            "constraints": _PER_CONSTRAINT * constraints + _PER_CELL * cells,
            "session": triangles,
            "output": _PER_OUTPUT * triangles,
        }
        total = max(sum(work.values()), 1)
        self._parts, begin = {}, 0.0
        for name, amount in work.items():
            self._parts[name] = (begin, amount / total)
            begin += amount / total

    def part(self, name):
        """An observer of one part, from 0 to 1."""
        begin, length = self._parts[name]
        return lambda share: self._observer(begin + length * share)

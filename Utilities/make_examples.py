#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the files of the documentation's examples: small meshes of bad triangles.

terrain.vtp: survey points in metres, see make_terrain.py; road.vtk: a line over it.
scan.ply: a bumpy ring, as a laser scanner gives it; edges.ply: a square ring with sharp edges. part.stl:
an elliptic cylinder, as a CAD program writes it. plate.vtk: a plane of two materials, with a cell
array Material. survey.csv: points of a valley without triangles, with river.vtk, the four lines of a river's bed and banks, area.vtk, the
outline of the survey, and pond.vtk. stations.csv: longitudes and latitudes on a globe, warmth.csv: with
temperatures, and land.vtk: the coasts of two continents there. fort.14: an ADCIRC grid of a basin that
crosses 180 degrees, with depths. Equal arguments give equal files.
"""
import argparse
import os
import sys

try:
    import numpy as np
    from make_terrain import EASTING, NORTHING, fractal_field, make_terrain, sample
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter
except ImportError as missing:
    sys.exit(f"{missing}. The examples need NumPy and VTK for this Python: pip install numpy vtk, or on "
             "Debian python3-numpy and python3-vtk9 with /usr/bin/python3.")

VTK_HEADER = "# vtk DataFile Version 3.0\n{}\nASCII\nDATASET POLYDATA\nPOINTS {} double\n"


def grid_triangles(rows, columns, random, closed=False):
    """Two triangles per cell of a grid, cut along a random diagonal; closed: the last row and
    column join the first."""
    last_row, last_column = (rows, columns) if closed else (rows - 1, columns - 1)
    i, j = (a.ravel() for a in np.mgrid[:last_row, :last_column])
    following = (i + 1) % rows, (j + 1) % columns
    a, b = i * columns + j, i * columns + following[1]
    d, c = following[0] * columns + j, following[0] * columns + following[1]
    other = random.random(len(a)) < 0.5
    first = np.where(other[:, None], np.stack([a, b, d], 1), np.stack([a, b, c], 1))
    second = np.where(other[:, None], np.stack([b, c, d], 1), np.stack([a, c, d], 1))
    return np.concatenate([first, second])


def ring(random, around=96, across=48):
    """A torus with bumps and with uneven points in skew rows: (points, triangles)."""
    u, v = np.mgrid[:around, :across].reshape(2, -1).astype(float)
    v += 1.5 * u  # three times around at the end, so that the last row meets the first
    u = (u + random.uniform(-0.24, 0.24, u.shape)) * 2 * np.pi / around
    v = (v + random.uniform(-0.24, 0.24, v.shape)) * 2 * np.pi / across
    tube = 0.4 + 0.03 * np.sin(5 * u) * np.cos(3 * v)
    distance = 1 + tube * np.cos(v)
    points = np.stack([distance * np.cos(u), distance * np.sin(u), tube * np.sin(v)], 1)
    return points, grid_triangles(around, across, random, closed=True)


def square_ring(random, around=64, across=48):
    """A ring of a tube with four sides and sharp edges; its points lie in bent rows, with noise."""
    u, v = np.mgrid[:around, :across].reshape(2, -1).astype(float)
    beside = v % (across // 4) > 0  # not on an edge
    u += 2.5 * np.sin(4 * np.pi * v / across) ** 2 + random.uniform(-0.3, 0.3, u.shape)
    v += random.uniform(-0.3, 0.3, v.shape) * beside
    u, v = u * 2 * np.pi / around, v * 2 * np.pi / across + np.pi / 4
    tube = 0.3 / np.maximum(abs(np.cos(v)), abs(np.sin(v))) + random.normal(0, 0.005, v.shape)
    distance = 1 + tube * np.cos(v)
    points = np.stack([distance * np.cos(u), distance * np.sin(u), tube * np.sin(v)], 1)
    return points, grid_triangles(around, across, random, closed=True)


def cylinder(sides=48):
    """Elliptic, of height 2; its lids are fans from one point of the rim: (points, triangles)."""
    angle = np.arange(sides) * 2 * np.pi / sides
    rim = np.stack([2 * np.cos(angle), np.sin(angle)], 1)
    points = np.concatenate([np.c_[rim, np.zeros(sides)], np.c_[rim, np.full(sides, 2.0)]])
    i = np.arange(sides)
    j = (i + 1) % sides
    walls = np.concatenate([np.stack([i, j, j + sides], 1), np.stack([i, j + sides, i + sides], 1)])
    k = np.arange(1, sides - 1)
    top = np.stack([np.zeros_like(k), k, k + 1], 1) + sides
    bottom = np.stack([np.zeros_like(k), k + 1, k], 1)
    return points, np.concatenate([walls, top, bottom])


def plate(random, side=40):
    """A square with columns that are waves: (points, triangles, the material of each triangle)."""
    x, y = np.mgrid[:side, :side].reshape(2, -1) / (side - 1.0)
    inside = (x > 0) & (x < 1) & (y > 0) & (y < 1)
    x += 0.75 * x * (1 - x) * np.sin(2 * np.pi * y)
    noise = random.uniform(-0.2, 0.2, (2, len(x))) / (side - 1.0) * inside
    points = np.stack([x + noise[0], y + noise[1], np.zeros_like(x)], 1)
    triangles = grid_triangles(side, side, random)
    material = (triangles // side).max(axis=1) > side // 2
    return points, triangles, material.astype(int)


def road(points):
    """Points of the terrain near a straight line over it, from west to east."""
    plan = points[:, :2] - points[:, :2].min(axis=0)
    width, height = plan.max(axis=0)
    stations = np.stack([np.linspace(0.1, 0.9, 7) * width, np.linspace(0.3, 0.6, 7) * height], 1)
    nearest = [np.argmin(((plan - station) ** 2).sum(axis=1)) for station in stations]
    return points[nearest]


class Valley:
    """A tile of 1200 x 800 metres with a river and a pond, as an airborne scanner sees it."""

    def __init__(self, random, spacing=18.0):
        self.hills = fractal_field(random, (256, 384), 4.2)
        scattered = random.random((60_000, 2)) * [1200.0, 800.0]
        _, first = np.unique((scattered // spacing).astype(int), axis=0, return_index=True)
        scattered = scattered[np.sort(first)]
        dry = np.hypot(*((scattered - [820.0, 140.0]) / [72.0, 42.0]).T) > 1.05  # not on the pond
        self.points = self.lift(scattered[dry])
        stations = np.arange(100.0, 1101.0, 20.0)
        self.river = [self.lift(np.c_[stations, self.middle(stations) + away])
                      for away in (-15.0, -7.0, 7.0, 15.0)]
        angle = np.arange(48) * 2 * np.pi / 48
        circle = np.c_[np.cos(angle), np.sin(angle)]
        wavy = circle * (1 + 0.05 * np.sin(3 * angle) + 0.03 * np.cos(5 * angle))[:, None]
        self.area = self.lift([600.0, 400.0] + wavy * [560.0, 360.0])
        self.pond = self.lift([820.0, 140.0] + circle * [72.0, 42.0])
        self.pond[:, 2] = self.pond[:, 2].min()

    @staticmethod
    def middle(x):
        return 430 + 110 * np.sin(x / 190) + 35 * np.sin(x / 71 + 1)

    def lift(self, plan):
        """Points with heights in metres, and with the offsets of a map."""
        x, y = plan.T
        away = np.abs(y - self.middle(x))
        hills = 38 + 26 * sample(self.hills, plan * 10)  # which spans ten times as much
        height = 300 - 0.01 * x + (1 - np.exp(-((away / 170) ** 2))) * hills
        height += np.interp(away, [7, 15], [-9, 0])
        return np.c_[x + EASTING, y + NORTHING, height].round(2)


def rows_of(numbers):
    return "".join(" ".join(repr(value) for value in row) + "\n" for row in numbers.tolist())


def polygons(triangles):
    cells = np.c_[np.full(len(triangles), 3), triangles]
    return f"POLYGONS {len(cells)} {cells.size}\n{rows_of(cells)}"


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def write_lines(folder, name, title, lines):
    sizes = np.cumsum([0] + [len(line) for line in lines])
    rows = [[end - begin, *range(begin, end)] for begin, end in zip(sizes, sizes[1:])]
    write(folder, name, VTK_HEADER.format(title, sizes[-1]) + rows_of(np.concatenate(lines))
          + f"LINES {len(lines)} {sizes[-1] + len(lines)}\n"
          + "".join(" ".join(map(str, row)) + "\n" for row in rows))


def write_valley(folder, valley):
    write(folder, "survey.csv", "x,y,z\n" + rows_of(valley.points).replace(" ", ","))
    write_lines(folder, "river.vtk", "A river", valley.river)
    for name, ring in (("area", valley.area), ("pond", valley.pond)):
        write_lines(folder, f"{name}.vtk", f"A ring: {name}", [np.r_[ring, ring[:1]]])


def write_stations(folder, random, single=500, centers=6, around=80):
    """Stations in degrees, with temperatures: some anywhere, some around a few places, and one at each
    pole."""
    places = random.normal(size=(centers, 3))
    places /= np.linalg.norm(places, axis=1, keepdims=True)
    near = np.repeat(places, around, axis=0) + 0.12 * random.normal(size=(centers * around, 3))
    x, y, z = np.concatenate([random.normal(size=(single, 3)), near, [[0, 0, 1], [0, 0, -1]]]).T
    degrees = np.degrees(np.c_[np.arctan2(y, x), np.arctan2(z, np.hypot(x, y))]).round(3)
    longitude, latitude = np.radians(degrees).T
    waves = np.sin(2 * longitude + 3 * latitude) + np.sin(3 * longitude - 1) * np.cos(2 * latitude)
    temperatures = 28 - 50 * np.sin(latitude) ** 2 + 6 * np.cos(latitude) * waves
    write(folder, "stations.csv", "longitude,latitude\n" + rows_of(degrees).replace(" ", ","))
    rows = rows_of(np.c_[degrees, temperatures.round(1)])
    write(folder, "warmth.csv", "longitude,latitude,temperature\n" + rows.replace(" ", ","))


def write_land(folder, corners=90):
    """The coasts of two continents in degrees; the second one crosses 180 degrees. They have bays."""
    turn = np.linspace(0, 2 * np.pi, corners + 1)[:, None]
    coasts = []
    for longitude, latitude, size, waves in ((-25, 15, 32, (3, 7)), (170, -15, 24, (2, 9))):
        radius = size * (1 + 0.3 * np.sin(waves[0] * turn + 1) + 0.12 * np.sin(waves[1] * turn))
        away = radius * np.c_[np.cos(turn), np.sin(turn)]
        coast = np.c_[longitude + away[:, 0], latitude + away[:, 1], np.zeros(corners + 1)].round(3)
        coasts.append(np.r_[coast[:-1], coast[:1]])
    write_lines(folder, "land.vtk", "Two coasts", coasts)


def write_basin(folder, random, rows=24, columns=40):
    """A grid in the format of ADCIRC, in degrees, without boundary conditions."""
    row, column = np.mgrid[:rows, :columns].reshape(2, -1).astype(float)
    column += 1.2 * row + random.uniform(-0.2, 0.2, row.shape)
    longitude, latitude = 160 + 0.8 * column, -12 + row + random.uniform(-0.2, 0.2, row.shape)
    depth = 4000 - 6 * (latitude + 1) ** 2
    nodes = np.c_[(longitude + 180) % 360 - 180, latitude, depth].round(4)
    triangles = grid_triangles(rows, columns, random) + 1
    lines = ["A basin", f"{len(triangles)} {len(nodes)}"]
    lines += [f"{i} {x} {y} {z}" for i, (x, y, z) in enumerate(nodes, 1)]
    lines += [f"{i} 3 {a} {b} {c}" for i, (a, b, c) in enumerate(triangles, 1)]
    lines += ["0 = number of open boundaries", "0 = number of their nodes"]
    lines += ["0 = number of land boundaries", "0 = number of their nodes", ""]
    write(folder, "fort.14", "\n".join(lines))


def write_terrain(folder, count):
    mesh = make_terrain(count, seed=4)
    writer = vtkXMLPolyDataWriter()
    writer.SetDataModeToBinary()
    writer.SetFileName(os.path.join(folder, "terrain.vtp"))
    writer.SetInputData(mesh)
    writer.Write()
    write_lines(folder, "road.vtk", "A road", [road(vtk_to_numpy(mesh.GetPoints().GetData()))])


def write_ply(folder, name, points, triangles):
    write(folder, name, "ply\nformat ascii 1.0\n"
          f"element vertex {len(points)}\n" + "".join(f"property double {a}\n" for a in "xyz")
          + f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
          + rows_of(points) + rows_of(np.c_[np.full(len(triangles), 3), triangles]))


def write_stl(folder, name, points, triangles):
    facets = ("facet normal 0 0 0\nouter loop\n"
              + "".join("vertex " + row for row in rows_of(points[triangle]).splitlines(True))
              + "endloop\nendfacet\n" for triangle in triangles)
    write(folder, name, "solid part\n" + "".join(facets) + "endsolid part\n")


def write_plate(folder, points, triangles, material):
    write(folder, "plate.vtk", VTK_HEADER.format("A plate", len(points)) + rows_of(points)
          + polygons(triangles) + f"CELL_DATA {len(triangles)}\nSCALARS Material int\n"
          + "LOOKUP_TABLE default\n" + rows_of(material[:, None]))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", nargs="?", default=".", help="where to write (default: here)")
    parser.add_argument("--terrain-points", type=int, default=2000)
    arguments = parser.parse_args()

    os.makedirs(arguments.folder, exist_ok=True)
    random = np.random.default_rng(1)
    write_terrain(arguments.folder, arguments.terrain_points)
    write_ply(arguments.folder, "scan.ply", *ring(random))
    write_stl(arguments.folder, "part.stl", *cylinder())
    write_plate(arguments.folder, *plate(random))
    write_valley(arguments.folder, Valley(random))
    write_ply(arguments.folder, "edges.ply", *square_ring(random))
    write_stations(arguments.folder, random)
    write_land(arguments.folder)
    write_basin(arguments.folder, random)
    print("terrain.vtp road.vtk scan.ply edges.ply part.stl plate.vtk survey.csv river.vtk area.vtk pond.vtk "
          "stations.csv warmth.csv land.vtk fort.14")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Particles swim in changing eddies within a square. After each step their triangulation gives the
density around each particle: the inverse of a third of the area of its triangles. At the end these
densities are interpolated to a raster by natural neighbors. It needs NumPy, not VTK.

    swimming_particles.py [PARTICLES] [STEPS]
"""
import sys

import delaunayflip
import numpy


def find_velocity(places, time):
    """The velocity of a divergence-free flow that stays in the square from 0 to 1."""
    x, y = numpy.pi * places.T
    wave = 1 + 0.5 * numpy.sin(time)
    return numpy.c_[numpy.sin(wave * x) * numpy.sin(x) * numpy.cos(y),
                    -numpy.cos(wave * x) * numpy.sin(x) * numpy.sin(y)]


def find_densities(places, triangles):
    """The number of particles per area around each particle."""
    a, b, c = (places[triangles[:, corner]] for corner in range(3))
    areas = numpy.cross(b - a, c - a) / 2
    cells = numpy.bincount(triangles.ravel(), numpy.repeat(areas / 3, 3), len(places))
    return 1 / cells


def fill_raster(places, densities, side):
    """The densities at the centers of a raster in the square, by natural neighbors; NaN outside of the hull."""
    centers = (numpy.arange(side) + 0.5) / side
    raster = numpy.stack(numpy.meshgrid(centers, centers), axis=-1)
    field = delaunayflip.NaturalNeighborInterpolator(places, densities)
    return field(raster.reshape(-1, 2)).reshape(side, side)


def swim(count, steps):
    """Yields the places, the triangles, the densities and the report after each step."""
    particles = numpy.random.default_rng(1).random((count, 2))
    length = 0.05 / numpy.sqrt(count)  # the longest step: a twentieth of the distance of particles
    with delaunayflip.MovingTriangulation(particles) as mesh:
        for step in range(steps):
            particles += length * find_velocity(particles, 0.1 * step)
            mesh.move(particles)
            yield particles, mesh.triangles, find_densities(particles, mesh.triangles), mesh.report


def main():
    count, steps = (int(number) for number in (*sys.argv[1:3], 5000, 20)[:2])
    in_place = 0
    for places, _, densities, report in swim(count, steps):
        in_place += report.move_rounds > 0
    raster = fill_raster(places, densities, 100)
    print(f"{steps} steps of {count} particles, {in_place} in place; the median density is",
          f"{numpy.median(densities):.0f}, and on a raster {numpy.nanmedian(raster):.0f}")


if __name__ == "__main__":
    main()

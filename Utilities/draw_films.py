#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws films of three seconds of meshes whose points move: the examples growing_stem.py, without and with
flips, and swimming_particles.py, coloured by density. Needs NumPy and matplotlib:

    python3 Utilities/draw_films.py [FOLDER]
"""
import os
import pathlib
import sys

import matplotlib
import numpy
from PIL import Image

matplotlib.use("Agg")
from matplotlib import pyplot
from matplotlib.collections import PolyCollection
from matplotlib.colors import BoundaryNorm, ListedColormap, LogNorm

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "Examples" / "Python"))
import delaunayflip
import growing_stem
import swimming_particles

FRAMES, PAUSE = 36, 83  # three seconds, at 12 frames per second; milliseconds
COLORS = ["#b2182b", "#ef8a62", "#fddbc7", "#d1e5f0", "#67a9cf", "#2166ac"]  # by smallest angle


def take_picture(figure):
    figure.canvas.draw()
    width, height = figure.canvas.get_width_height()
    pixels = numpy.frombuffer(figure.canvas.buffer_rgba(), numpy.uint8).reshape(height, width, 4)
    return Image.fromarray(pixels[:, :, :3].copy())


def write_film(frames, path):
    """All frames with the colours of the last one, which has all of them."""
    palette = frames[-1].quantize(32, dither=Image.Dither.NONE)
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=PAUSE, loop=0, optimize=True)
    print(f"{path}: {len(frames)} frames, {os.path.getsize(path) / 1e3:.0f} kB")


def project(places):
    """Coordinates on the screen, and the depth, as seen from in front and a little above."""
    rise = numpy.radians(15)
    return (numpy.c_[places[:, 0], places[:, 2] * numpy.cos(rise) + places[:, 1] * numpy.sin(rise)],
            places[:, 1] * numpy.cos(rise) - places[:, 2] * numpy.sin(rise))


def draw_surface(axes, places, triangles, title, colors, norm):
    """The triangles that face the viewer, coloured by their smallest angle; the nearest come last."""
    screen, depth = project(places)
    a, b, c = (screen[triangles[:, corner]] for corner in range(3))
    front = triangles[numpy.cross(b - a, c - a) > 0]
    front = front[numpy.argsort(-depth[front].mean(axis=1))]
    angles = delaunayflip.smallest_angles(places, front)
    axes.clear()
    axes.add_collection(PolyCollection(screen[front], array=angles, cmap=colors, norm=norm,
                                       edgecolors="#333333", linewidths=0.2))
    axes.set(xlim=(-0.35, 1.35), ylim=(-0.1, 2.15), aspect="equal", title=title)
    axes.axis("off")


def film_stem(path):
    colors, norm = ListedColormap(COLORS), BoundaryNorm(range(0, 61, 10), 6)
    figure, axes = pyplot.subplots(1, 2, figsize=(6.4, 4.6), dpi=100)
    figure.subplots_adjust(left=0, right=0.88, bottom=0.02, top=0.92, wspace=0)
    place = figure.add_axes((0.9, 0.15, 0.02, 0.65))
    bar = figure.colorbar(pyplot.cm.ScalarMappable(norm, colors), cax=place)
    bar.set_label("smallest angle (degrees)")
    frames = []
    for places, triangles, before, _ in growing_stem.run(1600, FRAMES - 1):
        draw_surface(axes[0], places, before, "without flips", colors, norm)
        draw_surface(axes[1], places, triangles, "with flips", colors, norm)
        frames.append(take_picture(figure))
    pyplot.close(figure)
    write_film(frames, path)


def film_particles(path):
    figure, axes = pyplot.subplots(figsize=(3.9, 3.1), dpi=100)
    figure.subplots_adjust(left=0.01, right=0.76, bottom=0.02, top=0.9)
    count = 500
    norm, colors = LogNorm(count / 3, count * 3), matplotlib.colormaps["viridis"].resampled(10)
    place = figure.add_axes((0.77, 0.12, 0.03, 0.7))
    bar = figure.colorbar(pyplot.cm.ScalarMappable(norm, colors), cax=place)
    bar.set_label("particles per area")
    frames = []
    for step, (places, triangles, densities, _) in enumerate(swimming_particles.swim(count, 3 * FRAMES)):
        if step % 3 == 0:
            axes.clear()
            axes.tripcolor(*places.T, triangles, densities, cmap=colors, norm=norm, shading="flat",
                           edgecolors="#ffffff", linewidths=0.15)
            axes.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", title=f"{count} particles")
            axes.axis("off")
            frames.append(take_picture(figure))
    pyplot.close(figure)
    write_film(frames, path)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    folder.mkdir(parents=True, exist_ok=True)
    film_stem(folder / "film_stem.gif")
    film_particles(folder / "film_particles.gif")


if __name__ == "__main__":
    main()

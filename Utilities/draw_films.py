#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Draws films of three seconds of meshes with moving points: the examples growing_stem.py, without and with
flips, swimming_particles.py, coloured by density, and ErodingTerrain.cxx. Needs VTK, matplotlib and Pillow,
and for the terrain the program in build/bin and a display (xvfb-run makes one):

    python3 Utilities/draw_films.py [FOLDER]
"""
import os
import pathlib
import subprocess
import sys
import tempfile

import matplotlib
import numpy
from PIL import Image

matplotlib.use("Agg")
from matplotlib import pyplot
from matplotlib.colors import LogNorm

PROJECT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(PROJECT / "Examples" / "Python"))
import delaunayflip
import growing_stem
import swimming_particles
from draw_demo import add_angle_legend
from draw_gallery import draw_mesh

FRAMES, PAUSE = 36, 83  # three seconds, at 12 frames per second; milliseconds
VIEW = (0.0, -numpy.cos(numpy.radians(15)), numpy.sin(numpy.radians(15)))  # from in front, a little above


def take_picture(figure):
    figure.canvas.draw()
    width, height = figure.canvas.get_width_height()
    pixels = numpy.frombuffer(figure.canvas.buffer_rgba(), numpy.uint8).reshape(height, width, 4)
    return Image.fromarray(pixels[:, :, :3].copy())


def write_film(frames, path, colors):
    """All frames with so many colours of the last one, which has all of them."""
    palette = frames[-1].quantize(colors, dither=Image.Dither.NONE)
    frames = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=PAUSE, loop=0, optimize=True)
    print(f"{path}: {len(frames)} frames, {os.path.getsize(path) / 1e3:.0f} kB")


def film_stem(path):
    figure, axes = pyplot.subplots(1, 2, figsize=(6.0, 4.8), dpi=100)
    figure.subplots_adjust(left=0, right=1, bottom=0.16, top=0.92, wspace=0)
    add_angle_legend(figure, 0.1)
    frames = []
    for places, triangles, before, _ in growing_stem.run(1000, FRAMES - 1):
        for part, title, mesh in ((axes[0], "without flips", before), (axes[1], "with flips", triangles)):
            part.clear()
            angles = delaunayflip.smallest_angles(places, mesh)
            draw_mesh(part, (places, mesh, angles), VIEW, (-0.35, 1.35, -0.1, 2.15))
            part.set_title(title)
        frames.append(take_picture(figure))
    pyplot.close(figure)
    write_film(frames, path, 48)


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
    write_film(frames, path, 32)


def film_terrain(path):
    with tempfile.TemporaryDirectory() as folder:
        program = [PROJECT / "build" / "bin" / "ErodingTerrain", "--points", "2500", "--strokes", str(FRAMES)]
        subprocess.run([*program, "--frames", f"{folder}/"], check=True)
        names = sorted(pathlib.Path(folder).iterdir())[2:]  # without the input and the first flips
        write_film([Image.open(name).convert("RGB") for name in names], path, 160)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    folder.mkdir(parents=True, exist_ok=True)
    film_stem(folder / "film_stem.gif")
    film_particles(folder / "film_particles.gif")
    film_terrain(folder / "film_terrain.gif")


if __name__ == "__main__":
    main()

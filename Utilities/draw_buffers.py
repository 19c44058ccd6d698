#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: draw_buffers.py PICTURE.png

Draws who may use which memory during a frame of a live view, with copies and without, for
Documentation/method.md. Times are not to scale. Needs matplotlib.
"""
import sys

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (after the choice of a backend)

COLORS = {"CUDA": "#76b7b2", "OpenGL": "#f28e2b", "CPU": "#9c9ede"}
IDLE = "#eeeeee"

# Each row: the memory, and its users from left to right: (first phase, last phase, user, text).
COPYING = ("from copies", ("step", "store", "upload", "draw"), (
    ("session (GPU)", ((0, 0, "CUDA", "flips"), (1, 1, "CUDA", "read"))),
    ("mesh of the filter (host)", ((1, 1, "CPU", "triangles"), (2, 2, "CPU", "read"))),
    ("triangles (GPU)", ((2, 2, "CPU", "written"), (3, 3, "OpenGL", "read"))),
    ("vertices (GPU)", ((3, 3, "OpenGL", "read"),)),
))
SHARING = ("without copies", ("map", "step", "write", "unmap", "draw"), (
    ("session (GPU)", ((1, 1, "CUDA", "flips"), (2, 2, "CUDA", "read"))),
    ("triangles (GPU)", ((0, 1, "CUDA", ""), (2, 2, "CUDA", "written"), (3, 3, "CUDA", ""),
                         (4, 4, "OpenGL", "read"))),
    ("vertices (GPU)", ((4, 4, "OpenGL", "read"),)),
))


def draw(axes, title, phases, rows):
    for row, (name, users) in enumerate(rows):
        y = len(rows) - 1 - row
        axes.barh(y, len(phases), color=IDLE, height=0.7)
        for first, last, user, text in users:
            axes.barh(y, last - first + 1, left=first, color=COLORS[user], height=0.7)
            axes.text((first + last + 1) / 2, y, text, ha="center", va="center", fontsize=8)
        axes.text(-0.05, y, name, ha="right", va="center", fontsize=9)
    for i, phase in enumerate(phases):
        axes.text(i + 0.5, len(rows) - 0.45, phase, ha="center", fontsize=9)
        axes.axvline(i, color="white", linewidth=1)
    axes.set_title(title, fontsize=10, pad=14)
    axes.set_xlim(0, len(phases))
    axes.set_ylim(-0.5, len(rows) - 0.4)
    axes.axis("off")


def main():
    figure, parts = pyplot.subplots(2, 1, figsize=(8, 4.8))
    draw(parts[0], *COPYING)
    draw(parts[1], *SHARING)
    boxes = [pyplot.Rectangle((0, 0), 1, 1, color=color) for color in COLORS.values()]
    figure.legend(boxes, COLORS, loc="lower center", ncol=3, frameon=False, fontsize=9)
    figure.subplots_adjust(left=0.24, right=0.98, top=0.92, bottom=0.08, hspace=0.4)
    figure.savefig(sys.argv[1], dpi=100, metadata={"Software": None})


if __name__ == "__main__":
    main()

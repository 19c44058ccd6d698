#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: draw_live_view.py PICTURE.png

Draws three frames of Examples/Python/live_flip.py side by side, as in the README. Needs what the
example needs, including a display (xvfb-run makes one).
"""
import os
import subprocess
import sys
import tempfile

from PIL import Image

EXAMPLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Examples", "Python",
                       "live_flip.py")
FRAMES = (0, 3, 10)


def main():
    with tempfile.TemporaryDirectory() as folder:
        prefix = os.path.join(folder, "frame")
        subprocess.run([sys.executable, EXAMPLE, "--frames", prefix], check=True)
        frames = [Image.open(f"{prefix}{number:04d}.png").convert("RGB") for number in FRAMES]
    width, height = frames[0].size
    picture = Image.new("RGB", (width * len(frames), height))
    for i, frame in enumerate(frames):
        picture.paste(frame, (width * i, 0))
    picture.quantize(128, dither=Image.Dither.NONE).save(sys.argv[1], optimize=True)


if __name__ == "__main__":
    main()

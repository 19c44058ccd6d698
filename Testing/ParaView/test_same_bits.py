# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin's meshes equal those of the command, which is built with another VTK.

Skipped if that command, DELAUNAYFLIP_COMMAND, does not exist.
"""

import os
import subprocess
import sys

from paraview import simple

from PluginTesting import PluginTest, fetch, get_triangles, main, make_fan

COMMAND = os.environ["DELAUNAYFLIP_COMMAND"]
if not os.path.exists(COMMAND):
    print(f"skipped: no command {COMMAND}", flush=True)
    sys.exit(125)


def get_plain_environment():
    """The environment without the variables that point to ParaView's libraries."""
    return {name: value for name, value in os.environ.items()
            if name not in ("LD_LIBRARY_PATH", "PYTHONPATH")}


class SameBits(PluginTest):
    def expect_same(self, path, options=(), **properties):
        flipped_by_command = self.path("command.vtp")
        subprocess.run([COMMAND, path, flipped_by_command, *options], check=True, timeout=120,
                       env=get_plain_environment(), stdout=subprocess.DEVNULL)
        before = simple.XMLPolyDataReader(FileName=[path])
        after = simple.XMLPolyDataReader(FileName=[flipped_by_command])
        triangles = get_triangles(fetch(self.flip(before, **properties)))
        # Not by assertEqual, which would take a minute to describe the difference.
        self.assertTrue(triangles == get_triangles(fetch(after)), "not the command's triangles")
        self.assertTrue(triangles != get_triangles(fetch(before)), "nothing was flipped")

    def save_source(self, source):
        path = self.path("source.vtp")
        simple.SaveData(path, source, DataMode="Binary")
        return path

    def test_plane(self):
        self.expect_same(self.save(make_fan(150)))

    def test_surface(self):
        sphere = simple.Sphere(ThetaResolution=300, PhiResolution=60)
        self.expect_same(self.save_source(sphere), ["--tolerance", "1e-9"], Tolerance=1e-9)

    def test_terrain(self):
        grid = simple.Plane(XResolution=120, YResolution=90)
        hills = simple.Calculator(
            Input=simple.Triangulate(Input=grid), CoordinateResults=1,
            Function="coordsX*(1+0.9*sin(9*coordsY))*iHat+coordsY*jHat+0.3*sin(8*coordsX)*kHat")
        self.expect_same(self.save_source(hills), ["--geometry", "planar-xy"],
                         Geometry="Planar XY")


if __name__ == "__main__":
    main()

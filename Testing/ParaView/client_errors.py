# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A user's session in the client, in which ten updates fail and those between them succeed.

Played by test_client.py.
"""

from ClientTesting import Panel, expect, idle, load_plugin, play, start_filter
from paraview import simple

REASON = "failed: geometry 'planar' was requested"


def count_cells(flip):
    return flip.GetDataInformation().GetNumberOfCells()


def fail(client, panel, flip, limit):
    """Apply shows no mesh, and the panel says why at once."""
    panel.choose("Geometry", "Planar")
    panel.write("MaximumIterations", str(limit))
    client.apply()
    yield lambda: flip.MaximumIterations == limit and panel.read("StopReason").startswith(REASON)
    expect(count_cells(flip) == 0, f"{count_cells(flip)} cells after an error")
    expect(panel.read("TotalFlips") == "0", "flips after an error")


def succeed(client, panel, flip):
    panel.choose("Geometry", "Surface")
    client.apply()
    yield lambda: panel.read("StopReason") == "converged"
    expect(count_cells(flip) > 100, "no mesh")
    expect(int(panel.read("TotalFlips")) > 100, "no flips")


def session(client):
    load_plugin()
    sphere = simple.Sphere(ThetaResolution=60, PhiResolution=40)
    ellipsoid = simple.Calculator(
        Input=sphere, CoordinateResults=1, Function="coordsX*iHat+coordsY*jHat+3*coordsZ*kHat")
    flip = yield from start_filter(client, ellipsoid)
    panel = Panel(client)
    for number in range(1, 11):
        yield from fail(client, panel, flip, 100 * number)
        if number > 4:
            yield from succeed(client, panel, flip)
    yield idle(0.2)


play(session)

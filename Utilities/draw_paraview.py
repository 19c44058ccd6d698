# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Run by draw_paraview.sh in ParaView's client: takes pictures of it into DELAUNAYFLIP_FOLDER.

paraview.png: after Apply on the terrain before.vtp there, with the chart of its iterations.
paraview_live.png: during a live update.
"""

import os

from ClientTesting import FOLDER, Panel, QtCore, QtWidgets, idle, load_plugin, play
from paraview import simple

NAME = "Smallest angle after (degrees)"


def arrange(client):
    """A window in which the Properties panel has room for all properties of the filter."""
    client.window.resize(1500, 1000)
    docks = {dock.windowTitle(): dock for dock in client.window.findChildren(QtWidgets.QDockWidget)}
    panel = [docks["Properties"], docks["Pipeline Browser"]]
    client.window.resizeDocks(panel, [430, 430], QtCore.Qt.Orientation.Horizontal)
    client.window.resizeDocks(panel, [820, 130], QtCore.Qt.Orientation.Vertical)


def look_at_mesh(view, zoom):
    view.CameraPosition, view.CameraFocalPoint = [0.5, -1.0, 1.9], [0.5, 0.5, 0.0]
    view.CameraViewUp, view.CameraViewAngle = [0.0, 0.0, 1.0], 30.0
    simple.ResetCamera(view)
    view.GetActiveCamera().Zoom(zoom)
    simple.Render(view)


def apply(client, **properties):
    """Flips the terrain as a user does, from the menu."""
    reader = simple.XMLPolyDataReader(
        registrationName="terrain.vtp", FileName=[os.path.join(FOLDER, "before.vtp")])
    simple.Show(reader)
    simple.SetActiveSource(reader)
    yield idle(0.3)
    client.choose("Delaunay Flip", "Delaunay Flip")
    yield lambda: simple.GetActiveSource().GetXMLName() == "DelaunayFlip"
    flip = simple.GetActiveSource()
    flip.Geometry, flip.GenerateQuality = "Planar XY", 1
    for name, value in properties.items():
        setattr(flip, name, value)
    client.apply()
    yield idle(0.3)
    client.color_by(NAME)
    yield idle(0.3)


def draw_chart(client, flip):
    """The table in the Pipeline Browser, its entry in the menu, Apply."""
    client.select("Iterations")
    yield idle(0.5)
    client.choose("Data Analysis", "Plot Data")
    yield lambda: simple.GetActiveSource().GetXMLName() == "PlotAttributes"
    client.apply()
    yield idle(0.5)
    lines = simple.GetDisplayProperties()
    lines.UseIndexForXAxis, lines.XArrayName, lines.SeriesVisibility = 0, "Iteration", ["Flipped"]
    simple.Render()
    simple.SetActiveSource(flip)
    yield idle(0.5)


def session(client):
    load_plugin()
    arrange(client)
    yield from apply(client)
    flip = simple.GetActiveSource()
    view = simple.GetActiveView()
    view.OrientationAxesVisibility = 0
    legend = simple.GetScalarBar(simple.GetColorTransferFunction(NAME), view)
    legend.WindowLocation = "Upper Right Corner"
    look_at_mesh(view, 1.5)
    yield idle(0.3)
    Panel(client).click("LiveUpdate")
    client.apply()
    yield lambda: flip.StopReason == "running" and flip.NumberOfIterations >= 12
    client.save_picture("paraview_live.png")

    Panel(client).click("LiveUpdate")
    client.apply()
    yield lambda: flip.StopReason == "converged"
    yield from draw_chart(client, flip)
    look_at_mesh(view, 1.05)
    yield idle(0.3)
    client.save_picture("paraview.png")


play(session)

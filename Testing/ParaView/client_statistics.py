# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A user's session in the client with Delaunay Flip Statistics: a text in the render view, which
follows a live run.

Played by test_client.py; leaves the picture statistics.png.
"""

import os
import re

from ClientTesting import FOLDER, expect, idle, load_plugin, play, start_filter
from paraview import simple


def read_view():
    """All texts that the render view shows."""
    view = simple.GetActiveView().SMProxy.GetClientSideObject()
    props = view.GetNonCompositedRenderer().GetViewProps()
    shown = [props.GetItemAsObject(i) for i in range(props.GetNumberOfItems())]
    return "\n".join(prop.GetText() for prop in shown
                     if prop.IsA("vtkTextRepresentation") and prop.GetVisibility())


def expect_text(flip):
    """The text in the view agrees with the panel."""
    text = read_view()
    expect(text.startswith(f"iteration {flip.NumberOfIterations}, {flip.StopReason}\n"), text)
    counts = f"{flip.TotalFlips} flips, {flip.NumberOfNonDelaunayEdges} bad edges left"
    expect(counts in text, f"{counts}: {text}")
    expect(bool(re.search(r"smallest angle \d+\.\d\d degrees", text))
           == (flip.StopReason == "converged"), text)


def watch_live(client, flip):
    flip.LiveUpdate = 1
    client.application.processEvents()
    simple.Render()
    yield lambda: flip.NumberOfIterations >= 3
    flip.Paused = 1
    yield idle(0.5)
    expect(flip.StopReason == "running", flip.StopReason)
    expect_text(flip)
    client.save_picture("statistics.png")
    flip.Paused = 0
    yield lambda: flip.StopReason == "converged"
    yield idle(0.5)
    expect_text(flip)


def session(client):
    load_plugin()
    client.window.resize(1200, 800)
    mesh = simple.XMLPolyDataReader(FileName=[os.path.join(FOLDER, "long.vtp")])
    flip = yield from start_filter(client, mesh)
    client.apply()
    yield lambda: flip.StopReason == "converged"
    statistics = yield from start_filter(client, flip, "Delaunay Flip Statistics")
    client.apply()
    yield idle(0.5)
    for source in (flip, statistics):
        expect(simple.GetDisplayProperties(source).Visibility == 1, f"{source} is not shown")
    expect(len(simple.GetViews()) == 1, "another view was opened")
    expect_text(flip)
    yield from watch_live(client, flip)
    simple.Hide(statistics)
    simple.Show(simple.DelaunayFlipStatistics(Input=mesh))
    simple.Render()
    expect(read_view() == "no statistics: not a mesh of Delaunay Flip", read_view())


play(session)

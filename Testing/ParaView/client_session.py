# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The client's side of test_client.py: a user's session with the plugin, in the window.

Reads mesh.vtp in the folder DELAUNAYFLIP_FOLDER and leaves its pictures there.
"""

import os

from paraview import servermanager, simple

from ClientTesting import FOLDER, Panel, expect, idle, load_plugin, play

QUIET = 1.5  # seconds: many times the interval of polls


def get_triangles(flip):
    mesh = servermanager.Fetch(flip)
    ids = mesh.GetPolys().GetConnectivityArray()
    return [ids.GetTuple1(i) for i in range(ids.GetNumberOfTuples())]


def has_converged(flip):
    return lambda: flip.StopReason == "converged"


def use_menu(client):
    """Creates the filter from the menu and applies it with its defaults."""
    where = client.find_actions("Delaunay Flip")
    expect({"Alphabetical", "Delaunay Flip"} <= set(where), f"menu entries: {list(where)}")
    client.choose("Delaunay Flip", "Delaunay Flip")
    yield lambda: simple.GetActiveSource().GetXMLName() == "DelaunayFlip"
    client.apply()
    yield has_converged(simple.GetActiveSource())


def look_at_panel(client, panel):
    """Widgets that have no effect are hidden."""
    expect(panel.is_shown("FeatureAngle"), "FeatureAngle is not shown")
    expect(not panel.is_shown("IterationsPerUpdate"), "IterationsPerUpdate is shown")
    panel.choose("Geometry", "Planar")
    yield lambda: not panel.is_shown("FeatureAngle")
    panel.choose("Geometry", "Auto")
    yield lambda: panel.is_shown("FeatureAngle")
    client.save_picture("applied.png")


def undo(client, panel, flip):
    """A change of the number of iterations is undone and redone."""
    at_first = flip.NumberOfIterations
    panel.write("MaximumIterations", "3")
    client.apply()
    yield lambda: flip.NumberOfIterations == 3
    client.choose_beginning("Edit", "Undo")
    yield lambda: flip.MaximumIterations == -1 and flip.NumberOfIterations == at_first
    client.choose_beginning("Edit", "Redo")
    yield lambda: flip.NumberOfIterations == 3
    client.choose_beginning("Edit", "Undo")
    yield has_converged(flip)


def watch_live(client, panel, flip):
    """Live update: the mesh improves by itself, step by step; polling ends when the run ends."""
    at_once = get_triangles(flip)
    iterations = int(flip.NumberOfIterations)
    renders, seen = [], []
    window = simple.GetActiveView().GetRenderWindow()
    window.AddObserver("EndEvent", lambda *_: renders.append(flip.NumberOfIterations))
    panel.click("LiveUpdate")
    yield lambda: panel.is_shown("IterationsPerUpdate")
    client.apply()

    def has_ended():
        if flip.NumberOfIterations not in seen:
            seen.append(flip.NumberOfIterations)
        return has_converged(flip)()

    yield has_ended
    expect(seen[-1] == iterations, f"ended after {seen[-1]} iterations, not {iterations}")
    expect(len(set(renders)) > iterations // 2, f"{iterations} steps, rendered: {renders}")
    expect(get_triangles(flip) == at_once, "live update ended with another mesh")
    renders.clear()
    yield idle(QUIET)
    expect(not renders, "the view was rendered after the end")
    client.save_picture("live.png")
    panel.press("Restart")
    yield lambda: flip.StopReason == "running"
    yield has_converged(flip)
    expect(get_triangles(flip) == at_once, "a restarted live update ended with another mesh")


def session(client):
    load_plugin()
    mesh = simple.XMLPolyDataReader(FileName=[os.path.join(FOLDER, "mesh.vtp")])
    simple.Show(mesh).Representation = "Surface With Edges"
    simple.ResetCamera()
    yield idle(0.2)
    yield from use_menu(client)
    flip = simple.GetActiveSource()
    simple.GetDisplayProperties(flip).Representation = "Surface With Edges"
    panel = Panel(client)
    yield from look_at_panel(client, panel)
    yield from undo(client, panel, flip)
    yield from watch_live(client, panel, flip)


play(session)

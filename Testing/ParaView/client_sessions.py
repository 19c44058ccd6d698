# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Users' sessions with the plugin in the client's window; DELAUNAYFLIP_SESSION says which one.

Played by test_client.py, which makes the meshes in the folder DELAUNAYFLIP_FOLDER; the pictures stay
there.
"""

import html
import os

from paraview import servermanager, simple, smtrace
from paraview.modules.vtkRemotingCore import vtkProcessModule

from ClientTesting import FOLDER, Panel, QtWidgets, expect, idle, load_plugin, play, start_filter

QUIET = 1.5  # seconds: many times the interval of polls


def read_mesh(name, **options):
    return simple.XMLPolyDataReader(FileName=[os.path.join(FOLDER, name)], **options)


def get_triangles(flip):
    polys = servermanager.Fetch(flip).GetPolys().GetConnectivityArray()
    ids = [int(polys.GetTuple1(i)) for i in range(polys.GetNumberOfTuples())]
    return [tuple(ids[i:i + 3]) for i in range(0, len(ids), 3)]


def has_converged(flip):
    return lambda: flip.StopReason == "converged"


def use_menu(client):
    """Creates the filter from the menu and applies it with its defaults."""
    where = client.find_actions("Delaunay Flip")
    expect({"Alphabetical", "Delaunay Flip"} <= set(where), f"menu entries: {list(where)}")
    for text in ("Delaunay Flip", "Delaunay From Points", "Delaunay Flip Statistics"):
        icon = client.find_actions(text)["Delaunay Flip"].icon()
        expect(not icon.pixmap(32, 32).isNull(), f"{text} has no icon")
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
    panel.click("GenerateQuality")
    client.apply()
    yield idle(0.3)
    flip = simple.GetActiveSource()
    for name in ("Smallest angle before (degrees)", "Smallest angle after (degrees)"):
        client.color_by(name)
        yield lambda: simple.GetDisplayProperties(flip).ColorArrayName[1] == name
        yield idle(0.3)
        points = simple.GetColorTransferFunction(name).RGBPoints
        expect((points[0], points[-4]) == (0, 60) and points[1] > 0.6 and points[-1] > 0.5, points)
    flip_colors = simple.GetColorTransferFunction("Smallest angle after (degrees)")
    flip_colors.ApplyPreset("Cool to Warm", False)
    expect(flip_colors.ApplyPreset("Smallest angle", False), "no preset")
    expect((flip_colors.RGBPoints[0], flip_colors.RGBPoints[-4]) == (0, 60), flip_colors.RGBPoints)
    yield from choose_preset(client)
    expect_plain_legend()
    client.save_picture("applied.png")


def expect_edges(flip, representation):
    """How a mesh is shown at first. Edges are grey; ParaView's are blue, as good triangles are."""
    display = simple.GetDisplayProperties(flip)
    expect(display.Representation == representation, display.Representation)
    red, green, blue = display.EdgeColor
    expect(red == green == blue < 0.5, display.EdgeColor)


def look_at_large_mesh(client):
    """Edges would cover a mesh of many triangles."""
    grid = simple.Triangulate(Input=simple.Plane(XResolution=120, YResolution=90))
    flip = yield from start_filter(client, grid)
    client.apply()
    yield has_converged(flip)
    expect_edges(flip, "Surface")


def expect_plain_legend():
    """The ends of the legend are 0 and 60, not 0.0e+00 and 6.0e+01."""
    colors = simple.GetColorTransferFunction("Smallest angle after (degrees)")
    legend = simple.GetScalarBar(colors, simple.GetActiveView())
    expect(legend.RangeLabelFormat in ("%g", "{:g}"), legend.RangeLabelFormat)
    other = simple.GetScalarBar(simple.GetColorTransferFunction("Side"), simple.GetActiveView())
    expect("e" in other.RangeLabelFormat, other.RangeLabelFormat)


def choose_preset(client):
    """The dialog of presets lists the colours of angles, without a search."""
    client.window.findChildren(QtWidgets.QToolButton, "ChoosePreset")[0].click()
    yield idle(0.5)
    (dialog,) = [widget for widget in client.application.topLevelWidgets()
                 if widget.metaObject().className() == "pqPresetDialog" and widget.isVisible()]
    model = dialog.findChild(QtWidgets.QAbstractItemView, "gradients").model()
    names = [model.index(row, 0).data() for row in range(model.rowCount())]
    expect("Smallest angle" in names, names)
    dialog.close()


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


def use_filter(client):
    """Menu, Apply, panel, live update."""
    mesh = read_mesh("mesh.vtp")
    simple.Show(mesh).Representation = "Surface With Edges"
    simple.ResetCamera()
    yield idle(0.2)
    yield from use_menu(client)
    flip = simple.GetActiveSource()
    expect_edges(flip, "Surface With Edges")
    panel = Panel(client)
    yield from look_at_panel(client, panel)
    yield from watch_live(client, panel, flip)
    yield from look_at_large_mesh(client)


def read_results(panel, flip):
    """The summary is text that cannot be edited, in two columns."""
    shown = panel.read("Summary").replace("&nbsp;", " ")
    lines = [line.split(": ", 1) for line in flip.Summary.splitlines()]
    expect([title for title, _ in lines if title == "flips"], flip.Summary)
    for title, text in [*lines, ("where", flip.BackendUsed)]:
        text = html.escape(text, quote=False).replace("-&gt;", "&rarr;")
        expect(title in shown and text in shown, f"{title}: {shown}")
    for widget in panel.find_all("Summary"):
        expect(not isinstance(widget, (QtWidgets.QLineEdit, QtWidgets.QTextEdit)), "it can be edited")
    expect(any(label.text().endswith("<b>Last Update</b></html>")
               for label in panel.window.findChildren(QtWidgets.QLabel) if label.isVisible()), "no title")


def use_buttons(client, panel, flip):
    """Pause pauses the run, Step makes one step, Restart starts again, Pause continues."""
    expect(not panel.is_shown("Step"), "buttons are shown without live update")
    panel.click("LiveUpdate")
    yield lambda: panel.is_shown("Step")
    client.apply()
    yield lambda: flip.NumberOfIterations >= 3
    panel.press("Paused")
    yield idle(0.3)
    held = flip.NumberOfIterations
    yield idle(QUIET)
    expect(flip.NumberOfIterations == held and flip.StopReason == "running", "it did not pause")
    client.save_picture("panel_paused.png")
    smtrace.start_trace()
    panel.press("Step")
    expect("InvokeCommand('Step')" in smtrace.stop_trace(), "the trace lacks the step")
    yield lambda: flip.NumberOfIterations == held + 1
    yield idle(QUIET)
    expect(flip.NumberOfIterations == held + 1, "a step made more than one iteration")
    expect(f"in {held + 1} iterations, running" in panel.read("Summary"), "the panel lags behind")
    panel.press("Restart")
    yield lambda: flip.NumberOfIterations == 1
    yield idle(QUIET)
    expect(flip.NumberOfIterations == 1, "a paused run continued after its restart")
    panel.press("Paused")
    yield has_converged(flip)
    panel.press("Restart")
    yield lambda: flip.NumberOfIterations >= 2
    panel.press("Step")  # pauses a run that is not paused
    yield idle(QUIET)
    expect(flip.StopReason == "running", "the run continued")
    expect(panel.find("Paused", QtWidgets.QPushButton).isChecked(), "the button does not show it")
    panel.press("Paused")
    yield has_converged(flip)
    panel.click("LiveUpdate")
    client.apply()
    yield idle(0.3)


def count_edges(flip, edge):
    """The number of triangles of the output with this edge."""
    return sum(edge <= set(triangle) for triangle in get_triangles(flip))


def choose_constraints(client, panel, flip):
    edge = {15, 29}  # of the input's fan; flipped unless it is a constraint
    expect(count_edges(flip, edge) == 0, "the edge is there without constraints")
    choices = panel.find("Constraints", QtWidgets.QComboBox)
    texts = [choices.itemText(i) for i in range(choices.count())]
    expect(texts[0] == "(none)" and "Lines" in texts, texts)
    panel.choose("Constraints", "Lines")
    client.apply()
    yield lambda: count_edges(flip, edge) == 2
    yield lambda: "1 edge kept, 0 not in the mesh" in panel.read("Summary")
    client.save_picture("panel.png")
    panel.choose("Constraints", "(none)")
    client.apply()
    yield lambda: count_edges(flip, edge) == 0
    flip.Constraints = simple.FindSource("Lines")
    yield lambda: choices.currentText() == "Lines"
    flip.Constraints = None
    yield lambda: choices.currentText() == "(none)"


def choose_regions(client, panel, flip):
    """Region Array says None where none is chosen, and can be set back to it."""
    choices = panel.find("RegionArray", QtWidgets.QComboBox)
    texts = [choices.itemText(i) for i in range(choices.count())]
    expect(texts == ["None", "Side"] and choices.currentText() == "None", texts)
    edge = {15, 29}  # between two regions
    for text, name, triangles in (("Side", "Side", 2), ("None", "", 0)):
        panel.choose("RegionArray", text)
        client.apply()
        yield lambda: count_edges(flip, edge) == triangles
        yield idle(0.3)
        expect((flip.RegionArray, choices.currentText()) == (name, text), flip.RegionArray)


def omit_loops(panel, flip):
    """The list of constraints omits sources downstream of the filter, which would make a loop."""
    simple.SetActiveSource(flip)
    later = simple.Transform(registrationName="Later", Input=flip)
    last = simple.FeatureEdges(registrationName="Last", Input=later)
    simple.Show(last)
    simple.FeatureEdges(registrationName="Beside", Input=simple.FindSource("Lines")).UpdatePipeline()
    yield idle(0.5)
    simple.SetActiveSource(flip)
    yield idle(0.5)
    choices = panel.find("Constraints", QtWidgets.QComboBox)
    texts = {choices.itemText(i) for i in range(choices.count())}
    expect(texts == {"(none)", "Lines", "Mesh", "Beside"}, texts)
    for source in (last, later, simple.FindSource("Beside")):
        simple.Delete(source)
    yield idle(0.5)
    expect(choices.findText("Beside") == -1, "a deleted source is listed")


def look_at_color_by(flip):
    """Color By does not list the filter's field data."""
    information = flip.GetDataInformation().DataInformation.GetFieldDataInformation()
    expect(information.GetArrayInformation("DelaunayFlip:TotalFlips"), "no field data")
    display = simple.GetDisplayProperties(flip)
    domain = display.SMProxy.GetProperty("ColorArrayName").FindDomain("vtkSMArrayListDomain")
    names = {domain.GetString(i) for i in range(domain.GetNumberOfStrings())}
    expect("Side" in names and not any(name.startswith("DelaunayFlip:") for name in names), names)


def use_panel(client):
    """The results, the list of constraints, the buttons of a live run; Color By."""
    client.window.resize(1500, 1150)
    mesh = read_mesh("long.vtp", registrationName="Mesh")
    read_mesh("lines.vtp", registrationName="Lines")
    flip = yield from start_filter(client, mesh)
    client.apply()
    yield has_converged(flip)
    panel = Panel(client)
    read_results(panel, flip)
    look_at_color_by(flip)
    yield from choose_constraints(client, panel, flip)
    yield from choose_regions(client, panel, flip)
    yield from omit_loops(panel, flip)
    yield from use_buttons(client, panel, flip)
    read_results(panel, flip)
    panel.choose("Backend", "Threads")
    panel.write("NumberOfThreads", "1")
    client.apply()
    yield lambda: flip.BackendUsed == "Threads: 1"
    read_results(panel, flip)


def find_texts(view):
    """All texts that the render view shows."""
    props = view.SMProxy.GetClientSideObject().GetNonCompositedRenderer().GetViewProps()
    shown = [props.GetItemAsObject(i) for i in range(props.GetNumberOfItems())]
    return [prop for prop in shown if prop.IsA("vtkTextRepresentation") and prop.GetVisibility()]


def read_view(view):
    return "\n".join(prop.GetText() for prop in find_texts(view))


def expect_room(view):
    """No text is clipped."""
    renderer = view.SMProxy.GetClientSideObject().GetNonCompositedRenderer()
    for prop in find_texts(view):
        size = [0.0, 0.0]
        prop.GetTextActor().GetSize(renderer, size)
        room = renderer.GetSize()
        expect(0 < size[0] < room[0] and 0 < size[1] < room[1], f"{size} in {room}")


def expect_text(flip):
    """The text in all views agrees with the panel."""
    for view in simple.GetViews():
        text = read_view(view)
        expect(text.split() == flip.Summary.split(), f"{text}\ninstead of\n{flip.Summary}")
        expect_room(view)


def use_statistics(client):
    """Delaunay Flip Statistics: a text in the render view, which follows a live run, also in another
    view and after other filters; and how a state restores it."""
    client.window.resize(1300, 800)
    mesh = read_mesh("long.vtp")
    flip = yield from start_filter(client, mesh)
    client.apply()
    yield has_converged(flip)
    statistics = yield from start_filter(client, flip, "Delaunay Flip Statistics")
    client.apply()
    yield idle(0.5)
    for source in (flip, statistics):
        expect(simple.GetDisplayProperties(source).Visibility == 1, f"{source} is not shown")
    expect(simple.GetDisplayProperties(statistics).Justification == "Left", "lines are centred")
    expect(len(simple.GetViews()) == 1, "another view was opened")
    view, other = simple.GetActiveView(), simple.CreateView("RenderView")
    simple.AssignViewToLayout(other, simple.GetLayout(view), 0)
    simple.Show(simple.DelaunayFlipStatistics(Input=simple.Transform(Input=flip)), other)
    simple.SetActiveView(view)
    simple.RenderAllViews()
    expect_text(flip)
    flip.LiveUpdate = 1
    client.application.processEvents()
    simple.Render()
    for iterations in (3, 6, 9):
        yield lambda: flip.NumberOfIterations >= iterations
        flip.Paused = 1
        yield idle(0.5)
        expect(flip.StopReason == "running", flip.StopReason)
        expect_text(flip)
        client.save_picture("statistics.png")
        flip.Paused = 0
    yield has_converged(flip)
    yield idle(0.5)
    expect_text(flip)
    simple.Hide(statistics)
    simple.Show(simple.DelaunayFlipStatistics(Input=mesh))
    simple.Render()
    nothing = "no statistics: no triangles, or not a mesh of Delaunay Flip"
    expect(read_view(view) == nothing, read_view(view))
    simple.GetDisplayProperties(statistics).Justification = "Right"
    simple.GetDisplayProperties(flip).Representation = "Surface"
    simple.SaveState(os.path.join(FOLDER, "state.pvsm"))
    simple.ResetSession()
    simple.LoadState(os.path.join(FOLDER, "state.pvsm"))
    statistics = simple.FindSource("DelaunayFlipStatistics1")
    restored = simple.GetDisplayProperties(statistics, simple.GetViews()[0]).Justification
    expect(restored == "Right", restored)
    flip = simple.FindSource("DelaunayFlip1")
    restored = simple.GetDisplayProperties(flip, simple.GetViews()[0]).Representation
    expect(restored == "Surface", restored)


def use_points(client):
    """Delaunay From Points: its panel, and the first triangles that become the Delaunay mesh."""
    client.window.resize(1200, 1000)
    points = yield from start_filter(client, read_mesh("cloud.vtp"), "Delaunay From Points")
    panel = Panel(client)
    panel.click("LiveUpdate")
    client.apply()
    yield has_converged(points)
    panel.write("Alpha", "0.03")
    client.apply()
    yield lambda: points.GetDataInformation().GetNumberOfCells() < 1900
    yield from start_filter(client, points, "Delaunay Flip Statistics")
    client.apply()
    yield idle(0.5)
    expect_text(points)
    text = read_view(simple.GetActiveView())
    expect("removed: 0 triangles outside" in text and "bad edges" not in text, text)
    client.save_picture("points.png")


def start_with_plugin(client):
    """The plugin in Python, loaded while the client starts, opens no second session."""
    yield idle(0.5)
    sessions = vtkProcessModule.GetProcessModule().NewSessionIterator()
    sessions.GoToNextItem()
    expect(sessions.IsDoneWithTraversal(), "there are several sessions")
    expect(client.find_actions("Delaunay Flip"), "the plugin is not loaded")


def session(client):
    if "PV_PLUGIN_PATH" not in os.environ:
        load_plugin()
    yield from globals()[os.environ["DELAUNAYFLIP_SESSION"]](client)


play(session)

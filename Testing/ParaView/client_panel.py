# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A user's session in the client with the Properties panel: the buttons of a live run, the list of
constraints, the results, and a Color By menu without the filter's statistics.

Played by test_client.py; leaves the pictures panel*.png.
"""

import os

from ClientTesting import FOLDER, Panel, expect, idle, load_plugin, play, start_filter
from paraview import servermanager, simple
from ClientQt import QtWidgets

RESULTS = ["NumberOfIterations", "TotalFlips", "NumberOfNonDelaunayEdges",
           "NumberOfEdgesBlockedByShape", "NumberOfEdgesBlockedByEdge", "StopReason",
           "NumberOfConstraintEdges", "NumberOfUnmatchedConstraintEdges", "GeometryUsed",
           "BackendUsed"]
QUIET = 1.5  # seconds: many times the interval of polls


def count_edges(flip, edge):
    """The number of triangles of the output with this edge."""
    polys = servermanager.Fetch(flip).GetPolys().GetConnectivityArray()
    ids = [int(polys.GetTuple1(i)) for i in range(polys.GetNumberOfTuples())]
    return sum(edge <= set(ids[i:i + 3]) for i in range(0, len(ids), 3))


def read_results(panel, flip):
    """Results are text that cannot be edited, and whole numbers have no decimal point."""
    for name in RESULTS:
        expect(panel.read(name) == str(flip.GetPropertyValue(name)), f"{name}: {panel.read(name)}")
        for widget in panel.find_all(name):
            expect(not isinstance(widget, QtWidgets.QLineEdit) and not widget.findChildren(QtWidgets.QLineEdit),
                   f"{name} looks as if it could be edited")
    expect(panel.read("TotalFlips").isdigit(), panel.read("TotalFlips"))
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
    panel.press("Step")
    yield lambda: flip.NumberOfIterations == held + 1
    yield idle(QUIET)
    expect(flip.NumberOfIterations == held + 1, "a step made more than one iteration")
    expect(panel.read("NumberOfIterations") == str(held + 1), "the panel lags behind")
    panel.press("Restart")
    yield lambda: flip.NumberOfIterations == 1
    yield idle(QUIET)
    expect(flip.NumberOfIterations == 1, "a paused run continued after its restart")
    panel.press("Paused")
    yield lambda: flip.StopReason == "converged"
    panel.click("LiveUpdate")
    client.apply()
    yield idle(0.3)


def step_pauses(client, panel, flip):
    """Step pauses a run that is not paused."""
    panel.click("LiveUpdate")
    client.apply()
    yield lambda: flip.NumberOfIterations >= 2
    panel.press("Step")
    yield idle(QUIET)
    expect(flip.StopReason == "running", "the run continued")
    expect(panel.find("Paused", QtWidgets.QPushButton).isChecked(), "the button does not show it")
    panel.press("Paused")
    yield lambda: flip.StopReason == "converged"
    panel.click("LiveUpdate")
    client.apply()
    yield idle(0.3)


def choose_constraints(client, panel, flip):
    edge = {15, 29}  # of the input's fan; flipped unless it is a constraint
    expect(count_edges(flip, edge) == 0, "the edge is there without constraints")
    choices = panel.find("Constraints", QtWidgets.QComboBox)
    texts = [choices.itemText(i) for i in range(choices.count())]
    expect(texts[0] == "(none)" and "Lines" in texts, texts)
    panel.choose("Constraints", "Lines")
    client.apply()
    yield lambda: count_edges(flip, edge) == 2
    yield lambda: panel.read("NumberOfConstraintEdges") == "1"
    expect(panel.read("NumberOfUnmatchedConstraintEdges") == "0", "an edge was not found")
    client.save_picture("panel.png")
    panel.choose("Constraints", "(none)")
    client.apply()
    yield lambda: count_edges(flip, edge) == 0
    flip.Constraints = simple.FindSource("Lines")
    yield lambda: choices.currentText() == "Lines"
    flip.Constraints = None
    yield lambda: choices.currentText() == "(none)"


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


def get_color_choices(flip):
    display = simple.GetDisplayProperties(flip)
    domain = display.SMProxy.GetProperty("ColorArrayName").FindDomain("vtkSMArrayListDomain")
    return {domain.GetString(i) for i in range(domain.GetNumberOfStrings())}


def look_at_color_by(flip):
    """Color By does not list the filter's field data, whatever other arrays the user hides."""
    information = flip.GetDataInformation().DataInformation.GetFieldDataInformation()
    expect(information.GetArrayInformation("DelaunayFlip:TotalFlips"), "no field data")
    settings = servermanager._getPyProxy(
        servermanager.ProxyManager().GetProxy("settings", "RepresentedArrayListSettings"))
    for hidden in ([], ["^Side$"], ["^Other$", "^Side$"], ["^Other$"], []):
        settings.FilterExpressions = hidden
        names = get_color_choices(flip)
        expect(("Side" in names) == ("^Side$" not in hidden), f"{hidden}: {names}")
        expect(not any(name.startswith("DelaunayFlip:") for name in names), f"{hidden}: {names}")
        expect(list(settings.FilterExpressions) == hidden, "the user's settings were changed")


def session(client):
    load_plugin()
    client.window.resize(1500, 1150)
    mesh = simple.XMLPolyDataReader(
        registrationName="Mesh", FileName=[os.path.join(FOLDER, "long.vtp")])
    simple.XMLPolyDataReader(
        registrationName="Lines", FileName=[os.path.join(FOLDER, "lines.vtp")])
    flip = yield from start_filter(client, mesh)
    client.apply()
    yield lambda: flip.StopReason == "converged"
    panel = Panel(client)
    read_results(panel, flip)
    look_at_color_by(flip)
    yield from choose_constraints(client, panel, flip)
    yield from omit_loops(panel, flip)
    yield from use_buttons(client, panel, flip)
    yield from step_pauses(client, panel, flip)
    read_results(panel, flip)


play(session)

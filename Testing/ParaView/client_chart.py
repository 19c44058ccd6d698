# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A user's session in the client with Plot Delaunay Flips, during a live run and after it.

Played by test_client.py; leaves the pictures chart*.png.
"""

import os

from ClientTesting import FOLDER, Panel, expect, idle, load_plugin, play, start_filter
from paraview import simple


def get_chart():
    return simple.GetActiveView().SMProxy.GetContextItem()


def get_lines():
    """The lines of the chart, as {label: [(x, y), ...]}."""
    lines = {}
    for plot in map(get_chart().GetPlot, range(get_chart().GetNumberOfPlots())):
        if plot.GetVisible() and plot.GetInput():
            columns = [plot.GetData().GetInputAbstractArrayToProcess(k, plot.GetInput())
                       for k in (0, 1)]
            lines[plot.GetLabel()] = [tuple(column.GetTuple1(i) for column in columns)
                                      for i in range(columns[0].GetNumberOfTuples())]
    return lines


def get_columns(flip, *names):
    """Rows of the filter's table, of some columns."""
    rows = simple.servermanager.Fetch(flip, idx=1).GetRowData()
    columns = [rows.GetArray(name) for name in names]
    return [tuple(column.GetTuple1(i) for column in columns)
            for i in range(columns[0].GetNumberOfTuples())]


def plot(client, flip):
    client.select("Iterations")
    yield idle(0.3)
    client.choose("Delaunay Flip", "Plot Delaunay Flips")
    yield lambda: simple.GetActiveSource().GetXMLName() == "PlotDelaunayFlips"
    client.apply()
    yield lambda: simple.GetActiveView().GetXMLName() == "DelaunayFlipChartView"
    yield idle(0.3)


def watch_live(client, panel, flip):
    """The first chart has one row; it follows the run to the end by itself."""
    panel.write("MaximumIterations", "1")
    client.apply()
    yield lambda: flip.NumberOfIterations == 1
    yield from plot(client, flip)
    row = get_columns(flip, "Iteration", "Flipped")
    expect(get_lines() == {"Flipped": 2 * row}, get_lines())  # a single point is not a line
    client.save_picture("chart_one_row.png")
    client.select("DelaunayFlip1")
    yield idle(0.3)
    panel.write("MaximumIterations", "-1")
    panel.click("LiveUpdate")
    client.apply()
    yield lambda: 3 < len(get_lines()["Flipped"]) < 12
    yield lambda: flip.StopReason == "converged"
    rows = get_columns(flip, "Iteration", "Flipped")
    yield lambda: get_lines() == {"Flipped": rows}
    expect(rows[0][0] == 1 and len(rows) == flip.NumberOfIterations > 12, rows)
    client.save_picture("chart_live.png")


def look_at_axes():
    titles = [get_chart().GetAxis(axis).GetTitle() for axis in (0, 1, 2)]
    expect(titles == ["Edges", "Iteration", "Smallest angle (degrees)"], titles)
    corners = dict(zip(*[iter(get_display().SeriesPlotCorner)] * 2))
    expect([name for name in corners if corners[name] != "0"] == ["MinimumAngle"], corners)


def get_display():
    return simple.GetDisplayProperties(simple.FindSource("PlotDelaunayFlips1"))


def choose_lines(client):
    """Other lines than flips, also on a logarithmic axis, which cannot show 0."""
    names = ["Flipped", "Excluded", "Blocked", "MinimumAngle"]
    get_display().SeriesVisibility = names
    simple.Render()
    expect(set(get_lines()) == set(names), get_lines())
    expect((2, 0) not in get_lines()["Excluded"] and any(
        y == 0 for _, y in get_lines()["Excluded"]), "Excluded should fall to 0")
    client.save_picture("chart_lines.png")
    client.select("PlotDelaunayFlips1")
    yield idle(0.3)
    Panel(client).click("LogScale")
    client.apply()
    yield lambda: get_chart().GetAxis(0).GetLogScaleActive()
    expect(not any(y == 0 for _, y in get_lines()["Excluded"]), "a 0 on a logarithmic axis")
    client.save_picture("chart_log.png")
    Panel(client).click("LogScale")
    client.apply()
    yield lambda: not get_chart().GetAxis(0).GetLogScaleActive()


def session(client):
    load_plugin()
    client.window.resize(1500, 900)
    mesh = simple.XMLPolyDataReader(FileName=[os.path.join(FOLDER, "long.vtp")])
    flip = yield from start_filter(client, mesh)
    yield from watch_live(client, Panel(client), flip)
    look_at_axes()
    yield from choose_lines(client)


play(session)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""All plots of the report: OUTPUT/plots/NAME.svg and NAME.png. The colours are Okabe and Ito's, which
colour-blind readers can tell apart; markers and line styles differ as well."""

import os

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

from results import median

BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
YELLOW, BLUE, VERMILION, PURPLE = "#F0E442", "#0072B2", "#D55E00", "#CC79A7"

# Name, colour, marker and line of every program.
STYLES = {
    "ours-gpu": ("this project, GPU", BLUE, "o", "-"),
    "ours-all": ("this project, all threads", BLUE, "s", "--"),
    "ours-1": ("this project, 1 thread", BLUE, "^", ":"),
    "no-chunks": ("this project, no chunks", SKY, "v", "-."),
    "paper-gpu": ("paper's method, GPU", VERMILION, "o", "-"),
    "paper-all": ("paper's method, all threads", VERMILION, "s", "--"),
    "paper-1": ("paper's method, 1 thread", VERMILION, "^", ":"),
    "paper": ("paper's method", VERMILION, "s", "--"),
    "lawson": ("sequential Lawson", BLACK, "x", "-"),
    "cgal": ("CGAL", GREEN, "D", "-"),
    "triangle": ("Triangle", GREEN, "P", "--"),
    "scipy": ("SciPy (Qhull)", PURPLE, "*", "-"),
    "startinpy": ("startinpy", PURPLE, "<", "--"),
    "vtk": ("vtkDelaunay2D", ORANGE, ">", "-"),
    "meshlib": ("MeshLib", GREEN, "P", "-"),
}

plt.rcParams.update(
    {
        "font.size": 9,
        "axes.grid": True,
        "grid.alpha": 0.3,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "svg.hashsalt": "delaunay-flip",
        "legend.frameon": False,
    }
)


def label_of(program):
    return STYLES[program][0]


def style_of(program):
    name, color, marker, line = STYLES[program]
    return {"label": name, "color": color, "marker": marker, "linestyle": line, "markersize": 5}


def time_of(row):
    """The time to compare: from arrays or points to the mesh; for the paper's method and on
    surfaces that of the flips alone."""
    return median(row, "total_ms") or median(row, "flips_ms")


def save(figure, results, name):
    """@returns the name of the plot, or None if there was nothing to draw."""
    if not any(axes.lines or axes.patches for axes in figure.axes):
        plt.close(figure)
        return None
    folder = os.path.join(results.folder, "plots")
    os.makedirs(folder, exist_ok=True)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, name + ".svg"), metadata={"Date": None})
    figure.savefig(os.path.join(folder, name + ".png"), dpi=110)
    plt.close(figure)
    return name


def show_legend(axes, beside=False):
    if axes.get_legend_handles_labels()[0]:
        place = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)} if beside else {}
        axes.legend(fontsize=7, **place)


def curve(axes, rows, x, y, program):
    """Draws a line through those rows of a program that have both numbers."""
    points = sorted((row[x], y(row)) for row in rows if row["program"] == program and y(row))
    if points:
        axes.plot(*zip(*points), **style_of(program))


def draw_chain(results):
    rows = results.rows("chain")
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.5, 3.4))
    colors = (BLACK, ORANGE, SKY, GREEN, BLUE, VERMILION)
    listed = [row for row in rows if row["program"] == "ours-1" and "flipped" in row]
    for row, color in zip(listed, colors):
        iterations = range(1, len(row["flipped"]) + 1)
        left.step(iterations, row["flipped"], where="mid", color=color,
                  label=f"m = {row['triangles']}")
    left.set(xlabel="iteration", ylabel="flips", title="Flips of every iteration")
    left.set_xscale("log")
    left.set_yscale("log")
    show_legend(left)
    for program in ("ours-1", "ours-gpu", "paper", "lawson"):
        curve(right, rows, "triangles", lambda row: median(row, "flips_ms"), program)
    right.set(xlabel="triangles m", ylabel="milliseconds", xscale="log", yscale="log",
              title="Time of all flips")
    show_legend(right)
    if not right.lines:
        right.remove()
    return save(figure, results, "fig6")


def draw_times(results):
    figure, axes = plt.subplots(figsize=(8.5, 5))
    for program in STYLES:
        if program != "no-chunks":
            curve(axes, results.rows("random") + results.rows("rival"), "points", time_of, program)
    axes.set(xlabel="points", ylabel="milliseconds", xscale="log", yscale="log",
             title="Random bad meshes (of the paper's method, the flips alone)")
    show_legend(axes, beside=True)
    return save(figure, results, "fig8a")


def draw_quality(results):
    figure, axes = plt.subplots(figsize=(6.5, 3.8))
    rows = [row for row in results.rows("quality") if row["program"] == "paper"]
    if not rows:
        return save(figure, results, "fig8b")
    sizes = sorted({row["points"] for row in rows})
    smallest = 1e-6
    for precision, color in (("float", VERMILION), ("double", BLUE)):
        for size, marker in zip(sizes, "osD"):
            points = sorted((row["epsilon"], max(row["percent"], smallest)) for row in rows
                            if row["precision"] == precision and row["points"] == size)
            axes.plot(*zip(*points), color=color, marker=marker,
                      linestyle="-" if precision == "float" else "--",
                      label=f"paper's method, {precision}, {size:,} points")
    axes.axhline(0.05, color=BLACK, linestyle=":", label="the paper: less than 0.05 %")
    axes.axhline(smallest, color=GREEN, label="this project: 0")
    axes.set(xlabel="epsilon of eq. 5 (radians)", ylabel="different triangles (%)", xscale="log",
             yscale="log", title=f"Triangles that differ from CGAL's (0 drawn at {smallest:g})")
    show_legend(axes, beside=True)
    return save(figure, results, "fig8b")


def fit_logarithm(points):
    """(a, b) of iterations = a + b log10(points), or None."""
    if len({size for size, _ in points}) < 2:
        return None
    sizes, iterations = zip(*points)
    slope, start = numpy.polyfit(numpy.log10(sizes), iterations, 1)
    return float(start), float(slope)


def iterations_by_size(results, program):
    """(points, iterations) of runs that ended by themselves."""
    found = {row["points"]: row["iterations"] for row in results.rows("random")
             if row["program"] == program and row.get("stop") == "converged"}
    return sorted(found.items())


SCHEDULES = ("ours-all", "ours-gpu", "no-chunks", "paper-all", "paper-gpu")


def draw_iterations(results):
    figure, axes = plt.subplots(figsize=(6.5, 3.8))
    for program in SCHEDULES:
        points = iterations_by_size(results, program)
        if not points:
            continue
        style = style_of(program)
        hollow = {"fillstyle": "none", "markersize": 10} if program == "no-chunks" else {}
        axes.plot(*zip(*points), **{**style, **hollow, "linestyle": "none"})
        fit = fit_logarithm(points)
        if fit:
            sizes = numpy.geomspace(points[0][0], points[-1][0], 50)
            axes.plot(sizes, fit[0] + fit[1] * numpy.log10(sizes), color=style["color"],
                      linestyle=style["linestyle"], linewidth=1)
    axes.set(xlabel="points", ylabel="iterations", xscale="log",
             title="Iterations, with logarithmic fits")
    axes.set_ylim(bottom=0)
    show_legend(axes)
    return save(figure, results, "fig9a")


def rows_of_largest(results):
    """{program: row} of the largest random mesh of each schedule."""
    rows = {}
    for row in results.rows("random"):
        program = row["program"]
        if "flipped" in row and (program not in rows or row["points"] > rows[program]["points"]):
            rows[program] = row
    return rows


def draw_flips(results):
    rows = rows_of_largest(results)
    chosen = [name for name in ("ours-all", "no-chunks", "paper-gpu", "paper-all") if name in rows]
    figure, axes = plt.subplots(1, max(1, len(chosen)), figsize=(8.5, 3.2), sharey=True,
                                squeeze=False)
    for plot, program in zip(axes[0], chosen):
        row = rows[program]
        iterations = range(1, len(row["flipped"]) + 1)
        plot.plot(iterations, row["flipped"], color=BLUE, label="flipped")
        plot.plot(iterations, row["excluded"], color=VERMILION, linestyle="--", label="excluded")
        plot.set(xlabel="iteration", yscale="symlog",
                 title=f"{label_of(program)}\n{row['points']:,} points")
        plot.title.set_fontsize(8)
        show_legend(plot)
    axes[0][0].set_ylabel("edges")
    return save(figure, results, "fig9b")


def draw_surfaces(results):
    rows = [row for row in results.rows("surface") if row["threshold"] == 180]
    rows += results.rows("meshlib")
    meshes = list(dict.fromkeys(row["mesh"] for row in rows))
    programs = [name for name in STYLES if any(row["program"] == name for row in rows)]
    figure, axes = plt.subplots(figsize=(8.5, 3.8))
    width = 0.8 / max(1, len(programs))
    for number, program in enumerate(programs):
        for place, mesh in enumerate(meshes):
            times = [median(row, "flips_ms") for row in rows
                     if row["program"] == program and row["mesh"] == mesh]
            if times and times[0]:
                axes.bar(place + number * width, times[0], width, color=STYLES[program][1],
                         hatch=("", "//", "..", "xx")[number % 4], edgecolor="white",
                         label=label_of(program) if place == 0 else None)
    axes.set_xticks([place + 0.4 - width / 2 for place in range(len(meshes))], meshes, rotation=15)
    axes.set(ylabel="milliseconds", yscale="log", title="Flips of surfaces, all edges")
    show_legend(axes, beside=True)
    return save(figure, results, "fig11")


def draw_tests(results):
    rows = [row for row in results.rows("tests") if "decisions" in row]
    meshes = list(dict.fromkeys(row["mesh"] for row in rows))
    names = list(dict.fromkeys(row["program"] for row in rows))
    figure, axes = plt.subplots(1, 2, figsize=(8.5, 3.6), sharey=True)
    for plot, precision in zip(axes, ("float", "double")):
        for number, name in enumerate(names):
            shares = [share_of_wrong(rows, mesh, precision, name) for mesh in meshes]
            places = [place + 0.2 * number for place in range(len(meshes))]
            plot.bar(places, shares, 0.2, label=name, edgecolor="white",
                     color=(VERMILION, ORANGE, BLUE, SKY)[number % 4],
                     hatch=("", "//", "..", "xx")[number % 4])
        plot.set_xticks([place + 0.3 for place in range(len(meshes))], meshes)
        plot.set_yscale("symlog", linthresh=1.0)
        plot.set_title(f"{precision}: wrong decisions in a million")
    show_legend(axes[0])
    return save(figure, results, "tests")


def share_of_wrong(rows, mesh, precision, name):
    for row in rows:
        if (row["mesh"], row["precision"], row["program"]) == (mesh, precision, name):
            return 1e6 * (row["false_bad"] + row["missed_bad"]) / row["decisions"]
    return 0.0


def draw_ruined(results):
    rows = results.rows("ruined")
    cases = list(dict.fromkeys((row["ruined_by"], row["shape"]) for row in rows))
    figure, axes = plt.subplots(figsize=(8.5, 3.6))
    for number, case in enumerate(cases):
        of_case = [row for row in rows if (row["ruined_by"], row["shape"]) == case]
        style = {"color": (BLUE, SKY, VERMILION, ORANGE, GREEN, BLACK, PURPLE)[number % 7],
                 "marker": "osD^vP*<>"[number % 9]}
        axes.plot([row["feature_angle"] for row in of_case],
                  [row["mean_smallest_angle"] for row in of_case],
                  label=case[1] if case[0] == "nothing" else f"{case[1]}, ruined by {case[0]}",
                  **style)
        axes.plot(of_case[0]["feature_angle"], of_case[0]["mean_smallest_angle_before"],
                  linestyle="none", fillstyle="none", **style)
    axes.set(xlabel="feature angle (degrees)", ylabel="mean smallest angle (degrees)",
             title="Bad surfaces, after flips (open markers: before)")
    show_legend(axes, beside=True)
    return save(figure, results, "ruined")

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Fills the places of report.md with what was measured: one function for each figure. It draws the
figure into OUTPUT/plots and returns sentences and the lines of its tables. The colours are Okabe and
Ito's, which colour-blind readers can tell apart; markers and line styles differ as well."""

import contextlib
import os
import re
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

BLACK, ORANGE, SKY, GREEN = "#000000", "#E69F00", "#56B4E9", "#009E73"
BLUE, VERMILION, PURPLE = "#0072B2", "#D55E00", "#CC79A7"

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

plt.rcParams.update({
    "font.size": 9, "axes.grid": True, "grid.alpha": 0.3, "axes.spines.top": False,
    "axes.spines.right": False, "legend.frameon": False})


def number(value):
    """Three significant digits, thousands separated; a dash for nothing."""
    if value is None:
        return "-"
    if isinstance(value, (str, bool)):
        return str(value)
    if isinstance(value, int):
        return f"{value:,}"
    return f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.3g}"


def markdown(headers, rows):
    """The lines of a table. Columns that are empty in every row are left out."""
    cells = [[number(cell).replace("|", "/").replace("\n", " ") for cell in row] for row in rows]
    kept = [i for i in range(len(headers))
            if not cells or any(line[i] not in ("-", "") for line in cells)]
    return ["| " + " | ".join(headers[i] for i in kept) + " |", "|---" * len(kept) + "|",
            *("| " + " | ".join(line[i] for i in kept) + " |" for line in cells)]


def table(rows, *columns, **functions):
    """The lines of a table by columns "header" or "header=key". A key is that of a function of a
    row, or of the row. Times are shown with their spread."""
    def cell(row, key):
        if key in functions:
            return functions[key](row)
        value = row.get(key)
        if value and key.endswith("_ms"):
            median, smallest, largest = (number(value[name]) for name in (
                "median", "smallest", "largest"))
            return f"{median} ({smallest} to {largest})"
        return value

    keys = [column.split("=")[-1] for column in columns]
    return markdown([column.split("=")[0] for column in columns],
                    [[cell(row, key) for key in keys] for row in rows])


def label(row):
    return STYLES[row["program"]][0]


def median(row, name="total_ms"):
    return row[name]["median"] if name in row else None


def find(rows, **values):
    """The rows with these values."""
    return [row for row in rows if all(row.get(name) == value for name, value in values.items())]


def distinct(rows, get):
    return list(dict.fromkeys(get(row) for row in rows))


@contextlib.contextmanager
def drawing(results, name, columns=1, size=(8.5, 3.6), sharey=False):
    """Gives the axes of a figure, adds legends and saves it, unless nothing was drawn."""
    figure, axes = plt.subplots(1, columns, figsize=size, squeeze=False, sharey=sharey)
    yield axes[0]
    for plot in axes[0]:
        if plot.get_legend_handles_labels()[0]:
            beside = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5)} if columns == 1 else {}
            plot.legend(fontsize=7, **beside)
        elif not plot.lines and not plot.patches:
            plot.remove()
    if figure.axes:
        folder = os.path.join(results.folder, "plots")
        os.makedirs(folder, exist_ok=True)
        figure.tight_layout()
        figure.savefig(os.path.join(folder, name + ".png"), dpi=110)
    plt.close(figure)


def style(program, **more):
    name, color, marker, line = STYLES[program]
    return {"label": name, "color": color, "marker": marker, "linestyle": line, "markersize": 5,
            **more}


def curve(axes, rows, x, y, program):
    """Draws a line through those rows of a program that have both numbers."""
    points = sorted((row[x], y(row)) for row in find(rows, program=program) if y(row))
    if points:
        axes.plot(*zip(*points), **style(program))


def fig6(results):
    rows = results.rows("chain")
    with drawing(results, "fig6", 2, (8.5, 3.4)) as (left, right):
        listed = [row for row in find(rows, program="ours-1") if "flipped" in row]
        for row, color in zip(listed, (BLACK, ORANGE, SKY, GREEN, BLUE, VERMILION)):
            left.step(range(1, len(row["flipped"]) + 1), row["flipped"], where="mid", color=color,
                      label=f"m = {row['triangles']}")
        left.set(xlabel="iteration", ylabel="flips", title="Flips of every iteration",
                 xscale="log", yscale="log")
        for program in ("ours-1", "ours-gpu", "paper", "lawson"):
            curve(right, rows, "triangles", lambda row: median(row, "flips_ms"), program)
        right.set(xlabel="triangles m", ylabel="milliseconds", xscale="log", yscale="log",
                  title="Time of all flips")
    ours = [row for row in rows if row["program"].startswith("ours")]
    smallest = find(rows, program="ours-1", triangles=6)
    return ([f"m = 6: flips {smallest[0]['flipped'] if smallest else None}.",
             f"{sum(row['is_ramp'] for row in ours)} of {len(ours)} runs of this project have "
             "exactly these flips."],
            table(rows, "triangles m=triangles", "program", "iterations", "flips",
                  "1, 2, ... m/2 ... 2, 1=ramp", "ms, flips=flips_ms", "us per iteration=cost",
                  program=label,
                  ramp=lambda row: {True: "yes", False: "no"}.get(row.get("is_ramp")),
                  cost=lambda row: 1e3 * median(row, "flips_ms") / row["iterations"]
                  if "flips_ms" in row and "iterations" in row else None))


def fig8a(results):
    """The time to compare is that from arrays or points to the mesh; for the paper's method that of
    the flips alone."""
    def time_of(row):
        return median(row) or median(row, "flips_ms")

    order = list(STYLES)
    rows = [row for row in results.rows("random") + results.rows("rival")
            if row["program"] != "no-chunks" and (time_of(row) or "flips" in row)]
    rows.sort(key=lambda row: (row["points"], order.index(row["program"])))
    with drawing(results, "fig8a", size=(8.5, 5)) as (axes,):
        for program in STYLES:
            curve(axes, rows, "points", time_of, program)
        axes.set(xlabel="points", ylabel="milliseconds", xscale="log", yscale="log",
                 title="Random bad meshes (of the paper's method, the flips alone)")
    own = {}
    for row in rows:
        if row["program"] in ("ours-gpu", "ours-all") and time_of(row):
            own.setdefault(row["points"], time_of(row))  # the GPU comes first
    measured = []
    for other, ours in (("paper-gpu", "ours-gpu"), ("paper-all", "ours-all"),
                        ("lawson", "ours-gpu"), ("lawson", "ours-all")):
        size, ratio = compare_flips(results, other, ours)
        if size:
            measured.append(f"Flips of {size:,} points: {STYLES[other][0]} takes {number(ratio)} "
                            f"times as long as {STYLES[ours][0]}.")
    return measured or ["No times in this run."], table(
        rows, "points", "program", "ms, everything=total_ms", "ms, flips=flips_ms",
        "times this project's=times", "flips", "iterations", "bad edges left=bad_left", "stop",
        program=label, times=lambda row: median(row) / own[row["points"]]
        if row["points"] in own and "total_ms" in row else None)


def compare_flips(results, other, ours):
    """The largest random mesh with the flips of both, and the ratio of their times."""
    times = {(row["program"], row["points"]): median(row, "flips_ms")
             for row in results.rows("random") if "flips_ms" in row}
    sizes = [size for program, size in times if program == ours and (other, size) in times]
    if not sizes:
        return None, None
    return max(sizes), times[other, max(sizes)] / times[ours, max(sizes)]


def fig8b(results):
    smallest = 1e-6
    rows = results.rows("quality")
    papers = find(rows, program="paper")
    with drawing(results, "fig8b", size=(6.5, 3.8)) as (axes,):
        for precision, color, line in (("float", VERMILION, "-"), ("double", BLUE, "--")):
            for size, marker in zip(sorted({row["points"] for row in papers}), "osD"):
                points = sorted((row["epsilon"], max(row["percent"], smallest)) for row in
                                find(papers, precision=precision, points=size))
                axes.plot(*zip(*points), color=color, marker=marker, linestyle=line,
                          label=f"paper's method, {precision}, {size:,} points")
        if papers:
            axes.axhline(0.05, color=BLACK, linestyle=":", label="the paper: less than 0.05 %")
            axes.axhline(smallest, color=GREEN, label="this project: 0")
            axes.set(xlabel="epsilon of eq. 5 (radians)", ylabel="different triangles (%)",
                     xscale="log", yscale="log",
                     title=f"Triangles that differ from CGAL's (0 drawn at {smallest:g})")
    ours = [row["different"] for row in find(rows, program="ours, canonical")]
    measured = [f"This project: {sum(ours)} different triangles in {len(ours)} meshes."]
    whole = {row["points"]: row["triangles"] for row in rows}
    compared = [row for row in results.rows("rival") if "different" in row]
    for row in compared:
        if row["triangles"] < whole.get(row["points"], 0):
            measured.append(f"{label(row)} left {whole[row['points']] - row['triangles']} of "
                            f"{whole[row['points']]:,} triangles out.")
    stuck = [row["epsilon"] for row in find(papers, stop="iteration limit")]
    if stuck:
        measured.append(f"In {len(stuck)} runs the paper's method found no end; the largest epsilon "
                        f"of these is {max(stuck):g}.")
    # The runs of this project are repeated by every part.
    once = {}
    for row in sorted(rows, key=lambda row: row["points"]):
        once.setdefault((row["points"], row["program"], row.get("precision"), row.get("epsilon")),
                        row)
    return measured, table(
        [*once.values(), *compared], "points", "program", "precision", "epsilon", "triangles",
        "different triangles=different", "percent", "bad edges left=bad_left", "iterations", "stop",
        epsilon=lambda row: f"{row['epsilon']:g}" if "epsilon" in row else None)


def fit_iterations(results, program):
    """(points, iterations) of the runs that ended by themselves, and (a, b) of iterations =
    a log10(points) + b, or None."""
    points = sorted({row["points"]: row["iterations"] for row in find(
        results.rows("random"), program=program, stop="converged")}.items())
    if len(points) < 2:
        return points, None
    sizes, iterations = zip(*points)
    return points, numpy.polyfit(numpy.log10(sizes), iterations, 1)


def fig9a(results):
    rows, measured = [], []
    with drawing(results, "fig9a", size=(6.5, 3.8)) as (axes,):
        for program in ("ours-all", "ours-gpu", "no-chunks", "paper-all", "paper-gpu"):
            points, fit = fit_iterations(results, program)
            if not points:
                continue
            rows += [(STYLES[program][0], *point) for point in points]
            hollow = {"fillstyle": "none", "markersize": 10} if program == "no-chunks" else {}
            axes.plot(*zip(*points), **{**style(program), **hollow, "linestyle": "none"})
            if fit is not None:
                sizes = numpy.geomspace(points[0][0], points[-1][0], 50)
                axes.plot(sizes, fit[1] + fit[0] * numpy.log10(sizes), color=STYLES[program][1],
                          linestyle=STYLES[program][3], linewidth=1)
                measured.append(f"{STYLES[program][0]}: {fit[0]:.2f} log10(n) {fit[1]:+.1f}.")
        axes.set(xlabel="points", ylabel="iterations", xscale="log", ylim=(0, None),
                 title="Iterations, with logarithmic fits")
    return measured, markdown(("schedule", "points", "iterations"), rows)


def rows_of_largest(results):
    """{program: row} of the largest random mesh of each schedule."""
    rows = {}
    for row in results.rows("random"):
        program = row["program"]
        if "flipped" in row and (program not in rows or row["points"] > rows[program]["points"]):
            rows[program] = row
    return rows


def share_excluded(row):
    excluded = sum(row["excluded"])
    return 100 * excluded / max(1, excluded + sum(row["flipped"]))


def share_of_first_half(row):
    return 100 * sum(row["flipped"][: len(row["flipped"]) // 2]) / max(1, sum(row["flipped"]))


def fig9b(results):
    rows = rows_of_largest(results)
    chosen = [name for name in ("ours-all", "no-chunks", "paper-gpu", "paper-all") if name in rows]
    with drawing(results, "fig9b", max(1, len(chosen)), (8.5, 3.2), sharey=True) as axes:
        for plot, program in zip(axes, chosen):
            row = rows[program]
            iterations = range(1, len(row["flipped"]) + 1)
            plot.plot(iterations, row["flipped"], color=BLUE, label="flipped")
            plot.plot(iterations, row["excluded"], color=VERMILION, linestyle="--",
                      label="excluded")
            plot.set(xlabel="iteration", yscale="symlog")
            plot.set_title(f"{label(row)}\n{row['points']:,} points", fontsize=8)
        axes[0].set_ylabel("edges")
    return ([f"{label(row)}, {row['points']:,} points: {share_excluded(row):.1f} % excluded."
             for row in rows.values()],
            table(rows.values(), "program", "points", "flips", "flips per point=each",
                  "excluded, %=excluded", "flips of the first half, %=half", program=label,
                  each=lambda row: row["flips"] / row["points"], excluded=share_excluded,
                  half=share_of_first_half))


def bars(axes, groups, programs, get, color):
    """Draws get(group, program) beside each other, and names the groups."""
    width = 0.8 / max(1, len(programs))
    for i, program in enumerate(programs):
        heights = [get(group, program) or 0 for group in groups]
        axes.bar([place + i * width for place in range(len(groups))], heights, width,
                 color=color(i, program), hatch=("", "//", "..", "xx")[i % 4], edgecolor="white",
                 label=STYLES[program][0] if program in STYLES else program)
    axes.set_xticks([place + 0.4 - width / 2 for place in range(len(groups))], groups, rotation=15)


def fig11(results):
    rows = results.rows("surface") + [{**row, "threshold": 180} for row in results.rows("meshlib")]
    free = find(rows, threshold=180)

    def time_of(mesh, program, threshold=180):
        found = find(rows, mesh=mesh, program=program, threshold=threshold)
        return median(found[0], "flips_ms") if found else None

    def against_lawson(row):
        mine = median(row, "flips_ms")
        theirs = time_of(row["mesh"], "lawson", row["threshold"])
        return theirs / mine if mine and theirs else None

    with drawing(results, "fig11", size=(8.5, 3.8)) as (axes,):
        programs = [name for name in STYLES if find(free, program=name)]
        if any("flips_ms" in row for row in free):
            bars(axes, distinct(free, lambda row: row["mesh"]), programs, time_of,
                 lambda _, program: STYLES[program][1])
            axes.set(ylabel="milliseconds", yscale="log", title="Flips of surfaces, all edges")
    made = {"ours": 0, "paper": 0}
    for row in rows:
        program = row["program"].split("-")[0]
        made[program] = made.get(program, 0) + row.get("duplicate_edges", 0)
    lines = table(
        rows, "mesh", "triangles", "threshold", "program", "flips", "iterations",
        "ms, flips=flips_ms", "Lawson's time by this=ratio", "bad edges left=bad_by_angle",
        "edges made twice=duplicate_edges", program=label, ratio=against_lawson)
    return ([f"Edges that existed already and were made again: {made['ours']} by this project, "
             f"{made['paper']} by the paper's method."], [*lines, "", *make_table_2(free)])


def make_table_2(rows):
    """Flips and excluded share of every iteration, without threshold, by mesh."""
    short = {"ours-all": "this project", "paper-all": "paper's method"}
    columns = [row for row in rows if row["program"] in short]

    longest = max((len(row["flipped"]) for row in columns), default=0)

    def cells(row):
        shares = (f"{f:,} ({100 * e / max(1, f + e):.2f} %)"
                  for f, e in zip(row["flipped"], row["excluded"]))
        return [*shares, *[""] * (longest - len(row["flipped"])), row["flips"]]

    headers = [f"{row['mesh']}, {short[row['program']]}" for row in columns]
    return markdown(["iteration", *headers],
                    zip([*range(1, longest + 1), "total"], *map(cells, columns)))


def tests(results):
    rows = results.rows("tests")
    judged = [row for row in rows if "decisions" in row]
    with drawing(results, "tests", 2, sharey=True) as axes:
        for plot, precision in zip(axes, ("float", "double")):
            def share_of_wrong(mesh, program):
                row = find(judged, mesh=mesh, precision=precision, program=program)[0]
                return 1e6 * (row["false_bad"] + row["missed_bad"]) / row["decisions"]

            bars(plot, distinct(judged, lambda row: row["mesh"]),
                 distinct(judged, lambda row: row["program"]), share_of_wrong,
                 lambda i, _: (VERMILION, ORANGE, BLUE, SKY)[i % 4])
            plot.set_yscale("symlog", linthresh=1.0)
            plot.set_title(f"{precision}: wrong decisions in a million")
    endless = {}
    for row in find(rows, stop="iteration limit"):
        endless.setdefault(row["program"], {})[f"{row['mesh']} in {row['precision']}"] = None
    measured = [f"\"{test}\" found no end on {', '.join(where)}."
                for test, where in endless.items()]
    clean, turned = [], []
    for row in find(rows, program="ours, in-circle"):
        (turned if row["turned_over_before"] else clean).append(row["bad_left"])
    measured.append(f"Exact in-circle left {sum(clean)} bad edges in {len(clean)} runs, and "
                    f"{sum(turned)} in {len(turned)} runs on meshes with triangles that rounding "
                    "had turned over.")
    return measured, table(
        rows, "mesh", "precision", "test=program", "where=backend", "ms, flips=flips_ms",
        "iterations", "stop", "flips", "good called bad=false_bad", "bad called good=missed_bad",
        "bad edges left=bad_left", "turned over (input)=turned",
        turned=lambda row: f"{row['turned_over']:,} ({row['turned_over_before']:,})")


def ruined(results):
    rows = results.rows("ruined")
    with drawing(results, "ruined") as (axes,):
        for i, (kind, shape) in enumerate(distinct(
                rows, lambda row: (row["ruined_by"], row["shape"]))):
            case = find(rows, ruined_by=kind, shape=shape)
            look = {"color": (BLUE, SKY, VERMILION, ORANGE, GREEN, BLACK, PURPLE)[i % 7],
                    "marker": "osD^vP*<>"[i % 9]}
            axes.plot([row["feature_angle"] for row in case],
                      [row["mean_smallest_angle"] for row in case], **look,
                      label=shape if kind == "nothing" else f"{shape}, ruined by {kind}")
            axes.plot(case[0]["feature_angle"], case[0]["mean_smallest_angle_before"],
                      linestyle="none", fillstyle="none", **look)
        axes.set(xlabel="feature angle (degrees)", ylabel="mean smallest angle (degrees)",
                 title="Bad surfaces, after flips (open markers: before)")
    other = sum(row["left_other"] for row in rows)
    goals = {row["shape"]: row["mean_smallest_angle_of_good"] for row in rows
             if "mean_smallest_angle_of_good" in row}
    return [f"Bad edges left without one of the three reasons: {other}."], table(
        rows, "ruined by=ruined_by", "shape", "feature angle=feature_angle", "flips",
        "smallest angle, before=smallest_angle_before", "after=smallest_angle",
        "mean of smallest angles, before=mean_smallest_angle_before", "after=mean_smallest_angle",
        "of the good surface=goal", "left: fixed=left_fixed",
        "left: would exist twice=left_duplicate", "left: would fold=left_fold", "distance",
        "change of volume=volume_change", goal=lambda row: goals.get(row["shape"]))


def claims(results):
    """What was measured of the paper's claims, by the place in report.md."""
    cells = {}
    for program in ("ours-all", "no-chunks", "paper-all", "paper-gpu"):
        fit = fit_iterations(results, program)[1]
        if fit is not None:
            cells[f"{program} fit"] = f"{fit[0]:.2f} log10(points) {fit[1]:+.1f}"
    cells["paper fit"] = cells.get("paper-gpu fit", cells.get("paper-all fit"))
    quality = results.rows("quality")
    cells["ours quality"] = max(
        (row["different"] for row in find(quality, program="ours, canonical")), default=None)
    ended = find(quality, program="paper", precision="float", stop="converged")
    if ended:
        largest = max(row["points"] for row in ended)
        best = min(find(ended, points=largest), key=lambda row: row["percent"])
        cells["paper quality"] = (f"{number(best['percent'])} % in single precision with epsilon "
                                  f"{best['epsilon']:g} ({largest:,} points)")
    for who, chain in (("ours", "ours-1"), ("paper", "paper")):
        own = find(results.rows("chain"), program=chain)
        if own:
            cells[f"{who} chains"] = (
                f"so in {sum(row['is_ramp'] for row in own)} of {len(own)} chains of up to "
                f"{own[-1]['triangles']:,} triangles")
        for place in ("gpu", "all"):
            size, ratio = compare_flips(results, "lawson", f"{who}-{place}")
            if size:
                cells[f"{place} size"] = size
                cells[f"{who}-{place} speed"] = f"{number(ratio)} times"
        rows = rows_of_largest(results)
        row = rows.get(who + "-gpu") or rows.get(who + "-all")
        if row:
            at = f"({row['points']:,} points)"
            cells[f"{who} flips"] = f"{number(row['flips'] / row['points'])} {at}"
            cells[f"{who} half"] = f"{share_of_first_half(row):.1f} % {at}"
            cells[f"{who} excluded"] = f"{share_excluded(row):.1f} % {at}"
        counts = [row["iterations"] for row in find(results.rows("surface"), threshold=180)
                  if row["program"].startswith(who)]
        if counts:
            cells[f"{who} iterations"] = f"{min(counts)} to {max(counts)}"
    return cells


def machine(results):
    rows = [(name, "; ".join(value) if isinstance(value, list) else str(value))
            for name, value in results.machine.items() if name != "rivals"]
    return [], markdown(("", ""), rows)


def rivals(results):
    rows = [(name, about.get("version", "absent: " + about.get("absent", "")), about["licence"])
            for name, about in results.machine.get("rivals", {}).items()]
    rows = rows or [("none", "absent: no virtual environment with packages", "")]
    return [], markdown(("package", "version", "licence"), rows)


def failures(results):
    return [], markdown(("part", "reason"), results.failures() or [("none", "")])


FIGURES = (fig6, fig8a, fig8b, fig9a, fig9b, fig11, tests, ruined, machine, rivals, failures)


def make(results, images="plots"):
    """The report in Markdown, and its plots in the folder of the results."""
    here = os.path.dirname(os.path.abspath(__file__))
    with open(os.path.join(here, "report.md"), encoding="utf-8") as file:
        text = file.read()
    for figure in FIGURES:
        name = figure.__name__
        sentences, lines = figure(results)
        measured = textwrap.fill(f"**Measured here:** {' '.join(sentences)}", 98,
                                 break_long_words=False, break_on_hyphens=False)
        title = text[: text.index(f"@{name}@")].rsplit("\n## ", 1)[-1].split("\n", 1)[0]
        is_drawn = os.path.isfile(os.path.join(results.folder, "plots", name + ".png"))
        plot = f"![{title.removeprefix('## ')}]({images}/{name}.png)\n\n" if is_drawn else ""
        text = text.replace(f"@{name} measured@", measured).replace(f"@{name} plot@\n\n", plot)
        text = text.replace(f"@{name}@", "\n".join(lines))
    cells = claims(results)
    return re.sub("@([a-z0-9 -]+)@", lambda place: number(cells.get(place[1])), text)

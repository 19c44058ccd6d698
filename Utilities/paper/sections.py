# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""For each figure and table of the paper: what it says, what was measured here, and how and why the
two differ."""

from dataclasses import dataclass, field

import plots
from results import median
from tables import Table, number


@dataclass
class Section:
    title: str
    paper: str  # what the paper says
    measured: list  # sentences
    departures: str
    plots: list = field(default_factory=list)
    tables: list = field(default_factory=list)


def describe_time(row, name):
    """The median with its spread."""
    time = row.get(name)
    if not time:
        return "-"
    return f"{number(time['median'])} ({number(time['smallest'])} to {number(time['largest'])})"


def make_sections(results):
    makers = (section_chain, section_times, section_quality, section_iterations, section_flips,
              section_surfaces, section_tests, section_ruined)
    return [make(results) for make in makers]


def section_chain(results):
    rows = results.rows("chain")
    ours = [row for row in rows if row["program"].startswith("ours")]
    flips = {(row["program"], row["triangles"]): row for row in rows}
    smallest = flips.get(("ours-1", 6), {}).get("flipped")
    ramps = sum(row["is_ramp"] for row in ours)
    table = Table(
        ("triangles m", "program", "iterations", "flips", "1, 2, ... m/2 ... 2, 1",
         "ms, flips", "us per iteration"),
        [(row["triangles"], plots.label_of(row["program"]), row.get("iterations"), row["flips"],
          {True: "yes", False: "no"}.get(row.get("is_ramp"), "-"), describe_time(row, "flips_ms"),
          per_iteration(row)) for row in rows],
    )
    return Section(
        "Fig. 6: the worst case",
        "Six triangles take the flips 1, 2, 3, 2, 1; m triangles take m - 1 iterations, with flips "
        "that rise by one up to m/2 and fall by one after it. Sequential flips are O(n²).",
        [f"m = 6: flips {smallest}.",
         f"{ramps} of {len(ours)} runs of this project have exactly these flips."],
        "The paper gives no coordinates. The chain here has small integers; its flips are decided "
        "exactly. The paper's cost of an iteration is that of all edges, ours that of the edges "
        "that changed.",
        [plots.draw_chain(results)], [table])


def per_iteration(row):
    time = median(row, "flips_ms")
    return 1e3 * time / row["iterations"] if time and row.get("iterations") else None


def time_rows(results):
    """Rows of Fig. 8a, by size and then by program."""
    order = list(plots.STYLES)
    rows = [row for row in results.rows("random") + results.rows("rival")
            if row["program"] != "no-chunks" and (plots.time_of(row) or "flips" in row)]
    return sorted(rows, key=lambda row: (row["points"], order.index(row["program"])))


def section_times(results):
    rows = time_rows(results)
    own = {}
    for row in rows:
        if row["program"] in ("ours-gpu", "ours-all") and plots.time_of(row):
            own.setdefault(row["points"], plots.time_of(row))  # the GPU comes first
    table = Table(
        ("points", "program", "ms, everything", "ms, flips", "times this project's", "flips",
         "iterations", "bad edges left", "stop"),
        [(row["points"], plots.label_of(row["program"]), describe_time(row, "total_ms"),
          describe_time(row, "flips_ms"), ratio(row, own), row.get("flips"), row.get("iterations"),
          row.get("bad_left"), row.get("stop")) for row in rows])
    return Section(
        "Fig. 7 and 8a: time on random bad meshes",
        "About three times as fast as CGAL and Triangle, and up to 50 times as fast as sequential "
        "Lawson, on a GeForce GTX 580 and an AMD Phenom; 100,000 to 5 M points.",
        speed_up_sentences(rows),
        "\"Everything\" is from arrays to arrays, or from points to triangles; of the paper's "
        "method only flips are timed, since its arrays of edges were built when a mesh was loaded. "
        "Ratios compare everything with everything, and flips with flips. Lawson is exact here and "
        "lists the edges to look at. Points are multiples of 2^-24, so that CGAL and this project "
        "see the same numbers in single precision. Larger meshes than 5 M points are made in tiles.",
        [plots.draw_times(results)], [table])


def ratio(row, own):
    mine, time = own.get(row["points"]), median(row, "total_ms")
    return time / mine if mine and time else None


def speed_up_sentences(rows):
    """The paper's method and Lawson compared with this project on the same hardware, flips alone."""
    flips = {(row["program"], row["points"]): median(row, "flips_ms") for row in rows}
    pairs = (("paper-gpu", "ours-gpu"), ("paper-all", "ours-all"), ("lawson", "ours-gpu"),
             ("lawson", "ours-all"))
    sentences = []
    for other, own in pairs:
        sizes = [s for (program, s), time in flips.items()
                 if program == own and time and flips.get((other, s))]
        if sizes:
            size = max(sizes)
            times = flips[other, size] / flips[own, size]
            sentences.append(f"Flips of {size:,} points: {plots.label_of(other)} takes "
                             f"{number(times)} times as long as {plots.label_of(own)}.")
    return sentences or ["No times in this run."]


def section_quality(results):
    rows = results.rows("quality")
    compared = [row for row in results.rows("rival") if "different" in row]
    ours = [row["different"] for row in rows if row["program"] == "ours, canonical"]
    table = Table(
        ("points", "program", "precision", "epsilon", "triangles", "different triangles",
         "percent", "bad edges left", "iterations", "stop"),
        [(row["points"], row["program"], row.get("precision", "-"), format_epsilon(row),
          row["triangles"], row["different"], row["percent"], row["bad_left"], row.get("iterations"),
          row.get("stop", "-")) for row in unique(rows) + compared])
    stuck = [row for row in rows
             if row["program"] == "paper" and row["stop"] == "iteration limit"]
    measured = [f"This project: {sum(ours)} different triangles in {len(ours)} meshes."]
    whole = {row["points"]: row["triangles"] for row in rows}
    measured += [f"{plots.label_of(row['program'])} left {whole[row['points']] - row['triangles']} "
                 f"of {whole[row['points']]:,} triangles out." for row in compared
                 if row["triangles"] < whole.get(row["points"], 0)]
    if stuck:
        measured.append(f"In {len(stuck)} runs the paper's method found no end; the largest epsilon "
                        f"of these is {max(row['epsilon'] for row in stuck):g}.")
    return Section(
        "Fig. 8b: triangles that differ from CGAL's",
        "Less than 0.05 % of the triangles differ. Epsilon was \"experimentally estimated\".",
        measured,
        "The paper does not give its epsilon. Near pi a cosine's last bit is worth 3.5e-4 radians in "
        "single precision, so smaller epsilons flip edges that are good, to and fro, and fold the "
        "mesh. Ties are decided as CGAL does in \"ours, canonical\"; \"ours\" keeps them.",
        [plots.draw_quality(results)], [table])


def format_epsilon(row):
    return f"{row['epsilon']:g}" if "epsilon" in row else "-"


def unique(rows):
    """Rows without the runs of this project that every part repeats."""
    seen, kept = set(), []
    for row in sorted(rows, key=lambda row: row["points"]):
        key = (row["points"], row["program"], row.get("precision"), row.get("epsilon"))
        if key not in seen:
            seen.add(key)
            kept.append(row)
    return kept


def section_iterations(results):
    rows, measured = [], []
    for program in plots.SCHEDULES:
        points = plots.iterations_by_size(results, program)
        fit = plots.fit_logarithm(points)
        if fit:
            measured.append(f"{plots.label_of(program)}: {fit[1]:.2f} log10(n) {fit[0]:+.1f}.")
        rows += [(plots.label_of(program), size, iterations) for size, iterations in points]
    return Section(
        "Fig. 9a: iterations over size",
        "An empirical curve of O(log n).",
        measured,
        "Up to 12 iterations of this project run within chunks that fit a cache, where edges "
        "between chunks sit out; that costs iterations and saves time. Without chunks: the same "
        "plane judged as a surface, which has none. Only runs that ended by themselves count.",
        [plots.draw_iterations(results)],
        [Table(("schedule", "points", "iterations"), rows)])


def section_flips(results):
    table_rows, measured = [], []
    for program, row in plots.rows_of_largest(results).items():
        flipped, excluded = sum(row["flipped"]), sum(row["excluded"])
        half = sum(row["flipped"][: len(row["flipped"]) // 2])
        table_rows.append((plots.label_of(program), row["points"], flipped,
                           flipped / row["points"], 100 * excluded / max(1, flipped + excluded),
                           100 * half / max(1, flipped)))
    for program, points, _, _, share, _ in table_rows:
        measured.append(f"{program}, {points:,} points: {share:.1f} % excluded.")
    return Section(
        "Fig. 9b: flips and excluded edges of every iteration",
        "About 37 M flips for 5 M points; most of them in the first half of the iterations; under "
        "20 % of the threads excluded.",
        measured,
        "The paper does not say what exactly it counts. Here an excluded edge is one that was found "
        "bad and did not flip in that iteration. In the paper's method threads see some neighbours "
        "before and others after their flips, so its share depends on how many run at a time: "
        "threads of a CPU come to many neighbours of an edge after its flip. In this project the "
        "share contains the edges between chunks, which wait.",
        [plots.draw_flips(results)],
        [Table(("program", "points", "flips", "flips per point", "excluded, %",
                "flips of the first half, %"), table_rows)])


PAPER_SURFACES = Table(
    ("of the paper", "points", "triangles", "here"),
    [("Moai", 10_002, 20_000, "not in any public collection that we know"),
     ("Horse", 112_642, 225_280, "of Cyberware; the scan is public in another resolution"),
     ("Dragon", 437_645, 871_414, "Stanford's dragon_vrip.ply"),
     ("Infinite", 1_586_302, 3_172_608, "custom-made; a bumpy torus stands in")])


def section_surfaces(results):
    rows = results.rows("surface") + [{**row, "threshold": 180} for row in results.rows("meshlib")]
    table = Table(
        ("mesh", "triangles", "threshold", "program", "flips", "iterations", "ms, flips",
         "Lawson's time by this", "bad edges left", "edges made twice"),
        [(row["mesh"], row["triangles"], row["threshold"], plots.label_of(row["program"]),
          row["flips"], row.get("iterations"), describe_time(row, "flips_ms"),
          against_lawson(row, rows), row.get("bad_by_angle"), row.get("duplicate_edges"))
         for row in rows])
    return Section(
        "Fig. 10, Fig. 11 and Table 2: surfaces",
        "5 to 10 iterations; 0 to 9 % excluded in each; up to 80 times as fast as sequential "
        "Lawson. An edge is considered only where the two normals are almost parallel.",
        describe_duplicates(rows),
        "The paper does not give its threshold; 30 degrees here, and 180 for none. Its method judges "
        "normals when it tests an edge, so the result depends on the order of flips; this project "
        "decides once, from the input. The paper does not ask whether a new edge exists already, nor "
        "whether a flip folds the surface over. Bad edges are counted in double precision beyond "
        "2e-6 radians, those beyond the threshold included. With none, this project leaves those that it "
        "must not flip, and those that the rounding of the points can explain.",
        [plots.draw_surfaces(results)],
        [PAPER_SURFACES, table, make_table_2(results)])


def against_lawson(row, rows):
    for other in rows:
        if other["program"] == "lawson" and other["mesh"] == row["mesh"] \
                and other["threshold"] == row["threshold"]:
            mine, theirs = median(row, "flips_ms"), median(other, "flips_ms")
            return theirs / mine if mine and theirs else None
    return None


def describe_duplicates(rows):
    made = {}
    for row in rows:
        program = row["program"].split("-")[0]
        made[program] = made.get(program, 0) + row.get("duplicate_edges", 0)
    return [f"Edges that existed already and were made again: {made.get('ours', 0)} by this "
            f"project, {made.get('paper', 0)} by the paper's method."]


def make_table_2(results):
    """Flips and excluded share of every iteration, without threshold, by mesh."""
    columns = [row for row in results.rows("surface")
               if row["threshold"] == 180 and row["program"] in ("ours-all", "paper-all")]
    longest = max((len(row["flipped"]) for row in columns), default=0)
    lines = [tuple([i + 1] + [cell_of(row, i) for row in columns]) for i in range(longest)]
    lines.append(tuple(["total"] + [number(row["flips"]) for row in columns]))
    short = {"ours-all": "this project", "paper-all": "paper's method"}
    headers = ["iteration"] + [f"{row['mesh']}, {short[row['program']]}" for row in columns]
    return Table(tuple(headers), lines)


def cell_of(row, i):
    if i >= len(row["flipped"]):
        return ""
    flipped, excluded = row["flipped"][i], row["excluded"][i]
    return f"{flipped:,} ({100 * excluded / max(1, flipped + excluded):.2f} %)"


def section_tests(results):
    rows = results.rows("tests")
    table = Table(
        ("mesh", "precision", "test", "where", "ms, flips", "iterations", "stop", "flips",
         "good called bad", "bad called good", "bad edges left", "turned over (input)"),
        [(row["mesh"], row["precision"], row["program"], row["backend"],
          describe_time(row, "flips_ms"), row["iterations"], row["stop"], row["flips"],
          row.get("false_bad"), row.get("missed_bad"), row["bad_left"],
          f"{row['turned_over']:,} ({row['turned_over_before']:,})") for row in rows])
    endless = {}
    for row in rows:
        if row["stop"] == "iteration limit":
            endless.setdefault(row["program"], []).append(f"{row['mesh']} in {row['precision']}")
    measured = [f"\"{test}\" found no end on {', '.join(dict.fromkeys(where))}."
                for test, where in endless.items()]
    clean, turned = [], []
    for row in (row for row in rows if row["program"] == "ours, in-circle"):
        (turned if row["turned_over_before"] else clean).append(row["bad_left"])
    measured.append(f"Exact in-circle left {sum(clean)} bad edges in {len(clean)} runs, and "
                    f"{sum(turned)} in {len(turned)} runs on meshes whose triangles rounding had "
                    "turned over.")
    return Section(
        "Future work 1: in-circle against opposite angles",
        "\"We will compare the in-circle test with the opposite angle test.\"",
        measured,
        "Both tests run in the paper's method, with and without a tolerance, and exactly in this "
        "project. Every run is judged by exact arithmetic on the points as its precision holds "
        "them. The error bound is Shewchuk's: a larger determinant has the right sign, so every "
        "flip is right and the loop ends. Mesh \"offset\" is the random one as survey coordinates "
        "with millions of metres: single precision turns triangles over before any flip.",
        [plots.draw_tests(results)], [table])


def section_ruined(results):
    rows = results.rows("ruined")
    table = Table(
        ("ruined by", "shape", "feature angle", "flips", "smallest angle, before", "after",
         "mean of smallest angles, before", "after", "of the good surface", "left: fixed",
         "left: would exist twice", "left: would fold", "distance", "change of volume"),
        [(row["ruined_by"], row["shape"], row["feature_angle"], row["flips"],
          row["smallest_angle_before"], row["smallest_angle"], row["mean_smallest_angle_before"],
          row["mean_smallest_angle"], row.get("mean_smallest_angle_of_good"), row["left_fixed"],
          row["left_duplicate"], row["left_fold"], row["distance"], row["volume_change"])
         for row in rows])
    other = sum(row["left_other"] for row in rows)
    return Section(
        "Future work 2: surfaces of bad quality",
        "\"We also want to test the algorithm with bad quality 3D surface meshes.\"",
        [f"Bad edges left without one of the three reasons: {other}."],
        "Good surfaces are ruined by random legal flips, by splitting a tenth of the edges at 2 % of "
        "their length, or made with points twenty times as dense one way as the other. The distance "
        "is the largest from the middle of a changed edge to the other surface, by the diagonal of "
        "the bounding box; the change of volume means nothing for an open surface. Flips undo "
        "flips; they cannot undo badly placed points.",
        [plots.draw_ruined(results)], [table])

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The paper's claims, one per row, and what was measured here."""

import plots
from results import median
from tables import Table, number


def make_claims(results):
    rows = [claim_worst_case(results), claim_iterations(results), *claim_speed(results),
            claim_quality(results), claim_flips(results), claim_first_half(results),
            claim_excluded(results), claim_surfaces(results)]
    return Table(("the paper", "this project", "the paper's method, here"), [
        row for row in rows if row])


def claim_worst_case(results):
    rows = results.rows("chain")

    def count(program):
        own = [row for row in rows if row["program"] == program]
        exact = sum(row["is_ramp"] for row in own)
        return f"so in {exact} of {len(own)} chains of up to {own[-1]['triangles']:,} triangles" if own else "-"

    return ("Fig. 6: m triangles take m - 1 iterations, flips rise and fall by one",
            count("ours-1"), count("paper"))


def claim_iterations(results):
    def fit(program):
        found = plots.fit_logarithm(plots.iterations_by_size(results, program))
        return f"{found[1]:.2f} log10(points) {found[0]:+.1f}" if found else "-"

    ours = fit("ours-all")
    return ("iterations grow as O(log n)", f"{ours}; without chunks {fit('no-chunks')}",
            fit("paper-gpu") if fit("paper-gpu") != "-" else fit("paper-all"))


def claim_speed(results):
    """A row for each comparison that this run has times for; the largest size they share."""
    flips = {(row["program"], row["points"]): median(row, "flips_ms")
             for row in results.rows("random")}
    for place in ("gpu", "all"):
        sizes = [size for (program, size), time in flips.items()
                 if program == "lawson" and time and flips.get((f"ours-{place}", size))
                 and flips.get((f"paper-{place}", size))]
        if sizes:
            size = max(sizes)
            lawson = flips["lawson", size]
            where = "GPU" if place == "gpu" else "all threads"
            yield (f"up to 50 times as fast as sequential Lawson ({where}, {size:,} points, flips)",
                   f"{number(lawson / flips[f'ours-{place}', size])} times",
                   f"{number(lawson / flips[f'paper-{place}', size])} times")


def claim_quality(results):
    rows = results.rows("quality")
    ours = [row["different"] for row in rows if row["program"] == "ours, canonical"]
    ended = [row for row in rows
             if row["program"] == "paper" and row["precision"] == "float"
             and row["stop"] == "converged"]
    largest = max((row["points"] for row in ended), default=0)
    best = min((row for row in ended if row["points"] == largest),
               key=lambda row: row["percent"], default=None)
    theirs = "-"
    if best:
        theirs = (f"{number(best['percent'])} % in single precision with epsilon "
                  f"{best['epsilon']:g} ({largest:,} points)")
    return ("less than 0.05 % of the triangles differ from CGAL's",
            f"{max(ours, default=0)} triangles", theirs)


def of_schedule(results, describe):
    """describe(row) of the largest mesh, for this project and for the paper's method."""
    rows = plots.rows_of_largest(results)
    ours = rows.get("ours-gpu") or rows.get("ours-all")
    theirs = rows.get("paper-gpu") or rows.get("paper-all")
    return tuple(f"{describe(row)} ({row['points']:,} points)" if row else "-"
                 for row in (ours, theirs))


def claim_flips(results):
    return ("37 M flips for 5 M points: 7.4 for each",
            *of_schedule(results, lambda row: number(row["flips"] / row["points"])))


def claim_first_half(results):
    def share(row):
        half = sum(row["flipped"][: len(row["flipped"]) // 2])
        return f"{100 * half / max(1, row['flips']):.1f} %"

    return ("most flips in the first half of the iterations", *of_schedule(results, share))


def claim_excluded(results):
    def share(row):
        excluded = sum(row["excluded"])
        return f"{100 * excluded / max(1, excluded + row['flips']):.1f} %"

    return ("less than 20 % excluded", *of_schedule(results, share))


def claim_surfaces(results):
    rows = [row for row in results.rows("surface") if row["threshold"] == 180]

    def span(program):
        found = [row["iterations"] for row in rows if row["program"].startswith(program)]
        return f"{min(found)} to {max(found)}" if found else "-"

    return ("5 to 10 iterations on surfaces", span("ours"), span("paper"))

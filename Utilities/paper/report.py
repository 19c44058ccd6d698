# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Writes report.md, with links to the plots, and report.html, which contains them."""

import base64
import html
import os
import textwrap

from claims import make_claims
from sections import make_sections
from tables import Table

TITLE = "The paper, reproduced"
INTRODUCTION = (
    "C. A. Navarro, N. Hitschfeld-Kahler, E. Scheihing: A GPU-based Method for Generating "
    "quasi-Delaunay Triangulations based on Edge-flips, GRAPP 2013. Beside each of its figures: "
    "what it says, what was measured here, and where the two depart and why. \"The paper's method\" "
    "is a baseline written from its text. Times are medians, with the smallest and the largest in "
    "brackets."
)

STYLE = """
body { font: 15px/1.45 sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222 }
table { border-collapse: collapse; font-size: 12px; margin: 1em 0; display: block; overflow-x: auto }
td, th { border: 1px solid #ccc; padding: 2px 6px; text-align: right }
th { background: #f2f2f2 }
img { max-width: 100% }
dt { font-weight: bold; margin-top: .6em }
"""


def write(results):
    sections, tables = gather(results)
    with open(os.path.join(results.folder, "report.md"), "w", encoding="utf-8") as file:
        file.write(make_markdown(sections, tables) + "\n")
    with open(os.path.join(results.folder, "report.html"), "w", encoding="utf-8") as file:
        file.write(make_html(sections, tables, results.folder))


def gather(results):
    """All sections, and (title, table) of the tables after them."""
    sections = make_sections(results)
    for section in sections:
        section.plots = [plot for plot in section.plots if plot]
    return sections, [("The claims of the paper", make_claims(results)),
                      describe_machine(results), list_rivals(results), list_failures(results)]


def describe_machine(results):
    machine = results.machine
    rows = [(name, "; ".join(map(str, value)) if isinstance(value, list) else str(value))
            for name, value in machine.items() if name != "rivals"]
    return "Machine", Table(("", ""), rows)


def list_rivals(results):
    rows = [(name, about.get("version", "absent: " + about.get("absent", "")), about["licence"])
            for name, about in results.machine.get("rivals", {}).items()]
    if not rows:
        rows = [("none", "absent: no virtual environment with packages", "")]
    return "Other people's programs", Table(("package", "version", "licence"), rows)


def list_failures(results):
    rows = results.failures() or [("none", "")]
    return "What did not run to its end", Table(("part", "reason"), rows)


def make_markdown(sections, tables, images="plots"):
    lines = [f"# {TITLE}", "", *wrap(INTRODUCTION)]
    for section in sections:
        lines += [f"## {section.title}", "", *wrap(f"**The paper says:** {section.paper}"),
                  *wrap(f"**Measured here:** {' '.join(section.measured)}"),
                  *wrap(f"**Where we depart, and why:** {section.departures}")]
        for plot in section.plots:
            lines += [f"![{section.title}]({images}/{plot}.png)", ""]
        for table in section.tables:
            lines += table.in_markdown()
    for title, table in tables:
        lines += [f"## {title}", "", *table.in_markdown()]
    return "\n".join(lines)


def wrap(text):
    return [*textwrap.wrap(text, 98, break_long_words=False, break_on_hyphens=False), ""]


def make_html(sections, tables, folder):
    parts = [f"<!DOCTYPE html><html lang='en'><meta charset='utf-8'><title>{TITLE}</title>",
             f"<style>{STYLE}</style><h1>{TITLE}</h1><p>{html.escape(INTRODUCTION)}</p>"]
    for section in sections:
        parts.append(f"<h2>{html.escape(section.title)}</h2><dl>")
        for term, text in (("The paper says", section.paper),
                           ("Measured here", " ".join(section.measured)),
                           ("Where we depart, and why", section.departures)):
            parts.append(f"<dt>{term}</dt><dd>{html.escape(text)}</dd>")
        parts.append("</dl>")
        parts += [embed(folder, plot, section.title) for plot in section.plots]
        parts += [table.in_html() for table in section.tables]
    for title, table in tables:
        parts.append(f"<h2>{title}</h2>{table.in_html()}")
    return "\n".join(parts) + "\n</html>\n"


def embed(folder, plot, title):
    with open(os.path.join(folder, "plots", plot + ".svg"), "rb") as file:
        data = base64.b64encode(file.read()).decode()
    return f"<p><img alt='{html.escape(title)}' src='data:image/svg+xml;base64,{data}'></p>"

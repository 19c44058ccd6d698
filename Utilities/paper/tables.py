# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Tables of the report, and how they look in Markdown and HTML."""

import html
from dataclasses import dataclass


@dataclass
class Table:
    headers: tuple
    rows: list

    def trimmed(self):
        """The table without columns that are empty in every row."""
        kept = [i for i in range(len(self.headers))
                if not self.rows or any(number(row[i]) not in ("-", "") for row in self.rows)]
        return Table(tuple(self.headers[i] for i in kept),
                     [tuple(row[i] for i in kept) for row in self.rows])

    def in_markdown(self):
        """The table as lines of Markdown."""
        table = self.trimmed()
        lines = ["| " + " | ".join(table.headers) + " |", "|---" * len(table.headers) + "|"]
        for row in table.rows:
            cells = [number(cell).replace("|", "/").replace("\n", " ") for cell in row]
            lines.append("| " + " | ".join(cells) + " |")
        return lines + [""]

    def in_html(self):
        table = self.trimmed()
        head = "".join(f"<th>{html.escape(cell)}</th>" for cell in table.headers)
        rows = "".join(
            "<tr>" + "".join(f"<td>{html.escape(number(cell))}</td>" for cell in row) + "</tr>"
            for row in table.rows)
        return f"<table><tr>{head}</tr>{rows}</table>"


def number(value):
    """Three significant digits, thousands separated; a dash for nothing."""
    if value is None:
        return "-"
    if isinstance(value, (str, bool)):
        return str(value)
    if isinstance(value, int):
        return f"{value:,}"
    if value == 0:
        return "0"
    return f"{value:,.0f}" if abs(value) >= 1000 else f"{value:.3g}"

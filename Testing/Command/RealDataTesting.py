# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Helpers for the tests on real meshes. The meshes are not part of this project; they are in the
folder DELAUNAYFLIP_DATA_DIR. Without it there is nothing to test."""

import os
import sys

from CommandTesting import CommandTest, read_report

FOLDER = os.environ.get("DELAUNAYFLIP_DATA_DIR", "")
if not os.path.isdir(FOLDER):
    print(f"skipped: no folder of real meshes at '{FOLDER}' (DELAUNAYFLIP_DATA_DIR)")
    sys.exit(125)

KEPT = ["points", "triangles", "edges", "boundary_edges", "non_manifold_edges"]


class RealDataTest(CommandTest):
    def flip(self, name, *arguments):
        """Flips a real mesh to out.vtk and checks that its counts stay. Returns the report."""
        report = self.report(os.path.join(FOLDER, name), "out.vtk", *arguments)
        self.assertTrue(report["converged"], name)
        # The command itself counts the edges of the output, without flipping any.
        result = self.run_command(
            *("out.vtk", "again.vtk", "--max-iterations", "0", "--report", "again.json", *arguments)
        )
        self.assertIn(result.returncode, (0, 4), result.stderr)
        again = read_report(self.path("again.json"))
        self.assertEqual([again[key] for key in KEPT], [report[key] for key in KEPT], name)
        self.assertEqual(again["min_angle_before_deg"], report["min_angle_after_deg"], name)
        return report

    def about(self, value, expected, name, share=0.05):
        """Compares counts that depend on the order of the flips."""
        self.assertLessEqual(abs(value - expected), share * expected, f"{name}: {value}")

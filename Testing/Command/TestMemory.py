# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Allocations that fail: the message names a file and what was being done to it."""

import os
import re
import unittest

from CommandTesting import CommandTest, bumpy_grid, write_mesh

NAMED = {
    "read": r"error: (mesh|lines)\.\w+: .*cannot be read",
    "flip": r"error: mesh\.\w+: cannot be flipped: .*(not enough memory|crashed)",
    "write": r"error: out\.\w+: cannot be written: ",
}


class Memory(CommandTest):
    def test_every_message_names_file_and_phase(self):
        seen = set()
        for source, target in ((".vtk", ".obj"), (".obj", ".ply"), (".vtp", ".vtp"), (".ply", ".vtk")):
            mesh = bumpy_grid(6, 1)
            write_mesh(mesh, self.path("mesh" + source))
            write_mesh(mesh, self.path("lines.stl"))
            number, harmless = 1, 0
            while harmless < 3:  # in a row: then there are no more allocations
                failed = self.fail_at(number, "mesh" + source, "out" + target, seen)
                harmless = 0 if failed or number < 100 else harmless + 1
                number = 1 + number * 5 // 4
        self.assertEqual(seen, set(NAMED))

    def fail_at(self, number, source, target, seen):
        """Makes the allocation with this number fail. Returns whether that mattered."""
        environment = dict(os.environ, FAILING_NEW=str(number))
        environment["LD_PRELOAD"] = os.environ["DELAUNAYFLIP_FAILING_NEW"]
        result = self.run_command(
            source, target, "--constraints", "lines.stl", "--threads", 1, "--quiet", env=environment
        )
        if os.path.exists(self.path(target)):
            os.remove(self.path(target))
            self.assertEqual(result.returncode, 0, result.stderr)
            return False
        self.assertEqual(result.returncode, 3, f"{number}: {result.stderr}")
        phases = [phase for phase, text in NAMED.items() if re.search(text, result.stderr)]
        self.assertEqual(len(phases), 1, f"{source}, {number}: {result.stderr}")
        seen.update(phases)
        return True


if __name__ == "__main__":
    unittest.main(verbosity=2)

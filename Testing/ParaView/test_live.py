# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Live update without polling: scripts make the steps; pvbatch and several ranks make none."""

import os
import subprocess

from paraview import simple

from launching import HAS_MPIRUN, launch, make_environment
from PluginTesting import PluginTest, fetch, get_triangles, main, make_fan, refresh

HERE = os.path.dirname(os.path.abspath(__file__))


class Live(PluginTest):
    def test_a_script_steps(self):
        source = self.read(make_fan(20))
        at_once = self.flip(source)
        live = self.flip(source, LiveUpdate=1, IterationsPerUpdate=3)
        self.assertEqual(live.NumberOfIterations, 3)
        self.assertEqual(live.StopReason, "running")
        steps = 1
        while live.StopReason == "running" and steps < 100:
            live.SMProxy.InvokeCommand("Advance")
            refresh(live)
            steps += 1
        self.assertEqual(steps, -(-at_once.NumberOfIterations // 3))
        self.assertEqual(get_triangles(fetch(live)), get_triangles(fetch(at_once)))

    def test_restart(self):
        live = self.flip(self.read(make_fan(20)), LiveUpdate=1)
        live.SMProxy.InvokeCommand("Advance")
        refresh(live)
        self.assertEqual(live.NumberOfIterations, 2)
        live.SMProxy.InvokeCommand("Restart")
        refresh(live)
        self.assertEqual(live.NumberOfIterations, 1)

    def test_the_client_is_told_to_poll(self):
        hints = simple.DelaunayFlip(Input=simple.Sphere()).SMProxy.GetHints()
        self.assertIsNotNone(hints.FindNestedElementByName("LiveSource"))


class Batch(PluginTest):
    """live_batch.py in pvbatch: even with LiveUpdate, it must reach the end at once."""

    def expect_the_end(self, *launcher):
        pvbatch = os.path.join(os.path.dirname(os.environ["DELAUNAYFLIP_PVPYTHON"]), "pvbatch")
        if not os.path.exists(pvbatch):
            self.skipTest("no pvbatch")
        script = os.path.join(HERE, "live_batch.py")
        run = subprocess.run(
            [*launcher, pvbatch, script, self.save(make_fan(20))], encoding="utf-8", check=False,
            env=make_environment(), timeout=120, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT)
        self.assertEqual(run.returncode, 0, run.stdout)
        self.assertIn("stopped: converged", run.stdout)

    def test_one_rank(self):
        self.expect_the_end()

    def test_two_ranks(self):
        if not HAS_MPIRUN:
            self.skipTest("no mpirun")
        self.expect_the_end(*launch(2))


if __name__ == "__main__":
    main()

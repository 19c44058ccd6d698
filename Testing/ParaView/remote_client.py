# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The client's part of test_remote.py: uses the plugin on the server at the given port."""

import sys

from paraview import servermanager, simple

from PluginTesting import PLUGIN, Messages, PluginTest, fetch, get_triangles, make_fan, refresh


class Client(PluginTest):
    def runTest(self):
        locally = get_triangles(fetch(self.flip(self.read(make_fan(50)))))
        simple.Connect("127.0.0.1", int(sys.argv[1]))
        simple.LoadPlugin(PLUGIN, remote=True)
        simple.LoadPlugin(PLUGIN, remote=False)
        self.assertTrue(servermanager.ActiveConnection.IsRemote())
        self.expect_same_as(locally)
        self.expect_error()

    def expect_same_as(self, triangles):
        flip = self.flip(self.read(make_fan(50)))
        self.assertIsNone(flip.SMProxy.GetClientSideObject())
        self.assertEqual(get_triangles(fetch(flip)), triangles)
        self.assertEqual(fetch(flip, 1).GetNumberOfRows(), flip.NumberOfIterations)
        self.assertEqual(flip.StopReason, "converged")
        self.assertRegex(flip.BackendUsed, "^Threads: [0-9]+$")

    def expect_error(self):
        """Errors on the server are reported on the client."""
        with Messages() as messages:
            refresh(simple.DelaunayFlip(Input=simple.Sphere(), TieRule="Canonical"))
        self.assertIn("tie rule", messages.text)


if __name__ == "__main__":
    Client().debug()
    print("all is well", flush=True)

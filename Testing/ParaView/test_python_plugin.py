# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The plugins in C++ and in Python have the same filter: the one in Python refuses to be the second.
"""

import contextlib
import io
import os
import unittest

from paraview import servermanager, simple

from PluginTesting import Messages, PluginTest, main

PYTHON_PLUGIN = os.environ["DELAUNAYFLIP_PYTHON_PLUGIN"]


class Refuses(PluginTest):
    def test_says_why(self):
        told = io.StringIO()
        with contextlib.redirect_stderr(told), Messages(), self.assertRaises(RuntimeError):
            simple.LoadPlugin(PYTHON_PLUGIN, remote=False, ns={})
        self.assertIn("The plugin DelaunayFlip in C++ is loaded already", told.getvalue())
        manager = servermanager.ProxyManager()
        prototype = manager.GetPrototypeProxy("filters", "DelaunayFlip")
        self.assertEqual(prototype.GetVTKClassName(), "vtkPVDelaunayFlip")


if __name__ == "__main__":
    main()

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter is available if only PV_PLUGIN_PATH names the plugin's folder."""

import unittest

from paraview import simple


class PluginPath(unittest.TestCase):
    def test_filter_is_there(self):
        flip = simple.DelaunayFlip(Input=simple.Sphere())
        flip.UpdatePipeline()
        flip.SMProxy.UpdatePipelineInformation()
        self.assertEqual(flip.GetPropertyValue("StopReason"), "converged")


if __name__ == "__main__":
    unittest.main(verbosity=2)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The site can be built without a warning: links, references to the sources, headings."""
import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

from pages import ROOT

TOOLS = [name for name in ("sphinx", "myst_parser", "breathe")
         if importlib.util.find_spec(name) is None]
if not shutil.which("doxygen"):
    TOOLS.append("doxygen")


@unittest.skipIf(TOOLS, f"absent: {', '.join(TOOLS)} (Debian: Utilities/install-packages.sh docs)")
class Site(unittest.TestCase):

    def test_no_warnings(self):
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run(
                [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "dummy",
                 f"{ROOT}/Documentation", folder],
                env={**os.environ, "DELAUNAYFLIP_DOXYGEN": os.path.join(folder, "doxygen")},
                capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)


if __name__ == "__main__":
    unittest.main()

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin in ParaView's Qt client: menu, Apply, panel, undo, and the mesh improving by itself.

client_session.py is what happens inside. Pictures stay in the folder DELAUNAYFLIP_PICTURES.
"""

import os
import shutil
import subprocess
import sys
import unittest

from PluginTesting import PluginTest, main, make_fan

HERE = os.path.dirname(os.path.abspath(__file__))
SKIPPED = 125
PATIENCE = 240  # seconds


def find_client():
    """The client's path; exits as skipped where it, or Python's Qt, is not there."""
    client = os.path.join(os.path.dirname(os.environ["DELAUNAYFLIP_PVPYTHON"]), "paraview")
    if not os.path.exists(client):
        print("skipped: no ParaView client", client)
        sys.exit(SKIPPED)
    try:
        import PyQt5.QtWidgets  # noqa: F401
    except ImportError:
        print("skipped: no PyQt5 (Debian: python3-pyqt5), which looks at the client's widgets")
        sys.exit(SKIPPED)
    return client


class Client(PluginTest):
    def test_session(self):
        self.save(make_fan(14))
        environment = dict(os.environ, DELAUNAYFLIP_FOLDER=self.folder, HOME=self.folder)
        environment["PYTHONPATH"] = HERE + os.pathsep + environment.get("PYTHONPATH", "")
        script = os.path.join(HERE, "client_session.py")
        client = subprocess.run(
            [find_client(), "--script=" + script], env=environment, timeout=PATIENCE,
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
            encoding="utf-8", check=False)
        for picture in ("applied.png", "live.png"):
            if os.path.exists(self.path(picture)):
                shutil.copy(self.path(picture), os.environ["DELAUNAYFLIP_PICTURES"])
        self.assertEqual(client.returncode, 0, client.stdout)
        self.assertIn("all is well", client.stdout)


if __name__ == "__main__":
    find_client()
    main()

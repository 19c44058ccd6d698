# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The plugin in ParaView's Qt client: menu, Apply, panel and live runs.

The sessions of client_sessions.py run inside it. Pictures stay in the folder DELAUNAYFLIP_PICTURES.
"""

import glob
import importlib.util
import os
import shutil
import subprocess
import sys

from PluginTesting import PluginTest, main, make_fan, make_line
from test_points import make_cloud

HERE = os.path.dirname(os.path.abspath(__file__))
SKIPPED = 125
PATIENCE = 240  # seconds
QT = os.environ["DELAUNAYFLIP_QT"]  # the client's major version


def find_client():
    """The client's path. Exits as skipped if the client or Python's Qt is missing."""
    client = os.path.join(os.path.dirname(os.environ["DELAUNAYFLIP_PVPYTHON"]), "paraview")
    if not os.path.exists(client):
        print("skipped: no ParaView client", client)
        sys.exit(SKIPPED)
    if importlib.util.find_spec(f"PyQt{QT}") is None:
        print(f"skipped: no PyQt{QT} (Debian: python3-pyqt{QT}), which is needed to read the client's widgets")
        sys.exit(SKIPPED)
    return client


class Client(PluginTest):
    """Each test starts a client with a script that plays a session."""

    def play(self, session, **variables):
        """Plays a session in a client, with more variables in its environment. Returns its output."""
        self.save(make_fan(14))
        self.save(make_fan(30), "long.vtp")  # 17 iterations
        self.save(make_line(make_fan(30), 15, 29), "lines.vtp")
        self.save(make_cloud(1000), "cloud.vtp")
        environment = dict(os.environ, DELAUNAYFLIP_FOLDER=self.folder, HOME=self.folder,
                           DELAUNAYFLIP_SESSION=session, **variables)
        environment["PYTHONPATH"] = HERE + os.pathsep + environment.get("PYTHONPATH", "")
        client = subprocess.run(
            [find_client(), "--script=" + os.path.join(HERE, "client_sessions.py")], env=environment,
            timeout=PATIENCE, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, encoding="utf-8", check=False)
        for picture in glob.glob(self.path("*.png")):
            shutil.copy(picture, os.environ["DELAUNAYFLIP_PICTURES"])
        self.assertEqual(client.returncode, 0, client.stdout)
        self.assertIn("all is well", client.stdout)
        return client.stdout

    def test_sessions(self):
        for session in ("use_filter", "use_panel", "use_statistics", "use_points"):
            with self.subTest(session):
                self.assertNotRegex(self.play(session), "ERR[|]|WARN[|]|warning:")

    def test_start_with_plugin_in_python(self):
        self.play("start_with_plugin", PV_PLUGIN_PATH=os.environ["DELAUNAYFLIP_PYTHON_PLUGINS"])


if __name__ == "__main__":
    find_client()
    main()

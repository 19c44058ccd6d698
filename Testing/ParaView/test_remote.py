# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""A client and a pvserver on the loopback, with the plugin loaded on both sides.

Both run as separate programs, to check that the end of one ends the other.
"""

import os
import select
import socket
import subprocess
import time
import unittest

PATIENCE = 60  # seconds, for a program to start or to end
CLIENT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "remote_client.py")


def find_free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def wait_for_text(stream, text):
    """Reads the output of a program until it contains `text`. Returns the output."""
    printed, deadline = "", time.monotonic() + PATIENCE
    while text not in printed and time.monotonic() < deadline:
        if select.select([stream], [], [], 1.0)[0]:
            piece = os.read(stream.fileno(), 4096).decode()
            if not piece:
                break
            printed += piece
    return printed


class Remote(unittest.TestCase):
    def start(self, *command):
        """Starts a program, which is ended with the test at the latest."""
        program = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.STDOUT)
        self.addCleanup(program.stdout.close)
        self.addCleanup(program.wait)
        self.addCleanup(program.kill)
        return program

    def test_client_and_server(self):
        port = find_free_port()
        server = self.start(os.environ["DELAUNAYFLIP_PVSERVER"], f"--server-port={port}")
        printed = wait_for_text(server.stdout, "Accepting connection")
        self.assertIn("Accepting connection", printed)
        client = self.start(os.environ["DELAUNAYFLIP_PVPYTHON"], CLIENT, str(port))
        said = client.communicate(timeout=2 * PATIENCE)[0].decode()
        self.assertEqual(client.returncode, 0, said)
        self.assertIn("all is well", said)
        self.assertEqual(server.wait(PATIENCE), 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)

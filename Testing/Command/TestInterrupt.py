# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Signals, and the output on a terminal."""

import os
import pty
import re
import select
import signal
import subprocess
import time

from CommandTesting import CommandTest, bumpy_grid, command_line, make_array, worst_case


class TerminalTest(CommandTest):
    def start(self, *arguments, disposition=signal.SIG_DFL):
        """Starts the command with a terminal as stderr. Returns the process and the terminal."""
        terminal, far_end = pty.openpty()
        self.addCleanup(os.close, terminal)
        process = subprocess.Popen(
            command_line(*arguments),
            cwd=self.folder,
            stdout=subprocess.PIPE,
            stderr=far_end,
            preexec_fn=lambda: signal.signal(signal.SIGINT, disposition),
        )
        self.addCleanup(process.stdout.close)
        os.close(far_end)
        return process, terminal


class Interrupt(TerminalTest):
    """The slow mesh takes 30,000 iterations, so the signal always comes before the end."""

    def setUp(self):
        super().setUp()
        self.mesh = self.write_mesh(worst_case(15000), "slow.vtk")
        self.write("out.vtk", "precious")

    def stop(self, number):
        """The exit code and last output of a command that gets the signal while it flips."""
        process, terminal = self.start(
            self.mesh, "out.vtk", "--report", "report", "--statistics", "table"
        )
        text = read_terminal(terminal, until=b"iteration")
        self.assertIn(b"iteration", text)
        process.send_signal(number)
        code = process.wait(timeout=60)
        return code, text + read_terminal(terminal)

    def test_interrupt(self):
        code, text = self.stop(signal.SIGINT)
        self.assertEqual(code, 130)
        self.assertIn(b"interrupted", text)
        self.assertEqual(sorted(os.listdir(self.folder)), ["out.vtk", "slow.vtk"])
        self.assertEqual(self.content("out.vtk"), b"precious")

    def test_termination(self):
        for number in (signal.SIGTERM, signal.SIGQUIT):
            code, _ = self.stop(number)
            self.assertEqual(code, 128 + number)
            self.assertEqual(sorted(os.listdir(self.folder)), ["out.vtk", "slow.vtk"])

    def test_ignored_interrupt_stays_ignored(self):
        """The signal is ignored, as for a job that a shell starts in the background."""
        mesh = self.write_mesh(worst_case(3000), "mesh.vtk")
        process, terminal = self.start(mesh, "new.vtk", disposition=signal.SIG_IGN)
        read_terminal(terminal, until=b"[")
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(timeout=60), 0)
        self.assertTrue(os.path.exists(self.path("new.vtk")))


class Terminal(TerminalTest):
    def errors_on_terminal(self, *arguments):
        process, terminal = self.start(*arguments)
        self.assertNotIn(b"\r", process.communicate(timeout=60)[0])
        self.assertEqual(process.returncode, 0)
        return read_terminal(terminal)

    def test_progress_bar_on_a_terminal_only(self):
        mesh = self.write_mesh(bumpy_grid(10, 0), "mesh.vtk")
        text = self.errors_on_terminal(mesh, "out.vtk")
        self.assertIn(b"\r", text)
        self.assertIn(b"reading", text)
        self.assertIn(b"[---", text)
        self.assertTrue(text.endswith(b"\r\033[K"), "the bar must be wiped")
        self.assertEqual(self.succeed(mesh, "out.vtk").stderr, "")

    def test_progress_bar_never_goes_back(self):
        """Each part of the job continues where the one before it ended."""
        mesh = self.write_mesh(bumpy_grid(500, 0), "mesh.vtk")  # some redraws per part
        text = self.errors_on_terminal(mesh, "out.vtp").decode()
        bars = re.findall(r"\[(#*)-*\] (\d+) %, (\w+)", text)
        percents = [int(percent) for _, percent, _ in bars]
        self.assertEqual(percents, sorted(percents), text)
        for done, percent, _ in bars:
            self.assertAlmostEqual(len(done), 0.3 * int(percent), delta=1.0)
        begins = {part: percent for percent, (_, _, part) in reversed([*zip(percents, bars)])}
        self.assertEqual([begins[part] for part in ("reading", "finding", "writing")], [0, 15, 60])

    def test_quiet(self):
        grid = bumpy_grid(10, 1)
        grid.GetPointData().AddArray(make_array("Age", range(100)))  # which .stl cannot hold
        mesh = self.write_mesh(grid, "mesh.vtk")
        self.assertEqual(self.errors_on_terminal(mesh, "out.stl", "--quiet"), b"")
        result = self.succeed(mesh, "out.stl", "--quiet")
        self.assertEqual((result.stdout, result.stderr), ("", ""))
        self.assertIn("note: ", self.succeed(mesh, "out.stl").stderr)
        self.fail_with(3, "none.vtk", "out.vtk", "--quiet", naming=["none.vtk"])


def read_terminal(terminal, until=None):
    """The output within a minute, up to `words` or, without any, up to a pause."""
    text = b""
    end = time.monotonic() + 60
    while time.monotonic() < end and not (until and until in text):
        ready, _, _ = select.select([terminal], [], [], 0.2 if until is None else 1.0)
        if ready:
            try:
                text += os.read(terminal, 4096)
            except OSError:  # the other end has been closed
                break
        elif until is None:
            break
    return text

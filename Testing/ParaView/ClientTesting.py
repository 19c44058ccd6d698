# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Drives ParaView's Qt client from inside, as a user would: menus, the Apply button, waiting.

For scripts that the client runs by --script. The script's session is a generator: it yields a
function, and the client continues until that function returns true.
"""

import importlib
import os
import sys
import time
import traceback

from paraview import simple

# For the Qt of ParaView's client. Another version in the same process would crash it.
QT = "PyQt" + os.environ.get("DELAUNAYFLIP_QT", "5")
QtCore = importlib.import_module(QT + ".QtCore")
QtWidgets = importlib.import_module(QT + ".QtWidgets")

FOLDER = os.environ["DELAUNAYFLIP_FOLDER"]
PATIENCE = 60  # seconds, for one wait
TICK = 20  # milliseconds between two checks


class Client:
    """The client's main window."""

    def __init__(self):
        self.application = QtWidgets.QApplication.instance()
        self.window = next(
            widget for widget in self.application.topLevelWidgets()
            if widget.metaObject().className() == "ParaViewMainWindow")

    def find_menus(self):
        """[(title, menu)] of the menu bar and below, filled as when a user opens them."""
        bar = self.window.menuBar()
        for action in bar.actions():
            if action.menu():
                action.menu().aboutToShow.emit()
        return [(menu.title().replace("&", ""), menu) for menu in bar.findChildren(QtWidgets.QMenu)]

    def find_actions(self, text):
        """{title of the menu: its action} of all menus with an action of this text."""
        return {title: action for title, menu in self.find_menus()
                for action in menu.actions() if action.text().replace("&", "") == text}

    def choose(self, menu, text):
        """Clicks an action of the menu bar."""
        self.find_actions(text)[menu].trigger()

    def select(self, text):
        """Clicks an entry of the Pipeline Browser."""
        selection = next(
            selection for selection in self.window.findChildren(QtCore.QItemSelectionModel)
            if selection.parent().metaObject().className() == "pqPipelineBrowserWidget")
        found = selection.model().match(
            selection.model().index(0, 0), QtCore.Qt.ItemDataRole.DisplayRole, text, 1,
            QtCore.Qt.MatchFlag.MatchExactly | QtCore.Qt.MatchFlag.MatchRecursive)
        selection.setCurrentIndex(
            found[0], QtCore.QItemSelectionModel.SelectionFlag.ClearAndSelect)

    def apply(self):
        """Clicks Apply."""
        self.window.findChild(QtWidgets.QPushButton, "Accept").click()

    def color_by(self, name):
        """Chooses an array in the toolbar."""
        choices = next(choices for choices in self.window.findChildren(QtWidgets.QComboBox, "Variables")
                       if choices.isVisible())
        choices.setCurrentIndex(choices.findText(name))

    def save_picture(self, name):
        """A picture of the whole window, in FOLDER."""
        path = os.path.join(FOLDER, name)
        self.application.processEvents()
        if not self.window.grab().save(path):
            raise OSError(f"cannot write {path}")


class Panel:
    """The widgets of a filter's properties, by the properties' names."""

    def __init__(self, client):
        self.window = client.window

    def find_all(self, name):
        """Not below Display, where some properties have the same names."""
        panel = self.window.findChild(QtWidgets.QWidget, "propertiesPanel")
        frame = panel.findChild(QtWidgets.QFrame, "PropertiesFrame")
        return frame.findChildren(QtWidgets.QWidget, name)

    def find(self, name, kind):
        widgets = [widget.findChild(kind) or widget for widget in self.find_all(name)]
        found = [widget for widget in widgets if isinstance(widget, kind)]
        if not found:
            raise LookupError(f"no {kind.__name__} {name}")
        return found[0]

    def is_shown(self, name):
        return any(widget.isVisible() for widget in self.find_all(name))

    def read(self, name):
        """The text of an information property."""
        return self.find(name, QtWidgets.QLabel).text()

    def write(self, name, text):
        edit = self.find(name, QtWidgets.QLineEdit)
        edit.setText(text)
        edit.textEdited.emit(text)
        edit.editingFinished.emit()

    def choose(self, name, text):
        self.find(name, QtWidgets.QComboBox).setCurrentText(text)

    def click(self, name):
        self.find(name, QtWidgets.QCheckBox).click()

    def press(self, name):
        self.find(name, QtWidgets.QPushButton).click()


def expect(truth, what):
    if not truth:
        raise AssertionError(what)


def load_plugin():
    simple.LoadPlugin(os.environ["DELAUNAYFLIP_PLUGIN"], remote=False)


def start_filter(client, source, menu_entry="Delaunay Flip"):
    """Chooses a filter of the plugin for a source, from the menu. Returns it, not applied yet."""
    before = simple.GetActiveSource()
    simple.Show(source)
    simple.ResetCamera()
    simple.SetActiveSource(source)
    yield idle(0.3)
    client.choose("Delaunay Flip", menu_entry)
    yield lambda: simple.GetActiveSource() not in (before, source)
    yield idle(0.3)
    return simple.GetActiveSource()


def idle(seconds):
    """A function to wait for, which returns true after so many seconds."""
    end = time.monotonic() + seconds
    return lambda: time.monotonic() > end


class _Player:
    """Plays a session on the client's own event loop, then ends the client."""

    def __init__(self, session):
        self.session = session
        self.wait_for(lambda: True)
        self.timer = QtCore.QTimer()
        self.timer.timeout.connect(self.look)
        self.timer.start(TICK)

    def wait_for(self, condition):
        self.condition = condition
        self.deadline = time.monotonic() + PATIENCE

    def look(self):
        self.timer.stop()  # the calls below may process events themselves
        try:
            if self.condition():
                self.resume()
            elif time.monotonic() > self.deadline:
                line = self.condition.__code__.co_firstlineno
                raise TimeoutError(f"waited {PATIENCE} s for what line {line} waits for")
            self.timer.start(TICK)
        except BaseException:
            traceback.print_exc()
            self.end(1)

    def resume(self):
        condition = next(self.session, None)
        if condition is None:
            self.end(0)
        self.wait_for(condition)

    def end(self, status):
        sys.stdout.flush()
        sys.stderr.flush()
        # Not by print, since the client may show what scripts print in a window.
        os.write(1, b"all is well\n" if status == 0 else b"FAILED\n")
        os._exit(status)


_players = []


def play(session):
    """Plays session(client) after the script has ended; the client's exit status is the result.
    """
    _players.append(_Player(session(Client())))

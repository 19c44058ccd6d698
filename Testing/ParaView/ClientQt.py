# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""PyQt's modules for the Qt of ParaView's client, whose major version is DELAUNAYFLIP_QT in the
environment (default 5). Another version in the same process would crash it."""

import importlib
import os

VERSION = os.environ.get("DELAUNAYFLIP_QT", "5")

QtCore = importlib.import_module(f"PyQt{VERSION}.QtCore")
QtWidgets = importlib.import_module(f"PyQt{VERSION}.QtWidgets")

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The files of the project, and the code snippets of its pages."""
import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Documentation"))

from pages import ROOT, read, snippets  # noqa: E402,F401 - for the tests beside this file

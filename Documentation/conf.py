# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Sphinx's settings for the site; Utilities/build-docs.sh builds it.

DELAUNAYFLIP_DOXYGEN in the environment is a folder for Doxygen's output.
"""
import importlib.util
import os
import re
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..", "Python")]

from headers import read_headers  # noqa: E402 - beside this file

with open(os.path.join(HERE, "..", "CMakeLists.txt"), encoding="utf-8") as file:
    release = version = re.search(r"project\(\w+ VERSION ([\d.]+)", file.read()).group(1)

project = "DelaunayFlip"
author = "The DelaunayFlip developers"
copyright = author  # noqa: A001 - the name is Sphinx's

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "breathe"]
if importlib.util.find_spec("sphinx_copybutton"):
    extensions.append("sphinx_copybutton")
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence", "deflist"]

doxygen = os.environ.get("DELAUNAYFLIP_DOXYGEN", os.path.join(HERE, "..", "build-docs", "doxygen"))
breathe_projects = {"delaunayflip": read_headers(doxygen)}
breathe_default_project = "delaunayflip"
breathe_default_members = ("members",)
autodoc_typehints = "none"
autodoc_member_order = "bysource"

html_theme = "furo" if importlib.util.find_spec("furo") else "alabaster"
html_title = f"DelaunayFlip {release}"

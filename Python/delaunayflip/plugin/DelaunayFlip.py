# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filters of the menu Delaunay Flip for ParaView, without compiling: a plugin in Python.

Start ParaView with PV_PLUGIN_PATH=.../delaunayflip/plugin, choose Tools > Manage Plugins > Load New
and this file, or in pvpython

    from paraview.simple import LoadPlugin
    LoadPlugin(".../delaunayflip/plugin/DelaunayFlip.py", remote=False, ns=globals())

It has the properties of the plugin in C++, but not its text in the view, its live updates and the
best-fitting plane of points: all flips are made at once. Partitions of a dataset, and the pieces of a
server with several processes, are flipped one by one: edges between them stay, with a warning, and
the statistics of pieces are those of the first process. The plugin in C++ flips them as one mesh.
Each plugin can read the state files of the other, but only one of the two can be loaded.

It has a folder of its own, because ParaView loads all files of a folder in PV_PLUGIN_PATH.
"""
import json
import pathlib
import sys
from xml.etree import ElementTree

# ParaView loads only this file; the package may be where ParaView does not search for packages.
_FOLDER = pathlib.Path(__file__).resolve().parent.parent
if str(_FOLDER.parent) not in sys.path:
    sys.path.append(str(_FOLDER.parent))

# Not paraview.servermanager: while the client starts, importing it would open a second session.
from paraview.modules.vtkRemotingServerManager import vtkSMProxyManager, vtkSMSettings
from paraview.modules.vtkRemotingViews import vtkSMTransferFunctionPresets
from paraview.util.vtkAlgorithm import smproperty, smproxy

import delaunayflip
from delaunayflip._vtk_filter import vtkDelaunayFlip
from delaunayflip._vtk_interpolator import vtkDelaunayFlipInterpolator
from delaunayflip._vtk_point_filter import vtkDelaunayFlipPoints

paraview_plugin_name = "DelaunayFlipPython"
paraview_plugin_version = delaunayflip.__version__


def _require_no_other():
    """Raises RuntimeError if the plugin in C++ is loaded."""
    manager = vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
    known = manager.GetPrototypeProxy("filters", "DelaunayFlip") if manager else None
    if known is not None and known.GetVTKClassName() == "vtkPDelaunayFlip":
        raise RuntimeError(
            "The plugin DelaunayFlip in C++ is loaded already, with the same filter. Use that one, or "
            "start ParaView without it to use this one in Python.")


def _find(name):
    """A file of the plugin in C++: in the package, or where its sources are."""
    return next(path for path in (_FOLDER / name, _FOLDER.parents[1] / "Plugin" / name) if path.exists())


def _read_properties(name):
    """The XML of a filter's properties in the C++ plugin, without the parts that need its libraries."""
    proxy = ElementTree.parse(_find("DelaunayFlip.xml")).find(f".//SourceProxy[@name='{name}']")
    for element in proxy.iter():
        if element.get("panel_widget", "") == "DelaunayFlipSourceList":
            element.set("panel_widget", "input_selector")
        elif element.get("panel_widget", "").startswith("DelaunayFlip"):
            del element.attrib["panel_widget"]
    hints = proxy.find("Hints")
    for live in hints.findall("LiveSource"):
        hints.remove(live)
    hints.find("ShowInMenu").attrib.pop("icon", None)
    return "".join(ElementTree.tostring(element, encoding="unicode") for element in proxy)


def _add_colors():
    """Makes the colours of angles the defaults of two arrays, and a preset that the user may choose."""
    colors, name = _find("AngleColors.json").read_text(), "Smallest angle"
    tables = {f"Smallestangle{when}degrees": {"PVLookupTable": json.loads(colors)}
              for when in ("before", "after")}
    vtkSMSettings.GetInstance().AddCollectionFromString(json.dumps({"array_lookup_tables": tables}), 0.5)
    presets = vtkSMTransferFunctionPresets.GetInstance()
    if not presets.HasPreset(name):  # the user may have changed it
        presets.AddPreset(name, colors)


_require_no_other()
_add_colors()


@smproxy.filter(name="DelaunayFlip", label="Delaunay Flip", support_reload=False)
@smproperty.xml(_read_properties("DelaunayFlip"))
class DelaunayFlip(vtkDelaunayFlip):
    """vtkDelaunayFlip for ParaView."""

    def GetNumberOfRounds(self):
        return 0  # Only the plugin in C++ flips the pieces of ranks as one mesh.

    def GetNumberOfMovedTriangles(self):
        return 0


@smproxy.filter(name="DelaunayFromPoints", label="Delaunay From Points", support_reload=False)
@smproperty.xml(_read_properties("DelaunayFromPoints"))
class DelaunayFromPoints(vtkDelaunayFlipPoints):
    """vtkDelaunayFlipPoints for ParaView."""


@smproxy.filter(
    name="InterpolateFromPoints", label="Interpolate From Points (Delaunay)", support_reload=False)
@smproperty.xml(_read_properties("InterpolateFromPoints"))
class InterpolateFromPoints(vtkDelaunayFlipInterpolator):
    """vtkDelaunayFlipInterpolator for ParaView."""

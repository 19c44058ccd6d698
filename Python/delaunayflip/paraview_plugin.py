# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The filter Delaunay Flip for ParaView, without compiling: a plugin in Python.

In ParaView choose Tools > Manage Plugins > Load New and this file, or in pvpython

    from paraview.simple import LoadPlugin
    LoadPlugin(".../delaunayflip/paraview_plugin.py", remote=False, ns=globals())

It has the properties of the plugin in C++, but not its chart, its text in the view, its widgets and
its live updates: all flips are made at once. Partitions of a dataset, and the pieces of a server
with several processes, are flipped one by one: edges between them stay, with a warning, and the
statistics of pieces are those of the first process. The plugin in C++ flips them as one mesh. Each
plugin can read the state files of the other, but only one of the two can be loaded.

The file is not called paraview.py, because ParaView imports a plugin under its name, which would
then hide ParaView's own module.
"""
import pathlib
import sys
from xml.etree import ElementTree

# ParaView loads only this file; the package may be where ParaView does not search for packages.
_FOLDER = pathlib.Path(__file__).resolve().parent
if str(_FOLDER.parent) not in sys.path:
    sys.path.append(str(_FOLDER.parent))

from paraview import servermanager
from paraview.util.vtkAlgorithm import smproperty, smproxy

import delaunayflip
from delaunayflip._vtk_filter import vtkDelaunayFlip
from delaunayflip._vtk_surfaces import to_poly_data

paraview_plugin_name = "DelaunayFlipPython"
paraview_plugin_version = delaunayflip.__version__


def _require_no_other():
    """Raises RuntimeError if the plugin in C++ is loaded."""
    manager = servermanager.vtkSMProxyManager.GetProxyManager().GetActiveSessionProxyManager()
    known = manager.GetPrototypeProxy("filters", "DelaunayFlip") if manager else None
    if known is not None and known.GetVTKClassName() == "vtkPVDelaunayFlip":
        raise RuntimeError(
            "The plugin DelaunayFlip in C++ is loaded already, with the same filter. Use that one, or "
            "start ParaView without it to use this one in Python.")


def _read_properties():
    """The XML of the C++ plugin's properties, without the parts that need its libraries."""
    (proxy,) = ElementTree.parse(_FOLDER / "DelaunayFlip.xml").iter("SourceProxy")
    for element in proxy.iter():
        if element.get("panel_widget", "").startswith("DelaunayFlip"):
            del element.attrib["panel_widget"]
    hints = proxy.find("Hints")
    hints.remove(hints.find("LiveSource"))
    del hints.find("ShowInMenu").attrib["icon"]
    return "".join(ElementTree.tostring(element, encoding="unicode") for element in proxy)


_require_no_other()


@smproxy.filter(name="DelaunayFlip", label="Delaunay Flip", support_reload=False)
@smproperty.xml(_read_properties())
class DelaunayFlip(vtkDelaunayFlip):
    """vtkDelaunayFlip for ParaView, which accepts any surface."""

    def FillInputPortInformation(self, port, info):
        result = super().FillInputPortInformation(port, info)
        if port == 0:
            info.Set(self.INPUT_REQUIRED_DATA_TYPE(), "vtkDataSet")
            info.Append(self.INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet")
        return result

    def get_mesh(self, data):
        return to_poly_data(data)

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The contents of the menu and of the Properties panel, and how the plugin is found and loaded."""

import contextlib
import io
import os
import re
import unittest

from paraview import servermanager, simple
from paraview.modules.vtkRemotingClientServerStream import vtkClientServerInterpreterInitializer

from PluginTesting import Messages, PluginTest, main, refresh

FILTERS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Filters")


def list_properties(*names):
    """The properties with both a setter and a getter in the headers of a class and its bases."""
    header = ""
    for each in names:
        with open(os.path.join(FILTERS, each + ".h"), encoding="utf-8") as file:
            header += file.read().split("\nprotected:")[0]

    def list_accessors(verb):
        pattern = rf"\bvtk{verb}\w*Macro\((\w+)|\b{verb}(\w+)\("
        return {macro or method for macro, method in re.findall(pattern, header)}

    return list_accessors("Set") & list_accessors("Get")


def describe_class(name):
    """{property: value as text} of a new object of the class, without a proxy."""
    interpreter = vtkClientServerInterpreterInitializer.GetGlobalInterpreter()
    text = str(interpreter.NewInstance(name))
    own = text[text.index("  Backend: "):]
    return dict(re.findall(r"^  (\w+): (.*)$", own, re.MULTILINE))


class Proxy(PluginTest):
    name, label = "DelaunayFlip", "Delaunay Flip"
    vtk_class, bases = "vtkDelaunayFlip", ("vtkDelaunayFlipAlgorithm",)
    ports, is_live = ["Mesh", "Iterations"], True
    choices = {"Geometry": ["Auto", "Planar", "Planar XY", "Surface", "Sphere"],
               "Criterion": ["In-circle", "Opposite angles"],
               "TieRule": ["Keep", "Canonical"],
               "Backend": ["Auto", "CUDA", "Threads"]}

    def setUp(self):
        super().setUp()
        self.proxy = getattr(simple, self.name)(Input=simple.Sphere())
        self.of_class = list_properties(self.vtk_class, *self.bases) - {"Transform"}
        if not self.is_live:
            self.of_class -= {"LiveUpdate", "IterationsPerUpdate", "Paused", "KeepSession", "PassSegments"}

    def property(self, name):
        return self.proxy.SMProxy.GetProperty(name)

    def own_properties(self):
        names = self.proxy.ListProperties()
        return [name for name in names if name not in ("Input", "Constraints", "Segments", "Source")]

    def test_hints(self):
        """An entry in the menu, no view for the table, polling of live runs, movies."""
        hints = self.proxy.SMProxy.GetHints()
        self.assertEqual(self.proxy.SMProxy.GetXMLLabel(), self.label)
        menu = hints.FindNestedElementByName("ShowInMenu")
        self.assertEqual(menu.GetAttribute("category"), "Delaunay Flip")
        view = hints.FindNestedElementByName("View")
        self.assertEqual((view.GetAttribute("type"), view.GetAttribute("port")), ("None", "1"))
        self.assertEqual(hints.FindNestedElementByName("LiveSource") is not None, self.is_live)
        self.assertEqual(self.property("MaximumIterations").GetAnimateable(), self.is_live)

    def test_everything_is_documented(self):
        self.assertIn("Delaunay", self.proxy.SMProxy.GetDocumentation().GetLongHelp())
        for name in self.proxy.ListProperties():
            text = self.property(name).GetDocumentation()
            self.assertTrue(text and text.GetDescription().strip(), name)

    def test_every_property_of_the_class_is_there(self):
        self.assertLessEqual({*self.choices, "NumberOfThreads"}, self.of_class)
        self.assertEqual(self.of_class - set(self.own_properties()), set())

    def test_defaults_are_those_of_the_class(self):
        defaults = describe_class(self.vtk_class)
        for name in self.of_class:
            value = self.property(name).GetElement(0)
            self.assertEqual(type(value)(defaults[name]), value, name)

    def test_numbers_and_choices_have_domains(self):
        texts = {"Devices", "ElevationArray", "SizeArray"}
        for name in set(self.own_properties()) - texts:
            takes_values = self.property(name).IsA("vtkSMVectorProperty")
            if takes_values and not self.property(name).GetInformationOnly():
                domains = self.property(name).NewDomainIterator()
                domains.Begin()
                self.assertFalse(domains.IsAtEnd(), name)

    def test_choices(self):
        for name, choices in self.choices.items():
            domain = self.property(name).FindDomain("vtkSMEnumerationDomain")
            entries = [(domain.GetEntryText(i), domain.GetEntryValue(i))
                       for i in range(domain.GetNumberOfEntries())]
            self.assertEqual(entries, list(zip(choices, range(len(choices)))))

    def test_ports(self):
        self.assertEqual([self.proxy.SMProxy.GetOutputPortName(i) for i in range(2)], self.ports)


class PointsProxy(Proxy):
    name, label = "DelaunayFromPoints", "Delaunay From Points"
    vtk_class = "vtkDelaunayFlipPoints"
    choices = {"RingRule": ["Even-odd", "Nonzero", "Orientation"],
               "Projection": ["XY", "Best-fitting plane", "Sphere", "Open sphere"]}


class InterpolatorProxy(Proxy):
    name, label = "InterpolateFromPointsDelaunay", "Interpolate From Points (Delaunay)"
    vtk_class = "vtkDelaunayFlipInterpolator"
    bases = "vtkDelaunayFlipPoints", "vtkDelaunayFlipAlgorithm"
    ports, is_live = ["Values", "Iterations"], False
    choices = {"Method": ["Linear", "Natural"], "Outside": ["NaN", "Nearest", "Error"]}


class PluginPath(unittest.TestCase):
    """The filter is available if only PV_PLUGIN_PATH names the plugin's folder."""

    def test_filter_is_there(self):
        flip = simple.DelaunayFlip(Input=simple.Sphere())
        refresh(flip)
        self.assertEqual(flip.GetPropertyValue("StopReason"), "converged")
        self.assertRegex(flip.GetPropertyValue("Summary"), r"\nflips: \d+ in \d+ iterations?, converged\n")


class Refuses(PluginTest):
    """The plugin in Python refuses to be the second one with the same filter."""

    def test_says_why(self):
        told = io.StringIO()
        with contextlib.redirect_stderr(told), Messages(), self.assertRaises(RuntimeError):
            simple.LoadPlugin(os.environ["DELAUNAYFLIP_PYTHON_PLUGIN"], remote=False, ns={})
        self.assertIn("The plugin DelaunayFlip in C++ is loaded already", told.getvalue())
        manager = servermanager.ProxyManager()
        prototype = manager.GetPrototypeProxy("filters", "DelaunayFlip")
        self.assertEqual(prototype.GetVTKClassName(), "vtkPDelaunayFlip")


if __name__ == "__main__":
    main()

# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The contents of the menu and of the Properties panel."""

import os
import re

from paraview import servermanager, simple
from paraview.modules.vtkRemotingClientServerStream import vtkClientServerInterpreterInitializer

from PluginTesting import PluginTest, main

HEADER = os.path.join(
    os.path.dirname(os.path.abspath(__file__)), "..", "..", "Filters", "vtkDelaunayFlip.h")


def get_hints(proxy):
    hints = proxy.SMProxy.GetHints()
    return [hints.GetNestedElement(i) for i in range(hints.GetNumberOfNestedElements())]


def list_properties():
    """The properties with both a setter and a getter in the class's header."""
    with open(HEADER, encoding="utf-8") as file:
        header = file.read().split("\nprotected:")[0]

    def list_accessors(verb):
        pattern = rf"\bvtk{verb}\w*Macro\((\w+)|\b{verb}(\w+)\("
        return {macro or method for macro, method in re.findall(pattern, header)}

    return list_accessors("Set") & list_accessors("Get")


def describe_class():
    """{property: value as text} of a new vtkDelaunayFlip, without a proxy."""
    interpreter = vtkClientServerInterpreterInitializer.GetGlobalInterpreter()
    text = str(interpreter.NewInstance("vtkDelaunayFlip"))
    own = text[text.index("  Geometry: "):]
    return dict(re.findall(r"^  (\w+): (.*)$", own, re.MULTILINE))


class Proxy(PluginTest):
    def setUp(self):
        super().setUp()
        self.proxy = simple.DelaunayFlip(Input=simple.Sphere())

    def property(self, name):
        return self.proxy.SMProxy.GetProperty(name)

    def own_properties(self):
        names = self.proxy.ListProperties()
        return [name for name in names if name not in ("Input", "Constraints")]

    def test_menu_entry(self):
        manager = servermanager.ProxyManager()
        prototype = manager.GetPrototypeProxy("filters", "DelaunayFlip")
        self.assertEqual(prototype.GetXMLLabel(), "Delaunay Flip")
        menu = [hint for hint in get_hints(self.proxy) if hint.GetName() == "ShowInMenu"]
        self.assertEqual(menu[0].GetAttribute("category"), "Delaunay Flip")
        self.assertTrue(menu[0].GetAttribute("icon").startswith(":/DelaunayFlip/"))

    def test_apply_opens_no_view_for_the_table(self):
        views = [hint for hint in get_hints(self.proxy) if hint.GetName() == "View"]
        self.assertEqual([(view.GetAttribute("type"), view.GetAttribute("port"))
                          for view in views], [("None", "1")])

    def test_everything_is_documented(self):
        self.assertIn("Delaunay", self.proxy.SMProxy.GetDocumentation().GetLongHelp())
        for name in self.proxy.ListProperties():
            text = self.property(name).GetDocumentation()
            self.assertTrue(text and text.GetDescription().strip(), name)

    def test_every_property_of_the_class_is_there(self):
        self.assertLessEqual({"Geometry", "RegionArray", "LiveUpdate"}, list_properties())
        self.assertEqual(list_properties() - set(self.own_properties()), set())

    def test_defaults_are_those_of_the_class(self):
        defaults = describe_class()
        for name in list_properties():
            value = self.property(name).GetElement(0)
            self.assertEqual(type(value)(defaults[name]), value, name)

    def test_numbers_and_choices_have_domains(self):
        texts = {"Devices"}
        for name in set(self.own_properties()) - texts:
            takes_values = self.property(name).IsA("vtkSMVectorProperty")
            if takes_values and not self.property(name).GetInformationOnly():
                domains = self.property(name).NewDomainIterator()
                domains.Begin()
                self.assertFalse(domains.IsAtEnd(), name)

    def test_choices(self):
        for name, choices in {
            "Geometry": ["Auto", "Planar", "Planar XY", "Surface"],
            "Criterion": ["In-circle", "Opposite angles"],
            "TieRule": ["Keep", "Canonical"],
            "Backend": ["Auto", "CUDA", "Threads"],
        }.items():
            domain = self.property(name).FindDomain("vtkSMEnumerationDomain")
            entries = [(domain.GetEntryText(i), domain.GetEntryValue(i))
                       for i in range(domain.GetNumberOfEntries())]
            self.assertEqual(entries, list(zip(choices, range(len(choices)))))

    def test_basics_first(self):
        basic = [name for name in self.own_properties()
                 if self.property(name).GetPanelVisibility() == "default"]
        self.assertEqual(set(basic), {
            "Geometry", "FeatureAngle", "RegionArray", "MaximumIterations", "LiveUpdate",
            "IterationsPerUpdate", "Paused", "Step", "Restart", "NumberOfIterations",
            "TotalFlips", "NumberOfNonDelaunayEdges", "NumberOfEdgesBlockedByShape",
            "NumberOfEdgesBlockedByEdge", "NumberOfConstraintEdges",
            "NumberOfUnmatchedConstraintEdges", "NumberOfInsertedConstraintEdges",
            "NumberOfConstraintFlips", "StopReason", "GeometryUsed", "GeometryReason",
            "BackendUsed"})

    def test_iterations_can_be_animated(self):
        self.assertEqual(self.property("MaximumIterations").GetAnimateable(), 1)

    def test_ports(self):
        self.assertEqual([self.proxy.SMProxy.GetOutputPortName(i) for i in range(2)],
                         ["Mesh", "Iterations"])


if __name__ == "__main__":
    main()

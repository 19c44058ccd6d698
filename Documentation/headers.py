# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The comments of the public headers, for the API reference of the site."""
import glob
import os
import re
import subprocess
import xml.etree.ElementTree as ET

HERE = os.path.dirname(os.path.abspath(__file__))


def read_headers(folder):
    """Writes Doxygen's XML for the headers that Doxyfile lists; returns the XML's folder."""
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(HERE, "Doxyfile"), encoding="utf-8") as file:
        settings = file.read() + f'\nOUTPUT_DIRECTORY = "{folder}"\n'
    subprocess.run(["doxygen", "-"], input=settings, text=True, check=True,
                   cwd=os.path.join(HERE, ".."))
    xml = os.path.join(folder, "xml")
    for path in glob.glob(os.path.join(xml, "class*.xml")):
        name_groups(path)
    fill_headers(xml)
    return xml


def fill_headers(folder):
    """Doxygen describes functions and enumerations with their namespace; this moves them to their
    headers."""
    space = ET.parse(os.path.join(folder, "namespacedelaunayflip.xml"))
    for path in glob.glob(os.path.join(folder, "*_8h.xml")):
        tree = ET.parse(path)
        header = tree.find("compounddef")
        for inner in header.findall("innernamespace"):
            header.remove(inner)
        for section in space.iter("sectiondef"):
            part = ET.SubElement(header, "sectiondef", kind=section.get("kind"))
            part.extend(member for member in section.iter("memberdef") if member.find("location").get(
                "file") == header.find("location").get("file"))
        tree.write(path)


def name_groups(path):
    """Gives each group of methods (between ///@{ and ///@}) the name of its property."""
    tree = ET.parse(path)
    for group in tree.iter("sectiondef"):
        if group.get("kind") == "user-defined" and group.find("header") is None:
            header = ET.Element("header")
            header.text = name_of(group)
            group.insert(0, header)
    tree.write(path)


def name_of(group):
    first = group.find("memberdef").findtext("name")
    return re.sub("^(Set|Get)|Type$", "", first)

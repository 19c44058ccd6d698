#!/usr/bin/env python3
# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: make_header_examples.py OUTPUT HEADER...

Writes a program with a test for the example of each header, from the indented lines of its first
comment. A comment after an expression is its value: `report.TotalFlips; // 1`. OUTPUT is for
GoogleTest, or for check.h if it ends with .c.
"""
import pathlib
import re
import sys

EXAMPLE = re.compile(r"^(?:///| \*)(?:     (.*))?$")
VALUE = re.compile(r'^(\s*)(\S.*); // (-?[\d.]+|true|false|".*")$')
VTK_CLASS = re.compile(r"\bvtk[A-Z]\w+")
# They have macros alone.
WITHOUT_EXAMPLE = {"EngineExport.h", "HostDevice.h"}


def read_example(path):
    lines = path.read_text(encoding="utf-8").splitlines()
    begin = next(i for i, line in enumerate(lines) if "@file" in line or "@class" in line)
    found = []
    for line in lines[begin + 1:]:
        if not line.startswith(("///", " *")) or line == " */":
            break
        match = EXAMPLE.match(line)
        if match and match[1]:
            found.append(match[1])
    if not any(VALUE.match(line) or "auto" in line for line in found):
        sys.exit(f"{path}: the first comment has no example with a value; see {__file__}")
    return found


def main():
    output, headers = sys.argv[1], [pathlib.Path(name) for name in sys.argv[2:]]
    examples = {header: read_example(header) for header in headers if header.name not in WITHOUT_EXAMPLE}
    is_c = output.endswith(".c")
    included = ["check.h"] if is_c else ["gtest/gtest.h", *(header.name for header in examples)]
    # A class of VTK has a header of its name.
    included += sorted(f"{name}.h" for name in set(VTK_CLASS.findall(str(list(examples.values())))))
    text = [f'#include "{name}"' for name in included]
    text += [] if is_c else ["#include <cmath>", "#include <vector>",
                             "namespace delaunayflip {} using namespace delaunayflip;"]
    for header, example in examples.items():
        text.append("int main(void)" if is_c else f"TEST(HeaderExamples, {header.stem})")
        check = "CHECK" if is_c else "EXPECT_TRUE"
        text += ["{", *(VALUE.sub(rf"\1{check}((\2) == \3);", line) for line in example), "}"]
    pathlib.Path(output).write_text("\n".join(text) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()

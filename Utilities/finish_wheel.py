# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""Usage: finish_wheel.py WHEEL FOLDER PLATFORM [COMPONENT...]

Writes a copy of a wheel to FOLDER, with the tag PLATFORM, the licences of what is compiled in, and
a list of these as an SBOM (CycloneDX, in *.dist-info/sboms). A component is
NAME=VERSION=LICENCE=FILE=HOW: an SPDX expression, the file of the licence's text, and how it is
part of the wheel, e.g.
"oneTBB=2021.8.0=Apache-2.0=/tmp/LICENSE.txt=static library".
"""
import argparse
import base64
import hashlib
import json
import pathlib
import re
import zipfile

_TIME = (1980, 1, 1, 0, 0, 0)  # the same files give the same wheel


def _read(wheel):
    with zipfile.ZipFile(wheel) as archive:
        return {info.filename: (archive.read(info), info.external_attr)
                for info in archive.infolist() if not info.is_dir()}


def _describe(name, version, licence, how, url=None):
    component = {"type": "library", "name": name, "version": version, "description": how,
                 "licenses": [{"expression": licence}]}
    if url:
        component["purl"] = url
    return component


def make_sbom(version, platform, components, files):
    """CycloneDX 1.6, without a time or a random number. `files`: bytes by name."""
    hashes = [{"type": "file", "name": name,
               "hashes": [{"alg": "SHA-256", "content": hashlib.sha256(data).hexdigest()}]}
              for name, data in sorted(files.items())]
    main = _describe("delaunayflip", version, "BSD-3-Clause", f"the wheel for {platform}",
                     f"pkg:pypi/delaunayflip@{version}")
    return {"bomFormat": "CycloneDX", "specVersion": "1.6", "version": 1,
            "metadata": {"component": main},
            "components": [_describe(name, number, licence, how)
                           for name, number, licence, _, how in components] + hashes}


def _join_licences(licences):
    return " AND ".join(dict.fromkeys(" AND ".join(licences).split(" AND ")))


def finish(files, platform, components):
    """Changes the files of a wheel, (bytes, attributes) by name."""
    (folder,) = {name.split("/")[0] for name in files if ".dist-info/" in name}
    version = re.match(r"delaunayflip-(.+)\.dist-info", folder).group(1)

    def edit(name, pattern, replacement):
        data, attributes = files[f"{folder}/{name}"]
        text, count = re.subn(pattern, replacement, data.decode(), flags=re.MULTILINE)
        if count == 0:
            raise SystemExit(f"{name} of the wheel has no line {pattern}")
        files[f"{folder}/{name}"] = text.encode(), attributes

    edit("WHEEL", r"^Tag: py3-none-.*", f"Tag: py3-none-{platform}")
    expression = _join_licences(["BSD-3-Clause", *(part[2] for part in components)])
    edit("METADATA", r"^License-Expression: .*", f"License-Expression: {expression}")
    names = [f"{part[0].replace(' ', '-')}.txt" for part in components]
    edit("METADATA", r"^License-File: LICENSE$",
         "\n".join(f"License-File: {name}" for name in ("LICENSE", *names)))
    attributes = files[f"{folder}/METADATA"][1]
    for name, part in zip(names, components):
        files[f"{folder}/licenses/{name}"] = pathlib.Path(part[3]).read_bytes(), attributes
    libraries = {name: data for name, (data, _) in files.items()
                 if re.search(r"\.(dll|dylib|so[.0-9]*)$", name)}
    sbom = make_sbom(version, platform, components, libraries)
    files[f"{folder}/sboms/delaunayflip.cdx.json"] = json.dumps(sbom, indent=1).encode(), attributes


def write(path, files):
    (folder,) = {name.split("/")[0] for name in files if ".dist-info/" in name}
    record = f"{folder}/RECORD"
    attributes = files.pop(record)[1]
    lines = []
    for name, (data, _) in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        lines.append(f"{name},sha256={digest},{len(data)}\n")
    files[record] = "".join([*lines, f"{record},,\n"]).encode(), attributes
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, (data, attributes) in files.items():
            info = zipfile.ZipInfo(name, _TIME)
            info.external_attr = attributes
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, data)


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("wheel", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("platform")
    parser.add_argument("components", nargs="*")
    options = parser.parse_args()
    files = _read(options.wheel)
    components = [component.split("=") for component in options.components]
    finish(files, options.platform, components)
    start = options.wheel.stem.split("-py3-none-")[0]
    path = options.folder / f"{start}-py3-none-{options.platform}.whl"
    write(path, files)
    print(path)


if __name__ == "__main__":
    main()

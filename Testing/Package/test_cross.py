# SPDX-FileCopyrightText: Copyright (c) The DelaunayFlip developers
# SPDX-License-Identifier: BSD-3-Clause
"""The wheels of Utilities/build-wheels.sh, which makes those that are not in build-wheels/ yet. Their
libraries run on this machine where something runs them: Wine those of Windows, and QEMU's user mode
those of Arm, with Debian's libraries for Arm. The engine's GoogleTests are compiled for these two
and run, too. Nothing here runs what is for macOS.

FinishWheel tests what the script adds to wheels, and builds nothing.
"""
import base64
import concurrent.futures
import csv
import hashlib
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

from pages import ROOT, read

WORK = pathlib.Path(ROOT, "build-wheels")
FINISH = f"{ROOT}/Utilities/finish_wheel.py"
FUNCTIONS = set(re.findall(r"\b(delaunayflip_[a-z_]+)\(", read("CInterface/delaunayflip_c.h")))
# Of Debian: Python, and what the wheels of NumPy and of this project load.
ARM_PACKAGES = ("python3-minimal", "libpython3-stdlib", "libstdc++6", "libgfortran5", "zlib1g")
PARTS = 32  # how many parts the tests of a program are run in
DEMO = """
import platform, delaunayflip
result = delaunayflip.flip([[0, 0], [2, -1], [4, 0], [2, 1]], [[0, 1, 2], [0, 2, 3]])
print(platform.machine(), result.report.total_flips, result.report.backend)
"""


def run(*command, **options):
    """Its output. A failure is one of the test."""
    done = subprocess.run([str(part) for part in command], stdout=subprocess.PIPE, text=True,
                          stderr=subprocess.STDOUT, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command[0]} failed:\n{done.stdout[-5000:]}")
    return done.stdout


def need(*programs):
    for program in programs:
        if shutil.which(program) is None:
            raise unittest.SkipTest(f"no {program} here")
    return programs[0]


def get_arm_root(folder):
    """A folder with Debian's Python for Arm. @param folder: for temporary files."""
    need("apt-get", "dpkg-deb", "qemu-aarch64")
    root = WORK / "arm-root"
    if root.exists():
        return root
    apt = folder / "apt"
    for name in ("lists/partial", "archives/partial"):
        (apt / name).mkdir(parents=True)
    (apt / "status").touch()
    options = ["-q", "-o", "APT::Architecture=arm64", "-o", "APT::Architectures=arm64",
               "-o", f"Dir::State={apt}", "-o", f"Dir::State::status={apt}/status",
               "-o", f"Dir::Cache={apt}", "-o", "APT::Sandbox::User="]
    try:
        run("apt-get", *options, "update")
        run("apt-get", *options, "install", "--download-only", "--yes",
            "--no-install-recommends", *ARM_PACKAGES)
    except AssertionError as error:
        raise unittest.SkipTest(f"cannot get Debian's packages for Arm: {error}") from error
    partial = folder / "arm-root"
    for package in (apt / "archives").glob("*.deb"):
        run("dpkg-deb", "--extract", package, partial)
    shutil.move(partial, root)
    return root


def start_wine(case):
    """What runs programs for Windows, and its environment. @param case: the class of the tests. Its folder
    gets one for Wine."""
    need("wine", "wineboot", "wineserver")
    folder = case.folder / "wine"
    wine = {"WINEPREFIX": str(folder), "WINEDEBUG": "-all"}
    if not folder.exists():
        # Its server outlives the programs, and would write to the folder while that is removed.
        case.addClassCleanup(subprocess.run, ["wineserver", "--kill"], check=False,
                             env={**os.environ, **wine})
        run("wineboot", "--init", env={**os.environ, **wine})
    return ["wine"], wine


class FinishWheel(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.wheel = self.folder / "delaunayflip-1.2-py3-none-linux_x86_64.whl"
        info = "delaunayflip-1.2.dist-info"
        with zipfile.ZipFile(self.wheel, "w") as archive:
            for name, text in (
                    ("delaunayflip/__init__.py", ""), ("delaunayflip/delaunayflip-1.dll", "code"),
                    (f"{info}/WHEEL", "Wheel-Version: 1.0\nTag: py3-none-linux_x86_64\n"),
                    (f"{info}/METADATA", "License-Expression: BSD-3-Clause\nLicense-File: LICENSE\n"),
                    (f"{info}/licenses/LICENSE", "ours"), (f"{info}/RECORD", "old")):
                archive.writestr(name, text)
        (self.folder / "theirs").write_text("their licence", encoding="utf-8")

    def finish(self):
        component = f"Their library=3=BSD-3-Clause AND MIT={self.folder / 'theirs'}=static library"
        made = run(sys.executable, FINISH, self.wheel, self.folder, "win_amd64", component)
        with zipfile.ZipFile(made.strip()) as archive:
            files = {name.replace("delaunayflip-1.2.dist-info/", ""): archive.read(name)
                     for name in archive.namelist()}
        return pathlib.Path(made.strip()), files

    def test_contents(self):
        path, files = self.finish()
        self.assertEqual("delaunayflip-1.2-py3-none-win_amd64.whl", path.name)
        self.assertIn(b"Tag: py3-none-win_amd64\n", files["WHEEL"])
        self.assertEqual("License-Expression: BSD-3-Clause AND MIT\nLicense-File: LICENSE\n"
                         "License-File: Their-library.txt\n", files["METADATA"].decode())
        self.assertEqual(b"their licence", files["licenses/Their-library.txt"])
        sbom = json.loads(files["sboms/delaunayflip.cdx.json"])
        self.assertEqual("CycloneDX", sbom["bomFormat"])
        theirs, library = sbom["components"]
        self.assertEqual(("Their library", "3", [{"expression": "BSD-3-Clause AND MIT"}]),
                         (theirs["name"], theirs["version"], theirs["licenses"]))
        self.assertEqual(hashlib.sha256(b"code").hexdigest(), library["hashes"][0]["content"])

    def test_record(self):
        """It is complete, so that pip takes the wheel; and the same input gives the same bytes."""
        path, files = self.finish()
        before = path.read_bytes()
        rows = {row[0].replace("delaunayflip-1.2.dist-info/", ""): row[1:]
                for row in csv.reader(io.StringIO(files["RECORD"].decode()))}
        self.assertEqual(set(files), set(rows))
        for name, (digest, size) in rows.items():
            if name != "RECORD":
                expected = base64.urlsafe_b64encode(hashlib.sha256(files[name]).digest())
                self.assertEqual((f"sha256={expected.decode().rstrip('=')}", len(files[name])),
                                 (digest, int(size)))
        self.finish()
        self.assertEqual(before, path.read_bytes())


class Cross(unittest.TestCase):
    """One platform's wheel, unpacked."""

    platform = target = tag = library = ""

    @classmethod
    def setUpClass(cls):
        if not cls.platform:
            raise unittest.SkipTest("the base class")
        wheels = list(WORK.glob(f"delaunayflip-*-{cls.tag}.whl"))
        if not wheels:
            if not os.path.exists("/usr/include/boost/version.hpp"):
                raise unittest.SkipTest("build-wheels.sh needs libboost-dev")
            need("apt-get")
            run(f"{ROOT}/Utilities/build-wheels.sh", cls.platform)
            wheels = list(WORK.glob(f"delaunayflip-*-{cls.tag}.whl"))
        (cls.wheel,) = wheels
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        with zipfile.ZipFile(cls.wheel) as archive:
            archive.extractall(cls.folder)
        cls.path = cls.folder / "delaunayflip" / cls.library

    def check_files(self):
        """The package with its one library and its plugin, licences and the list of what is inside."""
        names = {str(path.relative_to(self.folder)) for path in self.folder.rglob("*") if path.is_file()}
        package = {name for name in names if name.startswith("delaunayflip/")}
        sources = {f"delaunayflip/{path.name}" for path in pathlib.Path(ROOT, "Python").glob("*/*.py")}
        sources |= {f"delaunayflip/{name}" for name in (
            "py.typed", "plugin/DelaunayFlip.py", "AngleColors.json", "DelaunayFlip.xml", self.library)}
        self.assertEqual(sources, package)
        (sbom,) = self.folder.glob("*.dist-info/sboms/*.json")
        components = json.loads(sbom.read_text(encoding="utf-8"))["components"]
        inside = {part["name"].replace(" ", "-") for part in components if part["type"] == "library"}
        self.assertLessEqual({"oneTBB", "Boost", "libc++"}, inside)
        licences = {path.stem for path in self.folder.glob("*.dist-info/licenses/*.txt")}
        self.assertEqual(inside, licences)
        self.assertTrue(all(path.stat().st_size > 500
                            for path in self.folder.glob("*.dist-info/licenses/*")))

    def check_exports(self, names):
        self.assertEqual(FUNCTIONS, set(names) & FUNCTIONS)
        self.assertEqual(set(), set(names) - FUNCTIONS)

    @classmethod
    def find_zig(cls):
        """The compiler, and its environment, which is that of build-wheels.sh."""
        zig = next(WORK.glob("tools/lib/python3*/site-packages/ziglang/zig"))
        # A cache of compilers would not see DELAUNAYFLIP_ZIG_TARGET.
        own = {name: value for name, value in os.environ.items()
               if not re.fullmatch(r"CMAKE_C(XX)?_COMPILER_LAUNCHER|CC|CXX|C(XX)?FLAGS|LDFLAGS", name)}
        return zig, {**own, "DELAUNAYFLIP_ZIG": zig, "DELAUNAYFLIP_ZIG_TARGET": cls.target,
                     "ZIG_GLOBAL_CACHE_DIR": WORK / "cache", "ZIG_LOCAL_CACHE_DIR": WORK / "cache",
                     "PATH": f"{WORK}/tools/bin:{os.environ['PATH']}"}

    def check_programs(self, launcher, environment=None, suffix=""):
        """The tests of the C interface, built for the platform and linked with the wheel's library."""
        zig, cross = self.find_zig()
        folder = self.folder / "programs"
        folder.mkdir()
        shutil.copy(self.path, folder)
        link = self.path
        if suffix:  # Windows links with a list of the library's functions
            link = next((WORK / self.platform / "build").rglob("libdelaunayflip.dll.a"))
        for name, expected in (("hash", r"^222 hashes, 0 different$"), ("interface", "")):
            program = folder / f"{name}_test{suffix}"
            run(zig, "cc", "-target", self.target, "-std=c99", f"-I{ROOT}/CInterface",
                f"-I{ROOT}/Testing/C", f"{ROOT}/Testing/C/{name}_test.c", link, "-o", program,
                *([] if suffix else ["-lm", "-Wl,-rpath,$ORIGIN"]), env=cross)
            output = run(*launcher, program, f"{ROOT}/Testing/C/hashes.txt",
                         env={**os.environ, **(environment or {})})
            self.assertRegex(output.replace("\r", ""), re.compile(expected, re.MULTILINE))


class WindowsX86(Cross):
    platform, tag, library = "windows-x86_64", "win_amd64", "delaunayflip-1.dll"
    target = "x86_64-windows-gnu"

    def test_wheel(self):
        self.check_files()

    def test_imports_and_exports(self):
        """It needs nothing but Windows 10."""
        text = run(need("llvm-readobj"), "--coff-exports", "--coff-imports", self.path)
        exports = re.findall(r"Export \{.*?Name: (\S+)", text, re.DOTALL)
        self.check_exports(exports)
        for name in re.findall(r"Import \{\s+Name: (\S+)", text):
            self.assertRegex(name, r"^(KERNEL32|ntdll|ADVAPI32|api-ms-win-crt-[a-z]+-l1-1-0)\.dll$")

    def test_same_meshes_under_wine(self):
        launcher, environment = start_wine(type(self))
        self.check_programs(launcher, environment, suffix=".exe")


class LinuxArm(Cross):
    platform, tag, library = "linux-aarch64", "manylinux_2_28_aarch64", "libdelaunayflip.so.1"
    target = "aarch64-linux-gnu.2.28"

    def test_wheel(self):
        self.check_files()

    def test_exports(self):
        names = run(need("llvm-nm", "llvm-readobj"), "--dynamic", "--extern-only", "--defined-only",
                    "--format=just-symbols", self.path)
        self.check_exports(names.split())
        libraries = re.search(r"NeededLibraries \[(.*?)\]", run("llvm-readobj", "--needed-libs", self.path),
                              re.DOTALL).group(1).split()
        for name in libraries:
            self.assertRegex(name, r"^(lib(c|m|dl|pthread|rt)\.so|ld-linux-aarch64\.so)\.[0-9]$")

    def test_same_meshes_under_qemu(self):
        self.check_programs(["qemu-aarch64", "-L", get_arm_root(self.folder)])

    def test_python_under_qemu(self):
        root = get_arm_root(self.folder)
        python = next((root / "usr" / "bin").glob("python3.[0-9]*"))
        version = python.name.replace("python", "")
        numpy = self.folder / "numpy"
        fetched = subprocess.run(
            [WORK / "tools" / "bin" / "pip", "install", "--quiet", "--target", numpy,
             "--platform", "manylinux_2_17_aarch64", "--platform", "manylinux_2_28_aarch64",
             "--python-version", version, "--only-binary=:all:", "numpy"], check=False)
        if fetched.returncode != 0:
            self.skipTest("cannot get NumPy for Arm")
        # QEMU does not emulate programs that the tests start, so sys.executable is a script that runs QEMU.
        launcher = self.folder / "python"
        launcher.write_text(f'#!/bin/sh\nexec qemu-aarch64 -L "{root}" "{python}" "$@"\n', encoding="utf-8")
        launcher.chmod(0o755)
        (numpy / "sitecustomize.py").write_text(f"import sys\nsys.executable = '{launcher}'\n",
                                                encoding="utf-8")
        environment = {**os.environ, "PYTHONPATH": f"{self.folder}:{numpy}", "OPENBLAS_NUM_THREADS": "1"}
        text = run(launcher, "-c", DEMO, env=environment)
        self.assertRegex(text, r"aarch64 1 Threads: \d+ \(built without CUDA for this platform\)")
        run(launcher, "-m", "unittest", "test_arrays", "test_interpolation", "test_moving",
            "test_sphere", env=environment, cwd=f"{ROOT}/Testing/Python")


class Macos(Cross):
    """Not run: its symbols and load commands are read."""

    machine, signed = "", False

    def test_wheel(self):
        self.check_files()

    def test_symbols_and_load_commands(self):
        reader = need("llvm-readobj", "llvm-nm", "llvm-objdump")
        text = run(reader, "--file-headers", "--needed-libs", self.path)
        self.assertIn(f"Arch: {self.machine}", text)
        libraries = re.search(r"NeededLibraries \[(.*?)\]", text, re.DOTALL).group(1).split()
        for name in set(libraries) - {f"@rpath/{self.library}"}:
            self.assertRegex(name, r"^/usr/lib/lib(System\.B|c\+\+\.1|c\+\+abi)\.dylib$")
        names = run("llvm-nm", "--extern-only", "--defined-only", "--format=just-symbols", self.path)
        self.check_exports(name[1:] for name in names.split())
        commands = run("llvm-objdump", "--macho", "--private-headers", self.path)
        self.assertRegex(commands, r"minos 13\.0|version 13\.0")
        if self.signed:  # the system refuses code for Arm without
            self.assertIn("LC_CODE_SIGNATURE", commands)


class MacosArm(Macos):
    platform, tag, library = "macos-arm64", "macosx_13_0_arm64", "libdelaunayflip.1.dylib"
    machine, signed = "aarch64", True


class MacosX86(Macos):
    platform, tag, library = "macos-x86_64", "macosx_13_0_x86_64", "libdelaunayflip.1.dylib"
    machine = "x86_64"


class Engine(Cross):
    """The GoogleTests of the engine, with the oneTBB of the wheel. Their output is in
    build-wheels/PLATFORM/logs, while they run; GTEST_FILTER in the environment chooses some."""

    suffix = ""

    @staticmethod
    def copy_cgal():
        """CGAL's headers without the others of /usr/include, which are this machine's."""
        headers = WORK / "cgal"
        if not headers.exists():
            partial = WORK / "cgal.partial"
            shutil.rmtree(partial, ignore_errors=True)
            shutil.copytree("/usr/include/CGAL", partial / "CGAL")
            # Newer Clangs see that CGAL 5.5 names a member there which does not exist.
            iterator = partial / "CGAL" / "boost" / "graph" / "iterator.h"
            text = iterator.read_text(encoding="utf-8")
            iterator.write_text(text.replace("(! (this->base() == nullptr))", "(g != nullptr)"),
                                encoding="utf-8")
            partial.rename(headers)
        return headers

    def build(self, name):
        """A program of the engine's GoogleTests for the platform."""
        for path in ("/usr/include/CGAL", "/usr/src/googletest"):
            if not os.path.exists(path):
                self.skipTest(f"no {path} here (Debian: libcgal-dev googletest)")
        environment = self.find_zig()[1]
        folder = WORK / self.platform
        common = ("-G", "Ninja", f"-DCMAKE_TOOLCHAIN_FILE={ROOT}/CMake/ZigToolchain.cmake",
                  "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DNDEBUG", "-Wno-dev")
        googletest = folder / "gtest"
        if not googletest.exists():
            run("cmake", "-S", "/usr/src/googletest", "-B", folder / "gtest-build", *common,
                "-DBUILD_GMOCK=OFF", "-DCMAKE_INSTALL_LIBDIR=lib",
                f"-DCMAKE_INSTALL_PREFIX={googletest}", env=environment)
            run("cmake", "--build", folder / "gtest-build", "--target", "install", env=environment)
        run("cmake", "-S", ROOT, "-B", folder / "tests", *common, "-DDELAUNAYFLIP_BUILD_VTK=OFF",
            "-DDELAUNAYFLIP_ENABLE_CUDA=OFF", "-DDELAUNAYFLIP_BUILD_TESTING=ON",
            f"-DTBB_DIR={folder}/tbb/lib/cmake/TBB", f"-DGTest_DIR={googletest}/lib/cmake/GTest",
            "-DBoost_NO_BOOST_CMAKE=ON", f"-DBoost_INCLUDE_DIR={WORK}/boost",
            f"-DCGAL_DIR={ROOT}/Testing/Package/cross",
            f"-DDELAUNAYFLIP_CGAL_HEADERS={self.copy_cgal()}", f"-DPython3_EXECUTABLE={sys.executable}",
            "-DCMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE=PRE_TEST", env=environment)
        run("cmake", "--build", folder / "tests", "--target", f"DelaunayFlip{name}Tests",
            env=environment)
        return folder / "tests" / "bin" / f"DelaunayFlip{name}Tests{self.suffix}"

    def launch(self):
        """What runs the programs, and its environment."""
        raise NotImplementedError

    def run_part(self, command, part, environment):
        """Runs a part of a program's tests. @return how many passed, and what failed."""
        log = WORK / self.platform / "logs" / f"{command[-1].stem}-{part + 1}.txt"
        log.parent.mkdir(exist_ok=True)
        start = time.monotonic()
        with log.open("wb") as output:
            done = subprocess.run(
                [str(word) for word in command], check=False, stdin=subprocess.DEVNULL, stdout=output,
                stderr=subprocess.STDOUT,
                env={**os.environ, **environment, "GTEST_TOTAL_SHARDS": str(PARTS),
                     "GTEST_SHARD_INDEX": str(part), "GTEST_COLOR": "no"})
        text = log.read_text(encoding="utf-8", errors="replace")
        passed = re.search(r"\[  PASSED  \] (\d+) test", text)
        print(f"{log.stem} of {PARTS}: {passed.group(1) if passed else 'not all'} passed in "
              f"{time.monotonic() - start:.0f} s", file=sys.stderr, flush=True)
        if done.returncode == 0 and passed:
            return int(passed.group(1)), None
        return 0, f"{log}: {done.returncode}\n{text[-3000:]}"

    def check(self, name):
        """A program in parts, as many at a time as there are cores for this process."""
        launcher, environment = self.launch()
        command = [*launcher, self.build(name)]
        listed = run(*command, "--gtest_list_tests", env={**os.environ, **environment})
        count = len(re.findall(r"^  \S", listed, re.MULTILINE))
        with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
            results = list(pool.map(lambda part: self.run_part(command, part, environment),
                                    range(PARTS)))
        passed = sum(number for number, _ in results)
        print(f"{name} on {self.platform}: {passed} of {count} tests passed", file=sys.stderr)
        self.assertEqual([], [failure for _, failure in results if failure])
        self.assertGreaterEqual(passed, 0.9 * count)  # the others were skipped

    def test_sphere(self):
        self.check("Sphere")

    def test_ask(self):
        self.check("Ask")

    def test_grow(self):
        self.check("Grow")

    def test_fallback(self):
        self.check("Fallback")

    def test_core(self):
        self.check("Core")


class WindowsX86Engine(Engine):
    platform, tag, library = WindowsX86.platform, WindowsX86.tag, WindowsX86.library
    target, suffix = WindowsX86.target, ".exe"

    def launch(self):
        return start_wine(type(self))


class LinuxArmEngine(Engine):
    platform, tag, library = LinuxArm.platform, LinuxArm.tag, LinuxArm.library
    target = "aarch64-linux-gnu.2.36"  # as in get_arm_root; CGAL wants a newer one than the wheel

    def launch(self):
        return ["qemu-aarch64", "-L", get_arm_root(self.folder)], {}


if __name__ == "__main__":
    unittest.main()

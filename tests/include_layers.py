#!/usr/bin/env python3
"""Checks who includes whom: include_layers.py ROOT, or include_layers.py --self-test.

- A folder of src/shlight includes only itself and folders above it in FOLDERS; apps include all.
- A library's headers appear only where LIBRARIES allows them; a header in no table is a fault too.
- Installed headers include only installed headers and the standard library: who uses shlight need not have the
  libraries that it is made with.
"""

import pathlib
import re
import sys

# Data flows down this list.
FOLDERS = ["core", "sh", "image", "light", "brdf", "scene", "transfer", "truth", "render", "report"]

# What headers begin with, and the folders that may include them; "tests" are test and benchmark files of any folder.
# Everybody but sh may format text; tests read the values they expect from JSON.
LIBRARIES = {
    "fmt/": [folder for folder in FOLDERS if folder != "sh"] + ["apps"],
    "tbb/": ["core"],
    "OpenImageIO/": ["image"],
    "muParser": ["light"],
    "nlohmann/": ["light", "transfer", "apps", "tests"],
    "assimp/": ["scene"],
    "tiny_gltf": ["scene"],
    "meshoptimizer": ["scene"],
    "embree3/": ["transfer", "truth"],
    "Eigen/": ["transfer"],
    "epoxy/": ["render"],
    "EGL/": ["render"],
    "GLFW/": ["render", "apps"],
    "glm/": ["render"],
    "CLI/": ["apps"],
    "spdlog/": ["apps"],
    "imgui": ["apps"],
    "gtest/": ["tests"],
    "benchmark/": ["tests"],
}
SYSTEM = re.compile(r"(fcntl|poll|sched|signal|unistd|sys/\w+)\.h")  # the operating system's, for core and apps
STANDARD = re.compile(r"\w+")                                        # C++ headers have neither folder nor ending
TEST_FILE = re.compile(r"_(test|bench|test_util)\.(h|cpp)$")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)


def fault_of(path, bracket, header, installed):
    """What is wrong with the file at `path`, relative to the root, including `header`; None where nothing is."""
    parts = path.split("/")
    folder = "apps" if parts[0] == "apps" else parts[2]
    public = path in installed

    if header.startswith("shlight/"):
        target = header.split("/")[1]
        if target not in FOLDERS:
            return f"{target} is no folder of FOLDERS"
        if folder != "apps" and FOLDERS.index(target) > FOLDERS.index(folder):
            return f"{target} lies below {folder}"
        if folder == "sh" and target != "sh":
            return "sh includes only sh and the standard library"
        if public and f"src/{header}" not in installed:
            return "an installed header includes one that is not installed"
        return None
    if bracket == '"':  # a header beside the file or made by the build
        return "an installed header includes one that is not installed" if public else None
    if STANDARD.fullmatch(header):
        return None
    if public:
        return "an installed header includes only installed and standard headers"
    if SYSTEM.fullmatch(header):
        allowed = ["core", "apps"]
    else:
        allowed = next((folders for start, folders in LIBRARIES.items() if header.startswith(start)), [])
    if folder in allowed or ("tests" in allowed and TEST_FILE.search(path)):
        return None
    return f"only {', '.join(allowed)} may" if allowed else "no table of include_layers.py has it"


def faults_of(path, text, installed):
    for bracket, header in INCLUDE.findall(text):
        fault = fault_of(path, bracket, header, installed)
        if fault:
            yield f"{path} includes {header}: {fault}"


def installed_headers(root):
    """The headers that the folders' CMakeLists.txt install, as paths relative to the root."""
    result = set()
    for cmake in root.glob("src/shlight/*/CMakeLists.txt"):
        headers = re.search(r"\bHEADERS\s((?:\s*\w+\.h)+)", cmake.read_text(encoding="utf-8"))
        if headers:
            result.update(f"src/shlight/{cmake.parent.name}/{name}" for name in headers.group(1).split())
    return result


def check(root):
    installed = installed_headers(root)
    files = [file for top in ("src/shlight", "apps") for file in sorted((root / top).rglob("*"))
             if file.suffix in (".h", ".cpp")]
    faults = [fault for file in files
              for fault in faults_of(file.relative_to(root).as_posix(), file.read_text(encoding="utf-8"), installed)]
    print("\n".join(faults + [f"{len(files)} files, {len(installed)} installed headers, {len(faults)} faults"]))
    return 0 if files and installed and not faults else 1


def self_test():
    """Each rule finds the include that breaks it, and passes the one that does not."""
    installed = {"src/shlight/sh/vec.h", "src/shlight/image/image.h"}
    cases = [  # file, its include, whether that is a fault
        ("src/shlight/light/a.cpp", '"shlight/sh/vec.h"', False),
        ("src/shlight/light/a.cpp", '"shlight/light/b.h"', False),
        ("src/shlight/light/a.cpp", '"shlight/scene/scene.h"', True),
        ("src/shlight/light/a.cpp", '"shlight/sound/a.h"', True),
        ("src/shlight/sh/a.cpp", '"shlight/core/error.h"', True),
        ("src/shlight/sh/a.cpp", "<fmt/format.h>", True),
        ("src/shlight/sh/a.cpp", "<cmath>", False),
        ("src/shlight/sh/a_test.cpp", "<gtest/gtest.h>", False),
        ("src/shlight/sh/a.cpp", "<gtest/gtest.h>", True),
        ("src/shlight/render/a_gl_test.cpp", "<nlohmann/json.hpp>", False),
        ("src/shlight/render/a.cpp", "<nlohmann/json.hpp>", True),
        ("src/shlight/image/a.cpp", "<OpenImageIO/imageio.h>", False),
        ("src/shlight/light/a.cpp", "<OpenImageIO/imageio.h>", True),
        ("src/shlight/light/a.cpp", "<unistd.h>", True),
        ("src/shlight/light/a.cpp", "<strange/library.h>", True),
        ("src/shlight/image/image.h", '"shlight/sh/vec.h"', False),
        ("src/shlight/image/image.h", '"shlight/image/private.h"', True),
        ("src/shlight/image/image.h", "<OpenImageIO/imageio.h>", True),
        ("apps/shlight/main.cpp", '"shlight/render/render.h"', False),
        ("apps/shlight/main.cpp", "<CLI/CLI.hpp>", False),
        ("apps/shlight/main.cpp", "<epoxy/gl.h>", True),
    ]
    wrong = [f"{path} with {include}: fault expected: {expected}" for path, include, expected in cases
             if bool(list(faults_of(path, f"#pragma once\n\n#include {include}\n", installed))) != expected]
    print("\n".join(wrong + [f"{len(cases)} cases, {len(wrong)} wrong"]))
    return 1 if wrong else 0


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    sys.exit(self_test() if sys.argv[1] == "--self-test" else check(pathlib.Path(sys.argv[1])))

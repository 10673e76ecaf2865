#!/usr/bin/env python3
"""Checks that what the documents show is true: snippets.py ROOT [FOLDER_OF_THE_TOOL].

- A C++ or CMake snippet stands, line for line, in a file of tests/install, which a test compiles and runs.
- `shlight …` lines of shell snippets succeed, one after the other in a folder of their own for each document.
- Links and pictures within the project exist.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

SNIPPET = re.compile(r"^```(cpp|cmake|sh)\n(.*?)^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")


def run_faults(document, lines, tool):
    environment = dict(os.environ, PATH=f"{tool.resolve()}{os.pathsep}{os.environ['PATH']}")
    with tempfile.TemporaryDirectory() as folder:
        for line in lines:
            result = subprocess.run(line, shell=True, cwd=folder, env=environment, capture_output=True, text=True)
            if result.returncode != 0:
                yield f"{document.name}: {line}\n  exits with {result.returncode}: {result.stderr.strip()}"


def faults_of(document, examples, tool):
    text = document.read_text(encoding="utf-8")
    commands = []
    for language, snippet in SNIPPET.findall(text):
        if language == "sh":
            commands += [line for line in snippet.replace("\\\n", " ").splitlines() if line.startswith("shlight ")]
        elif not any(snippet in example for example in examples):
            yield f"{document.name}: no file of tests/install has this snippet:\n{snippet}"
    if tool:
        yield from run_faults(document, commands, tool)
    for link in LINK.findall(text):
        if not (document.parent / link).exists():
            yield f"{document.name}: link to {link}, which does not exist"


def main(root, tool=None):
    examples = [file.read_text(encoding="utf-8") for file in (root / "tests/install").iterdir()]
    documents = sorted(root.glob("*.md")) + sorted((root / "docs").rglob("*.md"))
    faults = [fault for document in documents for fault in faults_of(document, examples, tool)]
    print("\n".join(faults + [f"{len(documents)} documents, {len(faults)} faults"]))
    return 1 if faults or not documents else 0


if __name__ == "__main__":
    sys.exit(main(*map(pathlib.Path, sys.argv[1:])) if len(sys.argv) in (2, 3) else __doc__)

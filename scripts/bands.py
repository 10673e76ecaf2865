#!/usr/bin/env python3
"""Measures the tables and plots of docs/bands.md with the tool: bands.py TOOL ROOT.

Tables stand between the markers <!-- bands.py: NAME --> and <!-- end -->; what lies between is replaced.
"""

import json
import pathlib
import re
import subprocess
import sys

LIGHTS = {
    "the same from everywhere": "fn:1",
    "sky over ground, 1 : 0.2": "fn:y>0?1:0.2",
    "overcast (Moon and Spencer) over ground": "fn:y>0?(1+2*y)/3:0.1",
    "clear sky, sun at 30°": "builtin:sky",
    "clear sky, sun at 5°": "builtin:sky:elevation=5",
    "a lamp of 0.5°, nothing else": "builtin:panel:width=0.5,height=0.5,background=0",
    "a window in a dark room": "builtin:panel:width=40,height=60,elevation=10,background=0.05",
    "studio with soft boxes": "builtin:studio",
    "six coloured discs": "builtin:axes",
    "the thesis's two lobes": "builtin:thesis",
    "a bright horizon": "fn:exp(-(12*y)^2)+0.05",
    "chequers of 30°": "fn:sin(6*atan2(x,-z))*sin(6*asin(y))>0?1:0.1",
}
MATERIALS = {
    "Lambert": "lambert",
    "Oren-Nayar σ .6": "oren-nayar:sigma=0.6",
    "Ward σ .2": "ward:sigma=0.2",
    "Cook-Torrance m .5": "cook-torrance:m=0.5,f0=0.9",
}
MOST_BANDS = 20
# Name of a table, what its cells are about, and the tolerance.
TABLES = [("largest", "p99", 0.01), ("coarse", "p99", 0.05), ("local", "p99_local", 0.05)]
PLOTS = {"sky_lambert": ("builtin:sky", "lambert"), "studio_ward": ("builtin:studio", "ward:sigma=0.2")}


def measure(tool, light, material):
    command = [tool, "-q", "bands", "--light", light, "--material", material, "--bands", str(MOST_BANDS), "--json"]
    return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["bands"]


def enough(bands, key, tolerance):
    """The first number from which on all keep the tolerance."""
    worse = [band["n"] for band in bands if band[key] > tolerance]
    first = max(worse, default=0) + 1
    return str(first) if first <= MOST_BANDS else f"> {MOST_BANDS}"


def main(tool, root):
    measured = {}
    for light in LIGHTS.values():
        for material in MATERIALS.values():
            measured[light, material] = measure(tool, light, material)
        print(light, file=sys.stderr)

    document = root / "docs/bands.md"
    text = document.read_text(encoding="utf-8")
    for name, key, tolerance in TABLES:
        rows = ["| | " + " | ".join(MATERIALS) + " |", "|---|" + "---|" * len(MATERIALS)]
        for title, light in LIGHTS.items():
            cells = [enough(measured[light, material], key, tolerance) for material in MATERIALS.values()]
            rows.append(f"| {title} | " + " | ".join(cells) + " |")
        marker = f"<!-- bands.py: {name} -->"
        text, count = re.subn(f"{marker}\n.*?<!-- end -->", lambda _: "\n".join([marker, *rows, "<!-- end -->"]), text,
                              flags=re.DOTALL)
        if count != 1:
            sys.exit(f"{document}: has no place for {name}: {marker} and <!-- end -->")
    document.write_text(text, encoding="utf-8")

    (root / "docs/images/bands").mkdir(exist_ok=True)
    for name, (light, material) in PLOTS.items():
        subprocess.run([tool, "-q", "bands", "--light", light, "--material", material, "-o",
                        root / f"docs/images/bands/{name}.svg"], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:])) if len(sys.argv) == 3 else sys.exit(__doc__)

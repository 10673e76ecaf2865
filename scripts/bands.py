#!/usr/bin/env python3
"""Measures the tables and plots of docs/bands.md with the tool: bands.py TOOL ROOT.

Tables stand between the markers <!-- bands.py: NAME --> and <!-- end -->; what lies between is replaced.
"""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

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
    "Oren-Nayar .6": "oren-nayar:sigma=0.6",
    "plastic .5": "metallic-roughness:base=0.7,metallic=0,roughness=0.5",
    "Cook-Torrance .5": "cook-torrance:m=0.5,f0=0.9",
    "Blinn-Phong 16": "blinn-phong:rd=0,rs=0.9,n=16",
    "GGX .3": "ggx:alpha=0.3,f0=0.9",
    "Cook-Torrance .2": "cook-torrance:m=0.2,f0=0.9",
    "Ward .2": "ward:sigma=0.2",
    "Ward .1 × .4": "ward-aniso:sx=0.1,sy=0.4",
    "GGX .1": "ggx:alpha=0.1,f0=0.9",
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


def count_enough(measured, materials, most, key, tolerance):
    """How many of the lights and materials keep the tolerance with `most` bands and with all more, and of how many."""
    numbers = [enough(bands, key, tolerance) for (_, material), bands in measured.items() if material in materials]
    return sum(number.isdigit() and int(number) <= most for number in numbers), len(numbers)


def difference_of_methods(tool):
    """Relative RMSE of three bands drawn by cosine transfer and by nine coefficients of irradiance."""
    with tempfile.TemporaryDirectory() as folder:
        pictures = []
        for method in (["transfer", "--transfer", "cosine"], ["irradiance"]):
            pictures.append(f"{folder}/{method[0]}.exr")
            subprocess.run([tool, "-q", "render", "builtin:sphere", "--bands", "3", "--no-background", "-o",
                            pictures[-1], "--method", *method], check=True)
        command = [tool, "-q", "compare", *pictures, "--json"]
        return json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["relative"]


def claims(measured, tool):
    """What is said of bands, and what was measured of it."""
    lambert = {MATERIALS["Lambert"]}
    others = set(MATERIALS.values()) - lambert
    three = [measured[light, "lambert"][2] for light in LIGHTS.values()]
    median = sorted(band["rms"] for band in three)[len(three) // 2]
    worst = max(three, key=lambda band: band["max"])
    rows = ["| claim | measured |", "|---|---|"]
    rows.append(
        "| Three bands are enough for Lambertian surfaces: about 1 % in the mean (Ramamoorthi and Hanrahan) | of the "
        f"largest, {100 * median:.1f} % (rms) under the median light, at most {100 * worst['max']:.0f} % in any direction "
        "of any light; within 5 % in 99 % of directions "
        "under {} of {} lights, within 1 % under {} |".format(*count_enough(measured, lambert, 3, "p99", 0.05),
                                                             count_enough(measured, lambert, 3, "p99", 0.01)[0]))
    rows.append(
        "| Classic transfer of three bands and the nine coefficients agree | the sphere drawn by both differs by "
        f"{100 * difference_of_methods(tool):.2g} % (RMSE), outlines included |")
    four, five, eight = (count_enough(measured, others, most, "p99", 0.05) for most in (4, 5, 8))
    rows.append(
        f"| Anything else needs at least five | within 5 % of the largest, four are enough for {four[0]} of {four[1]} pairs "
        f"of light and other material, five for {five[0]}, eight for {eight[0]} |")
    return rows


def put(text, name, rows):
    """The document with these rows between the table's markers."""
    marker = f"<!-- bands.py: {name} -->"
    text, count = re.subn(f"{marker}\n.*?<!-- end -->", lambda _: "\n".join([marker, *rows, "<!-- end -->"]), text,
                          flags=re.DOTALL)
    if count != 1:
        sys.exit(f"docs/bands.md: has no place for {name}: {marker} and <!-- end -->")
    return text


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
        text = put(text, name, rows)
    text = put(text, "claims", claims(measured, tool))
    document.write_text(text, encoding="utf-8")

    (root / "docs/images/bands").mkdir(exist_ok=True)
    for name, (light, material) in PLOTS.items():
        subprocess.run([tool, "-q", "bands", "--light", light, "--material", material, "-o",
                        root / f"docs/images/bands/{name}.svg"], check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main(*map(pathlib.Path, sys.argv[1:])) if len(sys.argv) == 3 else sys.exit(__doc__)

#!/usr/bin/env python3
"""Draws the masks of several renderers for a shadowtruth set, and prints the table of docs/shadowtruth.md.

usage: results.py DIR MASKS [--rows maps,log,exact,rays,cycles,three] [--gnomon PROGRAM] [--three FOLDER] [--write]

DIR is the folder of the set, made by scripts/shadowtruth. The script scores masks that exist in the folder MASKS, and
draws the others. --write replaces the table in the page.
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys

import score

HERE = pathlib.Path(__file__).resolve().parent
PAGE = HERE.parents[1] / "docs/shadowtruth.md"
MAPS = ["--shadows", "maps", "--shadow-texels", "2048x2048", "--filter", "1", "--face-partitions", "off", "--cull-casters", "on"]
SLICES = ["--z-partitions", "4", "--split-lambda", "1", "--stabilize", "off", "--shadow-near", "auto", "--shadow-far", "auto"]
# Options of `gnomon render` per table row, and additional options for suns. Lamps use cube maps without warp.
GNOMON = {
    "maps": (MAPS, [*SLICES, "--warp", "lspsm"]),
    "log": (MAPS, [*SLICES, "--warp", "log"]),
    "exact": (["--shadows", "exact"], []),
    "rays": (["--shadows", "rays"], []),
}
NAMES = {"maps": "gnomon, 4 LSPSM maps", "log": "gnomon, 4 logarithmic maps", "exact": "gnomon, exact", "rays": "gnomon, rays",
         "cycles": "Blender 3.4 Cycles, CPU", "three": "three.js, BasicShadowMap"}  # fmt: skip


def draw_by_gnomon(gnomon, folder, masks, row, case):
    common, for_suns = GNOMON[row]
    subprocess.run([gnomon, "render", folder / f"models/{case['scene']}.gnm", "-o", masks / f"{case['name']}.tmp.png",
                    *case["options"], *common, *(for_suns if "sun" in case else []),
                    "--shadow-classes", masks / f"{case['name']}.png", "--threads", "1", "--progress", "none"],
                   check=True)  # fmt: skip
    (masks / f"{case['name']}.tmp.png").unlink()


def draw(words, row, cases, masks):
    if row in GNOMON:
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            absent = [case for case in cases if not (masks / f"{case['name']}.png").exists()]
            list(pool.map(lambda case: draw_by_gnomon(words.gnomon, words.folder, masks, row, case), absent))
    elif row == "cycles":
        subprocess.run(["blender", "-b", "--factory-startup", "--python-exit-code", "1", "-P", HERE / "cycles.py", "--", words.folder, masks],
                       check=True, stdout=subprocess.DEVNULL)  # fmt: skip
    else:
        subprocess.run([sys.executable, HERE / "three.py", words.folder, masks, words.three], check=True)


def cells(words, row, cases):
    """Returns the cells of a table row: the scores of one renderer over all `cases`."""
    pairs = [(c["name"], words.folder / f"{c['name']}.png", words.masks / row / f"{c['name']}.png") for c in cases]
    _, total = score.score_all(pairs)
    _, judged, _, *kinds, wrong, p50, p99 = total
    return [f"{wrong}%", *(f"{100 * k / judged:.4f}%" for k in kinds), p50, p99]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, metavar="DIR")
    parser.add_argument("masks", type=pathlib.Path, metavar="MASKS")
    parser.add_argument("--rows", default=",".join(NAMES))
    parser.add_argument("--gnomon", default=HERE.parents[1] / "build/release/gnomon")
    parser.add_argument("--three", default="node_modules/three", help="folder of the npm package")
    parser.add_argument("--write", action="store_true", help="write the table into docs/shadowtruth.md")
    words = parser.parse_args()
    cases = json.loads((words.folder / "cases.json").read_text())
    lines = ["| renderer | lights | wrong | false | missed | leaked | edge p50, px | edge p99, px |\n|---|---|---|---|---|---|---|---|"]
    print(lines[0])
    for row in words.rows.split(","):
        masks = words.masks / row
        masks.mkdir(parents=True, exist_ok=True)
        if any(not (masks / f"{case['name']}.png").exists() for case in cases):
            draw(words, row, cases, masks)
        for light in ("sun", "lamp"):
            some = [c for c in cases if light in c]
            if row == "log" and light == "lamp":
                continue
            lines.append("| " + " | ".join([NAMES[row], f"{len(some)} {light}s", *cells(words, row, some)]) + " |")
            print(lines[-1], flush=True)
    if words.write:
        text = PAGE.read_text()
        PAGE.write_text(re.sub(r"(<!-- results -->\n).*?(<!-- end -->)", lambda found: found[1] + "\n".join(lines) + "\n" + found[2], text, flags=re.S))


if __name__ == "__main__":
    main()

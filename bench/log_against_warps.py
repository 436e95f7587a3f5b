#!/usr/bin/env python3
"""Compares the wrong shadow pixels of logarithmic maps with the schemes of the paper, with the same number of texels.

usage: bench/log_against_warps.py GNOMON MODEL.gnm EYE TARGET [--near D --far D] [--texels WxH] [--size N] [--lights N]

EYE and TARGET are positions X,Y,Z in world units. The depth range of the shadows is --near to --far (default: 0.5 to
500). The maps have --texels texels in total (default: 1024x1024). Images have --size x --size pixels (default: 800).
The --lights directions (default: 12) are 20, 45 and 70 degrees above the horizon, evenly distributed around the camera.

The script prints one table row per light. It contains the best scheme of the paper and the best logarithmic scheme. It
states the wrong pixels and the aliasing bound (promise) of both, and the ratio of the wrong pixels. Wrong pixels differ
from exact shadows, and are fractions of all pixels (wrong_pixels_all). The last line counts the lights with a ratio of
at most 0.95.
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

PAPER = {
    "map+w": ["--warp", "auto", "--z-partitions", "1"],
    "zp4": ["--warp", "none", "--z-partitions", "4"],
    "zp4+w": ["--warp", "auto", "--z-partitions", "4"],
    "zp8+w": ["--warp", "auto", "--z-partitions", "8"],
    "fp+zp2+w": ["--warp", "auto", "--z-partitions", "2", "--face-partitions", "on"],
    "fp+zp4+w": ["--warp", "auto", "--z-partitions", "4", "--face-partitions", "on"],
}
LOGARITHMIC = {
    "log": ["--warp", "log", "--z-partitions", "1"],
    "log zp4": ["--warp", "log", "--z-partitions", "4"],
    "log fp": ["--warp", "log", "--z-partitions", "1", "--face-partitions", "on"],
}


def lights(count):
    rings = (20, 45, 70)  # degrees above the ground
    for i in range(count):
        up = math.radians(rings[i % len(rings)])
        about = 2 * math.pi * (i + 0.37) / count
        yield math.cos(up) * math.cos(about), math.sin(up), math.cos(up) * math.sin(about)


def wrong(options, folder, light, words):
    stats = folder / "stats.json"
    command = [options.gnomon, "render", options.model, "-o", folder / "a.png", "--stats", stats, "--oracle", "exact", "--samples", "1",
               "--shadows", "maps", "--cull-casters", "on", "--eye", options.eye, "--target", options.target,
               "--shadow-near", options.near, "--shadow-far", options.far, "--size", f"{options.size}x{options.size}",
               "--shadow-texels", options.texels, "--light", ",".join(f"{c:.6f}" for c in light), *words]
    subprocess.run([str(word) for word in command], check=True, capture_output=True, timeout=300)
    row = json.loads(stats.read_text())
    promise = max(row["promised_aliasing_x"], row["promised_aliasing_z"])
    return row["wrong_pixels_all"], promise, row["measured_aliasing"]


def best_of(options, folder, light, schemes):
    found = {name: wrong(options, folder, light, words) for name, words in schemes.items()}
    name = min(found, key=lambda scheme: found[scheme][0])
    return name, found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("gnomon", "model", "eye", "target"):
        parser.add_argument(name)
    parser.add_argument("--near", default="0.5")
    parser.add_argument("--far", default="500")
    parser.add_argument("--texels", default="1024x1024")
    parser.add_argument("--size", type=int, default=800)
    parser.add_argument("--lights", type=int, default=12)
    options = parser.parse_args()
    better = 0
    print("| light | best of the paper's | its wrong pixels | promise | logarithmic | wrong pixels | promise | ratio |")
    print("|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for light in lights(options.lights):
            theirs, even = best_of(options, folder, light, PAPER)
            ours, log = best_of(options, folder, light, LOGARITHMIC)
            ratio = log[ours][0] / even[theirs][0] if even[theirs][0] > 0 else math.inf
            better += ratio <= 0.95
            print(f"| {light[0]:.2f}, {light[1]:.2f}, {light[2]:.2f} | {theirs} | {even[theirs][0]:.4%} | "
                  f"{even[theirs][1]:.2f} | {ours} | {log[ours][0]:.4%} | {log[ours][1]:.2f} | {ratio:.2f} |", flush=True)
            everything = ", ".join(f"{k} {v[0]:.4%} (promise {v[1]:.2f})" for k, v in {**even, **log}.items())
            print(everything, file=sys.stderr, flush=True)
    print(f"{better} of {options.lights} lower by 5% and more")


if __name__ == "__main__":
    main()

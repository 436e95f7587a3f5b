#!/usr/bin/env python3
"""How far from those of full detail the edges of shadows lie at one pixel of error, with the sun before, beside and
behind the camera: of each pixel at the edge of a cast shadow, the distance to the nearest such pixel of full detail.

usage: bench/shadow_edges.py GNOMON [--views N] [--size N] [--shadows MODE] MODEL.gnm,PATH.json ...
"""
import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

from first_look import read_pfm, read_png

FAR = 12  # pixels: what is further from any edge is counted as this
LIT = 100  # of 255: brighter is lit, for a surface that the light meets at more than about ten degrees
SUNS = {"before": (1, 0), "beside": (0, 1), "behind": (-1, 0)}


def picture(gnomon, folder, model, words):
    """The brightness and the depth of each pixel, row by row."""
    png, pfm = folder / "a.png", folder / "a.pfm"
    subprocess.run([gnomon, "render", model, "-o", png, "--depth", pfm, "--shading", "lit", "--ambient", "0",
                    "--background", "white", *map(str, words)], check=True, capture_output=True, timeout=300)
    _, _, rows = read_png(png)
    return [[max(color[:3]) for color in row] for row in rows], read_pfm(pfm)


def edge_pixels(shaded, unshaded, depth):
    """Pixels of cast shadows that a lit pixel of the same surface is beside."""
    size = len(shaded)
    edges = set()
    for y in range(size):
        for x in range(size):
            z = depth[y][x]
            if not math.isfinite(z) or shaded[y][x] > 2 or unshaded[y][x] <= LIT:
                continue
            for i, j in ((x + 1, y), (x - 1, y), (x, y + 1), (x, y - 1)):
                if 0 <= i < size and 0 <= j < size and shaded[j][i] > LIT and abs(depth[j][i] - z) < 0.01 * z:
                    edges.add((x, y))
                    break
    return edges


def distance(pixel, edges):
    """From `pixel` to the nearest of `edges`, at most FAR."""
    best = FAR * FAR
    for ring in range(FAR + 1):
        if ring * ring >= best:
            break
        for i in range(-ring, ring + 1):
            for j in ((-ring, ring) if abs(i) != ring else range(-ring, ring + 1)):
                if i * i + j * j < best and (pixel[0] + i, pixel[1] + j) in edges:
                    best = i * i + j * j
    return math.sqrt(best)


def edges_of(gnomon, folder, model, words, error, shadows):
    words = [*words, "--error-pixels", f"{error:g}"]
    shaded, depth = picture(gnomon, folder, model, [*words, "--shadows", shadows])
    return edge_pixels(shaded, picture(gnomon, folder, model, [*words, "--shadows", "off"])[0], depth)


def views(path, count):
    """(seconds, direction of view) at `count` moments of a camera path."""
    frames = json.loads(pathlib.Path(path).read_text())["keyframes"]
    for i in range(count):
        frame = frames[i * len(frames) // count]
        yield frame["time"], [t - e for t, e in zip(frame["target"], frame["eye"])]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("gnomon")
    parser.add_argument("models", nargs="+")
    parser.add_argument("--views", type=int, default=20)
    parser.add_argument("--size", type=int, default=320)
    parser.add_argument("--shadows", default="exact")
    args = parser.parse_args()
    everything = []
    with tempfile.TemporaryDirectory() as name:
        for pair in args.models:
            model, path = pair.split(",")
            found = []
            for seconds, (x, _, z) in views(path, args.views):
                length = math.hypot(x, z) or 1
                for ahead, aside in SUNS.values():
                    sun = [(ahead * x - aside * z) / length, 0.8, (ahead * z + aside * x) / length]
                    words = ["--camera", path, "--time", seconds, "--light", ",".join(f"{c:.4f}" for c in sun),
                             "--size", f"{args.size}x{args.size}"]
                    cut, full = (edges_of(args.gnomon, pathlib.Path(name), model, words, error, args.shadows)
                                 for error in (1, 1e-4))
                    found += [distance(pixel, full) for pixel in cut] if full else []
            everything += found
            report(model, found)
    report("all", everything)


def report(name, found):
    found.sort()
    if not found:
        print(f"{name}: no edge of a shadow")
        return
    at = {share: found[min(int(share * len(found)), len(found) - 1)] for share in (0.5, 0.95, 0.99)}
    over = sum(value > 1.5 for value in found) / len(found)
    print(f"{name}: {len(found)} pixels, median {at[0.5]:.2f}, 95% {at[0.95]:.2f}, 99% {at[0.99]:.2f}, "
          f"over 1.5 {100 * over:.2f}%", flush=True)


if __name__ == "__main__":
    sys.exit(main())

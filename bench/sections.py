#!/usr/bin/env python3
"""Compares section caps at one pixel of error with full detail, and counts pixels that flicker while the plane moves.

usage: bench/sections.py GNOMON MODEL.gnm [--heights 20] [--moves 5] [--steps 16] [--size 800] [--seed 1]

The section planes are horizontal, and the camera looks from above, with one sample per pixel. Full detail has an error
of 0.01 pixels. The cap of a section has three colours: solid (inside of a closed surface), outline (edge of a closed
surface), and open edge (intersection with an open surface).

First, the script tests --heights planes, and prints per plane:
- solid, outline, open: number of pixels of each colour
- apart from full detail: solid or outline pixels without a cap pixel at full detail in the 3x3 pixels around them
- of full detail: the same count with both pictures exchanged

Then, the script moves the plane up --moves times, by --steps steps of 1/4000 of the model's height. It prints per move:
- shown at some time: pixels that show the cap in at least one step
- flicker: pixels around which the cap changes at least twice between closed (solid or outline) and open edges
- own: flickering pixels that also flicker at full detail, because of the model's geometry
- apart from full detail: the same count for all cap colours, in the first and in the last step

The exit code is 1 if more than 0.5% of the pixels of a plane or a move are apart. It is also 1 if more than 0.1% of the
pixels of a move flicker, but not at full detail.
"""
import argparse
import pathlib
import random
import re
import subprocess
import sys
import tempfile

from first_look import read_png

SOLID, OUTLINE, OPEN = (181, 92, 61), (56, 26, 18), (212, 54, 33)


def bounds(gnomon, model):
    text = subprocess.run([gnomon, "info", model], capture_output=True, text=True, check=True).stdout
    numbers = [float(n) for n in re.findall(r"-?[\d.]+(?:e[-+]?\d+)?", text.split("bounds")[1].splitlines()[0])]
    return numbers[:3], numbers[3:]


class Pictures:
    def __init__(self, gnomon, model, size, folder):
        self.words = [gnomon, "render", model, "--view", "top", "--size", f"{size}x{size}", "--samples", "1",
                      "--shadows", "off", "-o", str(folder / "cut.png")]
        self.path = folder / "cut.png"

    def shown(self, height, *options):
        """Returns the cap pixels {(x, y): colour} of the section plane at `height`. `options` go to `gnomon render`."""
        subprocess.run([*self.words, "--section", f"0,{height!r},0,0,1,0", *options], check=True, capture_output=True)
        _, _, rows = read_png(self.path)
        return {(x, y): tuple(pixel[:3]) for y, row in enumerate(rows) for x, pixel in enumerate(row)
                if tuple(pixel[:3]) in (SOLID, OUTLINE, OPEN)}


def apart(shown, other):
    """Returns the number of pixels of `shown` without a pixel of `other` in the 3x3 pixels around them."""
    return sum(1 for x, y in shown if not any((x + dx, y + dy) in other for dx in (-1, 0, 1) for dy in (-1, 0, 1)))


def turns(pictures, at):
    """Returns how often the cap around pixel `at` changes between closed and open, over the sequence `pictures`."""
    count, last = 0, None
    for shown in pictures:
        near = {shown.get((at[0] + dx, at[1] + dy)) for dx in (-1, 0, 1) for dy in (-1, 0, 1)} - {None}
        if not near:
            continue
        is_open = near == {OPEN}
        count += last is not None and is_open != last
        last = is_open
    return count


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("gnomon")
    parser.add_argument("model")
    parser.add_argument("--heights", type=int, default=20)
    parser.add_argument("--moves", type=int, default=5)
    parser.add_argument("--steps", type=int, default=16)
    parser.add_argument("--size", type=int, default=800)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    low, high = bounds(options.gnomon, options.model)
    tall, failed = high[1] - low[1], False
    with tempfile.TemporaryDirectory() as folder:
        pictures = Pictures(options.gnomon, options.model, options.size, pathlib.Path(folder))
        print("height  solid  outline  open  apart from full detail  of full detail")
        for i in range(options.heights):
            height = low[1] + tall * (i + 0.5) / options.heights
            usual, fine = pictures.shown(height), pictures.shown(height, "--error-pixels", "0.01")
            kinds = [sum(1 for kind in usual.values() if kind == wanted) for wanted in (SOLID, OUTLINE, OPEN)]
            caps, fine_caps = ({at for at, kind in of.items() if kind != OPEN} for of in (usual, fine))
            away, fine_away = apart(caps, fine.keys()), apart(fine_caps, usual.keys())
            failed |= away + fine_away > 0.005 * (len(caps) + len(fine_caps))
            print(f"{height:6.2f} {kinds[0]:6} {kinds[1]:8} {kinds[2]:5} {away:23} {fine_away:15}", flush=True)
        generator = random.Random(options.seed)
        print("from    by step  shown at some time  flicker  own  apart from full detail")
        for _ in range(options.moves):
            start, step = low[1] + tall * generator.uniform(0.1, 0.8), tall / 4000
            usual = [pictures.shown(start + i * step) for i in range(options.steps)]
            fine = [pictures.shown(start + i * step, "--error-pixels", "0.01") for i in range(options.steps)]
            ever = set().union(*usual)
            flickers = [at for at in ever if turns(usual, at) >= 2]
            own = sum(1 for at in flickers if turns(fine, at) >= 2)
            away = sum(apart(usual[i].keys(), fine[i].keys()) for i in (0, -1))
            failed |= len(flickers) - own > 0.001 * len(ever) or away > 0.005 * len(ever)
            print(f"{start:6.2f} {step:8.4f} {len(ever):19} {len(flickers):8} {own:4} {away:23}", flush=True)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()

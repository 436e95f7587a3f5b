#!/usr/bin/env python3
"""Holds sections to their bars: what a level plane shows at N heights of a model, at the usual detail against the finest,
and whether anything flickers while the plane moves by small steps.

usage: bench/sections.py GNOMON MODEL.gnm [--heights 20] [--moves 5] [--steps 16] [--size 800] [--seed 1]

Looked at from above, one sample a pixel. A pixel shows the plane where its colour is one of a cap's: solid, an outline,
an open edge. `apart`: of the pixels that show something solid or its outline at one detail, those that show nothing of
the plane within a pixel at the other. `flicker`: the pixels that, while the plane moves up, show something solid or its
outline, then within a pixel nothing but open edges, and then the first again; or the other way around. `own` are those
of them that do so at full detail too: two closed things above each other, and something open between. The others are
things that open and close again without an end. Exit code 1 if more than 0.5% of the pixels of any plane are apart, or
more than 0.1% of a move's flicker and do not of their own.
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
        """The kinds of cap by pixel: {(x, y): colour}."""
        subprocess.run([*self.words, "--section", f"0,{height!r},0,0,1,0", *options], check=True, capture_output=True)
        _, _, rows = read_png(self.path)
        return {(x, y): tuple(pixel[:3]) for y, row in enumerate(rows) for x, pixel in enumerate(row)
                if tuple(pixel[:3]) in (SOLID, OUTLINE, OPEN)}


def apart(shown, other):
    """How many of `shown` have none of `other` within a pixel."""
    return sum(1 for x, y in shown if not any((x + dx, y + dy) in other for dx in (-1, 0, 1) for dy in (-1, 0, 1)))


def turns(pictures, at):
    """How often what the plane shows near a pixel turns from closed to open or back."""
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

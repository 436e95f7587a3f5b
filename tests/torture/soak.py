"""Many random frames in one process: memory stays flat, and each picture is that of a fresh process.

usage: soak.py [--frames N] [--seed S] [MODEL...]

A path through random places is drawn by one `render --path` under a memory cap so small that pages come and go; a
sample of its frames is drawn again, each by a process of its own, and compared to the byte. $GNOMON is the program.
"""
import argparse
import itertools
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

GNOMON = os.environ["GNOMON"]
PAGE_BYTES = os.sysconf("SC_PAGE_SIZE")
SHOWN = ("--size", "160x120", "--samples", "1", "--shading", "lit", "--error-pixels", "0.5", "--memory", "160M", "--threads", "2")
SHADOWS = (("--shadows", "auto"), ("--shadows", "maps", "--z-partitions", "auto"), ("--shadows", "maps", "--warp", "log"))
TURN = 31  # degrees between one view and the next: a jump (src/plan/hysteresis.h), behind which nothing is remembered


def run(*words):
    done = subprocess.run([GNOMON, *map(str, words)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def box_of(model):
    """Its centre and half its diagonal."""
    told = json.loads(run("info", model, "--json"))["bounds"]
    low, high = told["min"], told["max"]
    centre = [(a + b) / 2 for a, b in zip(low, high)]
    return centre, sum((b - a) ** 2 for a, b in zip(low, high)) ** 0.5 / 2


def random_path(model, frames, chance):
    centre, radius = box_of(model)

    def place(limit):
        return [c + radius * chance.uniform(-limit, limit) for c in centre]

    keys = []
    while len(keys) < frames:
        key = {"time": len(keys), "eye": place(1.5), "target": place(0.3), "up": [0, 1, 0], "fov_y": chance.uniform(20, 90)}
        if not keys or turn(keys[-1], key) > math.radians(TURN):
            keys.append(key)
    return {"loop": False, "interpolation": "linear", "keyframes": keys}


def turn(before, now):
    """The angle between the directions of two views, radians."""
    one, other = ([t - e for t, e in zip(key["target"], key["eye"])] for key in (before, now))
    return math.acos(max(-1, min(1, sum(a * b for a, b in zip(one, other)) / math.hypot(*one) / math.hypot(*other))))


def watched(*words):
    """Resident bytes of a run over its time, sampled while it runs."""
    running = subprocess.Popen([GNOMON, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    sizes = []
    while running.poll() is None:
        try:
            sizes.append(int(pathlib.Path(f"/proc/{running.pid}/statm").read_text().split()[1]) * PAGE_BYTES)
        except (OSError, IndexError):
            break
        time.sleep(0.02)
    said = running.communicate()[1]
    assert running.returncode == 0, said
    return sizes


def growth(sizes):
    """How much more is resident in the last quarter than in the second, as a share: medians."""
    def median(values):
        return sorted(values)[len(values) // 2]

    quarter = len(sizes) // 4
    return median(sizes[3 * quarter :]) / median(sizes[quarter : 2 * quarter]) - 1


def soak(model, folder, frames, shadows, chance):
    path = folder / "path.json"
    path.write_text(json.dumps(random_path(model, frames, chance)))
    shown = (*SHOWN, *shadows)
    light = ",".join(str(chance.uniform(-1, 1) if axis != 1 else 1) for axis in range(3))
    sizes = watched("render", model, "--path", path, "--frames", frames, "--light", light, *shown, "-o", folder / "frame%04d.png")
    wrong = []
    for number in chance.sample(range(frames), min(frames, 8)):
        when = number / (frames - 1) * (frames - 1)  # rounded as the path's is
        run("render", model, "--camera", path, "--time", repr(when), "--light", light, *shown, "-o", folder / "fresh.png")
        if (folder / "fresh.png").read_bytes() != (folder / f"frame{number:04d}.png").read_bytes():
            wrong.append(number)
    return growth(sizes), max(sizes), wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--frames", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("models", nargs="*", type=pathlib.Path)
    given = parser.parse_args()
    broken = False
    with tempfile.TemporaryDirectory(prefix="gnomon_torture_") as name:
        folder = pathlib.Path(name)
        models = given.models
        if not models:
            run("make", "plant", "--triangles", "60k", "-o", folder / "plant.ply")
            run("build", folder / "plant.ply", "-o", folder / "plant.gnm")
            models = [folder / "plant.gnm"]
        for model, shadows in itertools.product(models, SHADOWS):
            grown, peak, wrong = soak(model, folder, given.frames, shadows, random.Random(f"{given.seed} {model.name}"))
            print(f"{model.name} {' '.join(shadows)}: {given.frames} frames, peak resident size {peak / 2**20:.0f} MiB, grown by "
                  f"{grown:.1%}, {len(wrong)} frames that a fresh process draws otherwise {wrong or ''}")  # fmt: skip
            # A short run is all beginning: what it grows by says nothing.
            broken |= bool(wrong) or (given.frames >= 1000 and grown > 0.02)
    sys.exit(1 if broken else 0)


if __name__ == "__main__":
    main()

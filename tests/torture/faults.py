"""Every call that can fail, fails: opens, reads, writes, syncs, renames, unlinks, sizes and allocations, each in turn.

usage: faults.py [--every] [--seed S] [--seconds T] [--allocations N] [COMMAND...] [--ways WAY...]

The program runs with a preloaded library (failing_calls.cpp) that counts its calls on the files of a folder and makes
the Nth fail. After each run: no crash and no hang; with exit 0 the outputs are those of an undisturbed run; with exit 1
there is one line, and under each final name lies the file that was there before, or the whole new one; the inputs are
untouched; and the same command, undisturbed, then gives the right outputs and leaves nothing else behind. Calls that are
interrupted or move fewer bytes than asked for are not seen at all.

Without --every a seeded sample that fits into T seconds (60); $GNOMON is the program, $TORTURE_LIBRARY the library.
"""
import argparse
import collections
import hashlib
import json
import mmap
import os
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import time

KINDS = ("open", "read", "write", "sync", "rename", "map", "unlink", "folder", "size", "status", "allocation")
HOWS = {
    "open": ("EIO", "EINTR"),
    "read": ("EIO", "EINTR", "short"),
    "write": ("EIO", "ENOSPC", "EINTR", "short", "kill", "killed"),
    "sync": ("EIO", "EINTR", "killed"),
    "rename": ("EIO", "kill", "killed"),
    "map": ("ENOMEM",),
    "unlink": ("EIO", "kill", "killed"),
    "folder": ("ENOSPC", "killed"),
    "size": ("ENOSPC", "EINTR", "killed"),
    "status": ("EIO",),
    "allocation": ("ENOMEM",),
}
INVISIBLE = ("EINTR", "short")
KILLED = ("kill", "killed")
NOT_OURS = ("failed to register TLS destructor", "Could not allocate dispatch index array")  # libc, libEGL end it there
OLD = b"what was there before\n"
SMALL = ("--size", "48x32", "--shadow-texels", "128x128", "--samples", "1")
SECONDS_OF_A_RUN = 60


class Command:
    """A command line, the files of the folder that it reads, and what it writes (a name may be a folder)."""

    def __init__(self, name, words, reads, writes, same=None, leaves=()):
        self.name, self.words, self.reads, self.writes = name, words, reads, writes
        self.same = same or (lambda one, other: one == other)
        self.leaves = leaves  # what may stay beside it when it fails: a checkpoint to go on from
        self.resume = ("--resume",) if leaves and "--resume" not in words else ()


def same_bench(one, other):
    """Whether two logs have the same rows; their times are their own."""
    rows = [[line.count(b",") for line in text.splitlines()] for text in (one, other)]
    return rows[0] == rows[1]


def commands():
    build = ("--chunk-triangles", "2000", "--threads", "2")
    return (
        Command("build", ("build", "in.ply", "-o", "out.gnm", *build), ["in.ply"], ["out.gnm"], leaves=["out.gnm.building"]),
        Command("rebuild", ("build", "in.ply", "-o", "out.gnm", "--resume", *build), ["in.ply"], ["out.gnm"], leaves=["out.gnm.building"]),
        Command("make", ("make", "plant", "--triangles", "20k", "-o", "out.ply"), [], ["out.ply"]),
        Command("render", ("render", "in.gnm", "-o", "out.png", *SMALL), ["in.gnm"], ["out.png"]),
        Command("stats", ("render", "in.gnm", "-o", "out.png", "--shadows", "maps", "--depth", "out.pfm", *SMALL), ["in.gnm"], ["out.png", "out.pfm"]),
        Command("bench", ("bench", "in.gnm", "--path", "path.json", "--frames", "2", "--warmup", "0", "--csv", "out.csv", *SMALL[:4]),
                ["in.gnm", "path.json"], ["out.csv"], same=same_bench),
        Command("export", ("export", "in.gnm", "--triangles", "2k", "-o", "out.ply"), ["in.gnm"], ["out.ply"]),
        Command("glb", ("export", "in.gnm", "--triangles", "2k", "-o", "out.glb"), ["in.gnm"], ["out.glb"]),
        Command("tiles", ("export", "in.gnm", "--format", "3dtiles", "-o", "out"), ["in.gnm"], ["out"]),
        Command("path", ("path", "in.gnm", "--kind", "orbit", "-o", "out.json"), ["in.gnm"], ["out.json"]),
        Command("verify", ("verify", "in.gnm", "--cuts", "2"), ["in.gnm"], []),
        Command("hours", ("sun", "hours", "in.gnm", "--at", "48,11", "--from", "2026-06-21T09:00Z", "--to", "2026-06-21T15:00Z", "--step", "1h", "--size", "32x32", "-o", "out.png", "--csv", "out.csv", "--report", "out", "--resume"), ["in.gnm"], ["out.png", "out.csv", "out"], leaves=["out.png.steps"]),
    )  # fmt: skip


def content(place):
    """The bytes of a file, or of all files of a folder, by name; nothing where there is none."""
    if place.is_dir():
        return {str(file.relative_to(place)): file.read_bytes() for file in sorted(place.rglob("*")) if file.is_file()}
    return place.read_bytes() if place.is_file() else None


class Bench:
    """A folder with the inputs, in which runs are made one after another."""

    def __init__(self, gnomon, library, folder):
        self.gnomon, self.library, self.folder = gnomon, library, pathlib.Path(folder).resolve()
        self.store, self.place = self.folder / "store", self.folder / "place"
        self.counts = self.folder / "counts"
        self.counts.write_bytes(bytes(8192))
        self.store.mkdir()
        for words in (
            ("make", "plant", "--triangles", "20k", "-o", "in.ply"),
            ("build", "in.ply", "-o", "in.gnm", "--chunk-triangles", "4000"),
            ("path", "in.gnm", "--kind", "orbit", "-o", "path.json"),
        ):
            done = subprocess.run([gnomon, *words], cwd=self.store, capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
        self.inputs = {name: (self.store / name).read_bytes() for name in ("in.ply", "in.gnm", "path.json")}

    def lay_out(self, command, old):
        shutil.rmtree(self.place, ignore_errors=True)
        self.place.mkdir()
        for name in command.reads:
            (self.place / name).write_bytes(self.inputs[name])
        for name in command.writes if old else ():
            if "." in name:
                (self.place / name).write_bytes(OLD)

    def run(self, command, kind=None, at=0, how="EIO", times=1, resumes=False):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("TORTURE_")}
        if kind is not None or at < 0:
            self.counts.write_bytes(bytes(8192))
            environment.update(LD_PRELOAD=str(self.library), TORTURE_UNDER=str(self.place), TORTURE_COUNTS=str(self.counts))
        if kind is not None:
            environment.update(TORTURE_KIND=kind, TORTURE_AT=str(at), TORTURE_HOW=how, TORTURE_FOR=str(times))
        try:
            return subprocess.run([self.gnomon, *command.words, *(command.resume if resumes else ())], cwd=self.place, env=environment, stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True, errors="backslashreplace", timeout=SECONDS_OF_A_RUN)  # fmt: skip
        except subprocess.TimeoutExpired:
            return None

    def counted(self):
        return dict(zip(KINDS, struct.unpack_from(f"<{len(KINDS)}q", self.counts.read_bytes())))

    def outputs(self, command):
        return {name: content(self.place / name) for name in command.writes}

    def others(self, command, was_killed=False):
        """What lies in the folder and is neither input nor output; a killed run may leave parts under names of their own."""
        known = {*command.reads, *command.writes}
        names = sorted(entry.name for entry in self.place.iterdir() if entry.name not in known)
        return [name for name in names if not (was_killed and name.endswith(".partial"))]


def complaint(bench, command, right, how, done):
    """What is wrong with the state that a run left, or nothing."""
    if done is None:
        return "hangs"
    if how in KILLED and done.returncode == -9:
        return half_written(bench, command, right)
    if done.returncode not in (0, 1):
        return None if any(words in done.stderr for words in NOT_OURS) else f"exit {done.returncode}"
    found = bench.outputs(command)
    if any(bench.inputs[name] != (bench.place / name).read_bytes() for name in command.reads):
        return "an input was changed"
    is_right = all(command.same(found[name], right[name]) if found[name] not in (None, OLD) else False for name in right)
    if how in INVISIBLE and done.returncode != 0:
        return "was seen"
    if done.returncode == 0:
        return None if is_right else "exit 0 with wrong outputs"
    lines = [line for line in done.stderr.splitlines() if not line.startswith("gnomon: warning: ")]
    if len(lines) != 1 or not lines[0].startswith("gnomon: "):
        return f"{len(lines)} lines"
    return half_written(bench, command, right)


def half_written(bench, command, right):
    """Which final name has neither what was there before nor the whole new output, if any."""
    for name, now in bench.outputs(command).items():
        if "." not in name:
            part = [file for file, text in (now or {}).items()
                    if text != right[name].get(file) and not file.endswith(".partial")]  # fmt: skip
            if part:
                return f"half a {name}/{part[0]} under its final name"
        elif now is None:
            return f"the old {name} is lost"
        elif now != OLD and not command.same(now, right[name]):
            return f"half a {name} under its final name"
    return None


def torture_one(bench, command, right, kind, at, how, times):
    """What is wrong with a run in which that call fails, or with the run after it; and its exit code."""
    bench.lay_out(command, old=True)
    done = bench.run(command, kind, at, how, times)
    wrong = complaint(bench, command, right, how, done)
    told = "" if done is None else done.stderr[-400:]
    if wrong is None and done.returncode != 0:
        was_killed = done.returncode < 0
        left = [name for name in bench.others(command) if name not in command.leaves]
        if left and kind != "unlink" and not was_killed:
            return f"left {left}", done.stderr, done.returncode
        for name in command.writes:
            if (bench.place / name).is_dir():
                shutil.rmtree(bench.place / name)
        again = bench.run(command, resumes=was_killed)
        if again is None or again.returncode != 0:
            wrong, told = "the run after it fails", "" if again is None else again.stderr
        elif not all(command.same(now, right[name]) for name, now in bench.outputs(command).items()):
            wrong = "the run after it gives other outputs"
        elif bench.others(command, was_killed) and kind != "unlink":
            wrong = f"the run after it leaves {bench.others(command, was_killed)}"
    return wrong, told, None if done is None else done.returncode


def cases_of(bench, command, every, chance):
    """(kind, at, how, times) of what is to fail: all, or some of each kind and way."""
    found = []
    for kind, number in bench.counted().items():
        for how in HOWS[kind]:
            places = range(number)
            if not every:
                places = sorted(chance.sample(places, min(number, 4)))
            found += [(kind, at, how, 1) for at in places]
            if kind in ("write", "read") and how in ("EIO", "ENOSPC") and number:
                found += [(kind, at, how, 1 << 40) for at in list(places)[:: max(1, len(places) // 8)]]
    chance.shuffle(found)
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--every", action="store_true")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--allocations", type=int, default=200, help="with --every, so many allocations of a command")
    parser.add_argument("--ways", nargs="*", help="only these, such as kill and killed")
    parser.add_argument("commands", nargs="*")
    given = parser.parse_args()
    chance = random.Random(given.seed)
    wanted = [command for command in commands() if not given.commands or command.name in given.commands]
    finds, runs, codes, started = [], 0, collections.Counter(), time.monotonic()
    with tempfile.TemporaryDirectory(prefix="gnomon_torture_") as folder:
        bench = Bench(os.environ["GNOMON"], os.environ["TORTURE_LIBRARY"], folder)
        for index, command in enumerate(wanted):
            bench.lay_out(command, old=False)
            done = bench.run(command, at=-1)
            if done is None or done.returncode != 0:
                sys.exit(f"faults.py: {command.name}, undisturbed: {done and done.stderr}")
            right = bench.outputs(command)
            assert bench.others(command) == [], (command.name, bench.others(command))
            cases = cases_of(bench, command, given.every, chance)
            if given.every:
                kept = [case for case in cases if case[0] == "allocation"][: given.allocations]
                cases = [case for case in cases if case[0] != "allocation"] + kept
            cases = [case for case in cases if not given.ways or case[2] in given.ways]
            share = started + given.seconds * (index + 1) / len(wanted)
            before = runs
            for case in cases:
                if not given.every and time.monotonic() > share:
                    break
                wrong, told, code = torture_one(bench, command, right, *case)
                runs += 1
                codes[code] += 1
                if wrong:
                    finds.append((command.name, *case, wrong))
                    print(f"{command.name}: {case}: {wrong}: {told.strip()[-300:]}", flush=True)
            print(f"{command.name}: {runs - before} runs, {time.monotonic() - started:.0f} s", flush=True)
    print(f"{runs} runs: {dict(codes)}, {len(finds)} finds, {time.monotonic() - started:.0f} s")
    sys.exit(1 if finds else 0)


if __name__ == "__main__":
    main()

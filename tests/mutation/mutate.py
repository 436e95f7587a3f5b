#!/usr/bin/env python3
"""Changes one token of a layer at a time and says whether the quick tests notice.

usage: mutate.py --layers shadow,plan [--count 100] [--seed 1] [--build DIR] [--jobs N] [--json FILE] [--list]

Works in copies of the tree under DIR, one for each of N workers; the tree itself is only read. A mutant is tried first
on the test programs of its own layer, then on those of the layers directly above; the first that fails has caught it.
Mutants that change no byte of the library and of the first programs change nothing and are drawn anew.
"""
import argparse
import dataclasses
import difflib
import hashlib
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import threading
import time

import layers as house
import mutations

ROOT = pathlib.Path(__file__).resolve().parents[2]
QUICK = "--gtest_filter=-Slow*:*/Slow*"
OUTCOMES = ("caught", "survived", "did not compile", "same code")


@dataclasses.dataclass
class Mutant:
    layer: str
    path: str
    mutation: mutations.Mutation
    line: int = 0
    diff: str = ""
    outcome: str = ""
    by: str = ""
    seconds: float = 0


def draw(root, layer, seed):
    """All changes of a layer in a seeded order."""
    found = [Mutant(layer, str(path.relative_to(root)), change)
             for path in house.sources(root, layer) for change in mutations.mutations(path.read_text())]
    random.Random(f"{seed} {layer}").shuffle(found)
    return found


def describe(root, mutant):
    before = (root / mutant.path).read_text()
    after = mutations.applied(before, mutant.mutation)
    mutant.line = before.count("\n", 0, mutant.mutation.start) + 1
    diff = difflib.unified_diff(before.splitlines(), after.splitlines(), mutant.path, mutant.path, lineterm="", n=0)
    mutant.diff = "\n".join(list(diff)[2:])


def copy_tree(root, target):
    """Brings `target` to the files that git knows or would add, and touches only what differs."""
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=root, check=True, capture_output=True, text=True)
    names = {name for name in listed.stdout.splitlines() if (root / name).is_file()}
    for name in names:
        there = target / name
        there.parent.mkdir(parents=True, exist_ok=True)
        if not there.exists() or there.read_bytes() != (root / name).read_bytes():
            shutil.copyfile(root / name, there)
            shutil.copymode(root / name, there)
    for path in [p for p in target.rglob("*") if p.is_file()]:
        name = str(path.relative_to(target))
        if name not in names and not name.startswith("build/"):
            path.unlink()


class Workshop:
    """A copy of the tree with a build of its own."""

    def __init__(self, root, folder, jobs):
        self.root, self.jobs = folder, jobs
        folder.mkdir(parents=True, exist_ok=True)
        copy_tree(root, folder)
        self.build = folder / "build" / "release"
        self.environment = {**os.environ, "CCACHE_BASEDIR": str(folder), "GTEST_BRIEF": "1"}
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        subprocess.run(["cmake", "--preset", "release", "-DGNOMON_TESTS=ON", *launcher], cwd=folder,
                       env=self.environment, check=True, stdout=subprocess.DEVNULL)
        self.seconds = {}
        self.bytes = {}

    def make(self, *targets):
        run = subprocess.run(["cmake", "--build", str(self.build), "-j", str(self.jobs), "--target", *targets],
                             env=self.environment, capture_output=True, text=True)
        return run.returncode == 0, run.stdout + run.stderr

    def file_of(self, target):
        found = [p for p in self.build.rglob(f"lib{target}.a")] or [
            p for p in self.build.rglob(target) if p.is_file() and os.access(p, os.X_OK)]
        return found[0]

    def digest(self, target):
        return hashlib.sha256(self.file_of(target).read_bytes()).hexdigest()

    def passes(self, program, limit):
        """Whether a test program's quick tests pass within `limit` seconds."""
        try:
            run = subprocess.run([str(self.file_of(program)), QUICK, "--gtest_fail_fast"], cwd=self.root, env=self.environment,
                                 timeout=limit, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            return False
        return run.returncode == 0

    def baseline(self, targets, programs):
        """Builds and runs what is unchanged and still unknown: it must pass, and its time sets the limits."""
        programs = [program for program in programs if program not in self.seconds]
        if not targets and not programs:
            return
        done, output = self.make(*targets, *programs)
        if not done:
            raise RuntimeError(f"the unchanged tree does not build\n{output}")
        for program in programs:
            start = time.monotonic()
            if not self.passes(program, 600):
                raise RuntimeError(f"{program} fails before anything is changed")
            self.seconds[program] = time.monotonic() - start
        self.bytes.update({target: self.digest(target) for target in (*targets, *programs)})


@dataclasses.dataclass
class Suite:
    library: str
    own: list
    above: list


def suites(root, names):
    rows = house.read_rows(root)
    return {name: Suite(house.library(root, name), house.test_programs(root, name),
                        [p for upper in house.directly_above(rows, name) for p in house.test_programs(root, upper)])
            for name in names}


def judge_own(shop, suite):
    """What the layer's own programs make of the mutant whose text is in place."""
    first = [suite.library, *suite.own]
    if not shop.make(*first)[0]:
        return "did not compile", ""
    if all(shop.digest(target) == shop.bytes[target] for target in first):
        return "same code", ""
    return judge(shop, suite.own)


def judge(shop, programs):
    for program in programs:
        if not shop.make(program)[0]:
            return "did not compile", ""
        if not shop.passes(program, 10 + 4 * shop.seconds[program]):
            return "caught", program
    return "survived", ""


def attempt(shop, suite, mutant):
    path = shop.root / mutant.path
    text = path.read_text()
    start = time.monotonic()
    for ask in (lambda: judge_own(shop, suite), lambda: judge(shop, suite.above)):
        try:
            path.write_text(mutations.applied(text, mutant.mutation))
            mutant.outcome, mutant.by = ask()
        finally:
            path.write_text(text)
        if mutant.outcome != "survived":
            break
        shop.baseline([], suite.above)  # those above are built when they are first needed
    mutant.seconds = time.monotonic() - start


class Lottery:
    """Hands out mutants, layer after layer, until each layer has its share of those that count."""

    def __init__(self, root, names, count, seed):
        self.decks = {name: draw(root, name, seed) for name in names}
        self.wanted = {name: count // len(names) + (i < count % len(names)) for i, name in enumerate(names)}
        self.tried = []
        self.lock = threading.Lock()

    def take(self):
        with self.lock:
            open_layers = [name for name, left in self.wanted.items() if left > 0 and self.decks[name]]
            if not open_layers:
                return None
            name = max(open_layers, key=lambda layer: self.wanted[layer])
            self.wanted[name] -= 1
            return self.decks[name].pop()

    def put_back(self, mutant):
        """Notes a tried mutant; one that does not count is replaced by another."""
        with self.lock:
            self.tried.append(mutant)
            if mutant.outcome in ("did not compile", "same code"):
                self.wanted[mutant.layer] += 1


def work(shop, table, lottery):
    while mutant := lottery.take():
        describe(shop.root, mutant)
        attempt(shop, table[mutant.layer], mutant)
        lottery.put_back(mutant)
        print(f"{mutant.outcome:16}{mutant.path}:{mutant.line} {mutant.mutation.kind} {mutant.by} {mutant.seconds:.0f}s", flush=True)


def summary(tried, names):
    """The report's rows: per layer and over all."""
    rows = []
    for name in [*names, "all"]:
        own = [m for m in tried if name in (m.layer, "all")]
        counts = {outcome: sum(m.outcome == outcome for m in own) for outcome in OUTCOMES}
        judged = counts["caught"] + counts["survived"]
        rows.append({"layer": name, **counts, "caught_percent": round(100 * counts["caught"] / judged, 1) if judged else None})
    return rows


def report(tried, names, seed):
    rows = summary(tried, names)
    print(f"\n{'layer':14}{'caught':>8}{'survived':>10}{'no compile':>12}{'same code':>11}{'caught %':>10}")
    for row in rows:
        percent = "-" if row["caught_percent"] is None else f"{row['caught_percent']:.0f}"
        print(f"{row['layer']:14}{row['caught']:8}{row['survived']:10}{row['did not compile']:12}{row['same code']:11}{percent:>10}")
    for mutant in sorted((m for m in tried if m.outcome == "survived"), key=lambda m: (m.path, m.line)):
        print(f"\nsurvived: {mutant.path}:{mutant.line} ({mutant.mutation.kind})\n{mutant.diff}")
    return {"seed": seed, "layers": rows,
            "mutants": [{"layer": m.layer, "file": m.path, "line": m.line, "kind": m.mutation.kind, "diff": m.diff,
                         "outcome": m.outcome, "caught_by": m.by, "seconds": round(m.seconds, 1)} for m in tried]}


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--layers", default="shadow,plan,lod,raster,hierarchy")
    parser.add_argument("--count", type=int, default=100, help="mutants over all the layers together")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--build", default=str(ROOT / "build/mutation"), help="where the copies and their builds lie")
    parser.add_argument("--jobs", type=int, default=1, help="copies that are worked on at a time")
    parser.add_argument("--json", help="the report as JSON")
    parser.add_argument("--list", action="store_true", help="only list what would be tried")
    return parser.parse_args()


def main():
    options = arguments()
    rows = house.read_rows(ROOT)
    names = [house.row_of(rows, name) for name in options.layers.split(",")]
    table = suites(ROOT, names)
    lottery = Lottery(ROOT, names, options.count, options.seed)
    if options.list:
        while mutant := lottery.take():
            describe(ROOT, mutant)
            print(f"{mutant.path}:{mutant.line} {mutant.mutation.kind}\n{mutant.diff}")
        return 0
    targets = sorted({suite.library for suite in table.values()})
    programs = list(dict.fromkeys(p for suite in table.values() for p in suite.own))
    workers = []
    for i in range(options.jobs):
        shop = Workshop(ROOT, pathlib.Path(options.build).resolve() / str(i), max(1, (os.cpu_count() or 1) // options.jobs))
        shop.baseline(targets, programs)
        workers.append(threading.Thread(target=work, args=(shop, table, lottery)))
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    found = report(lottery.tried, names, options.seed)
    if options.json:
        pathlib.Path(options.json).write_text(json.dumps(found, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Functions for the benchmark scripts: make models, run `gnomon bench`, and print tables with the machine's name."""

import csv
import json
import os
import platform
import statistics
import subprocess
import sys
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parent.parent


class Workshop:
    """The measured program, and a folder for made models, which later scripts reuse.

    The folder is the first argument of the script (default: bench_models). The environment variable GNOMON names the
    program (default: the release build of this source tree).
    """

    def __init__(self):
        self.program = os.environ.get("GNOMON", str(SOURCE / "build" / "release" / "gnomon"))
        self.folder = Path(sys.argv[1] if len(sys.argv) > 1 else "bench_models")
        self.folder.mkdir(parents=True, exist_ok=True)

    def gnomon(self, *arguments):
        """Runs the program. Ends the script with the error message if the program fails."""
        done = subprocess.run([self.program, *map(str, arguments)], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"gnomon {' '.join(map(str, arguments))}\n{done.stderr}")

    def model(self, kind, triangles):
        """Returns the file of a built model, for example ("statue", "10M"). Makes it if it does not exist."""
        path = self.folder / f"{kind}_{triangles}.gnm"
        if not path.exists():
            mesh = path.with_suffix(".ply")
            self.gnomon("make", kind, "--triangles", triangles, "--seed", 1, "-o", mesh, "--progress", "none")
            self.gnomon("build", mesh, "-o", path, "--memory", "16G", "--progress", "none")
            mesh.unlink()
        return path

    def path(self, model, kind):
        """Writes a camera path around or through the model, and returns its file. `kind` is a kind of `gnomon path`."""
        path = self.folder / f"{model.stem}_{kind}.json"
        self.gnomon("path", model, "--kind", kind, "-o", path)
        return path

    def still(self, path, fraction):
        """Writes a path of one second with a fixed camera, and returns its file.

        The camera is the keyframe of `path` at `fraction` (0 to 1).
        """
        document = json.loads(path.read_text())
        keys = document["keyframes"]
        key = keys[round(fraction * (len(keys) - 1))]
        document.update(loop=False, interpolation="linear", keyframes=[dict(key, time=t) for t in (0.0, 1.0)])
        result = path.with_name(f"{path.stem}_still.json")
        result.write_text(json.dumps(document))
        return result

    def bench(self, model, path, *options):
        """Runs `gnomon bench`, and returns one dictionary per frame. Values are numbers if possible."""
        table = self.folder / "rows.csv"
        self.gnomon("bench", model, "--path", path, "--csv", table, "--progress", "none", *options)
        with open(table, newline="", encoding="utf-8") as file:
            return [{name: number(cell) for name, cell in row.items()} for row in csv.DictReader(file)]

    def bench_from_outside(self, model, path, *options):
        """Runs `gnomon bench`. Returns its rows, wall-clock seconds, and max resident memory in bytes (ru_maxrss)."""
        child = "import resource, subprocess, sys; code = subprocess.run(sys.argv[1:]).returncode; " \
                "print(resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss * 1024); sys.exit(code)"
        table = self.folder / "rows.csv"
        command = [self.program, "bench", model, "--path", path, "--csv", table, "--progress", "none", *options]
        start = time.monotonic()
        done = subprocess.run(
            [sys.executable, "-c", child, *map(str, command)], capture_output=True, text=True, check=False)
        seconds = time.monotonic() - start
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
        with open(table, newline="", encoding="utf-8") as file:
            rows = [{name: number(cell) for name, cell in row.items()} for row in csv.DictReader(file)]
        return rows, seconds, int(done.stdout.split()[-1])


def number(cell):
    """Returns the cell as a number, or as text if it is not a number."""
    try:
        return float(cell)
    except ValueError:
        return cell


def forget_cached(path):
    """Asks the system to drop the file from its page cache, so that the next run reads it from the disk."""
    with open(path, "rb") as file:
        os.fsync(file.fileno())
        os.posix_fadvise(file.fileno(), 0, 0, os.POSIX_FADV_DONTNEED)


def median(rows, column):
    return statistics.median(row[column] for row in rows)


def quantile(values, fraction):
    """Returns the quantile at `fraction` (0 to 1), with linear interpolation between ranks, like `gnomon bench`."""
    values = sorted(values)
    rank = fraction * (len(values) - 1)
    below = int(rank)
    above = min(below + 1, len(values) - 1)
    return values[below] + (values[above] - values[below]) * (rank - below)


def print_table(title, header, rows):
    """Prints a Markdown table, and below it the machine, the commit and the date."""
    print(f"### {title}\n\n| " + " | ".join(header) + " |")
    print("|" + "---|" * len(header))
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")
    print(f"\n{machine()}, commit {commit()}, {time.strftime('%Y-%m-%d', time.gmtime())}.\n")


def machine():
    name = platform.machine()
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                name = line.split(":", 1)[1].strip()
                break
    gibibytes = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{os.cpu_count()} cores of {name}, {gibibytes:.0f} GiB"


def commit():
    told = subprocess.run(
        ["git", "-C", SOURCE, "describe", "--always", "--dirty"], capture_output=True, text=True, check=False)
    return told.stdout.strip() or "unknown"

"""Measures how often the time gate of `gnomon bench --against` decides correctly.

usage: gate_study.py GNOMON SLOW_FRAMES.so MODEL.gnm PATH.json [--runs N] [--busy N] [--sleep PERCENT]...

The script runs `bench --against` --runs times per row (default: 40). Both sides are the same program, so without
--sleep each failure of the gate is a false alarm. With --sleep, each frame of one side sleeps for PERCENT of the median
frame time (tests/cli/slow_frames.cpp). The gate should fail for a sleep above its limit of 2%. --busy N starts N
processes that use the processor.

Each row states the numbers of failed, passed and undecided gates. It also states the smallest change that even the
least precise run detects.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

BENCH = ("--size", "400x400", "--frames", "30", "--warmup", "2", "--threads", "1", "--shadows", "maps", "--progress", "none")


def median_ms(gnomon, model, path, folder):
    file = folder / "alone.json"
    subprocess.run([gnomon, "bench", model, "--path", path, *BENCH, "--json-file", file], check=True, capture_output=True)
    return json.loads(file.read_text())["benchmarks"][0]["p50"]


def decision(arguments, old, folder, sleep_ms):
    """Runs one comparison. Returns the decision for the median and its smallest detectable change in percent."""
    verdict = folder / "verdict.json"
    environment = {**os.environ, "LD_PRELOAD": str(arguments.library.resolve()), "SLOW_PROGRAM": str(arguments.gnomon.resolve()),
                   "SLOW_MICROSECONDS": str(round(1000 * sleep_ms))}  # fmt: skip
    subprocess.run([arguments.gnomon, "bench", arguments.model, "--path", arguments.path, *BENCH, "--against", old,
                    "--fail-above", "2", "--verdict", verdict], env=environment, capture_output=True)  # fmt: skip
    gates = json.loads(verdict.read_text())["gates"]
    gate = next(gate for gate in gates if gate["quantity"] == "median")
    return gate["decision"], gate["detectable_percent"]


def study(arguments, old, folder, percent):
    sleep_ms = median_ms(arguments.gnomon, arguments.model, arguments.path, folder) * percent / 100
    found = [decision(arguments, old, folder, sleep_ms) for _ in range(arguments.runs)]
    counts = {word: sum(each == word for each, _ in found) for word in ("pass", "fail", "undecided")}
    detectable = max((value for _, value in found if value is not None), default=0)
    print(f"sleep {percent}% ({sleep_ms:.2f} ms), {arguments.busy} busy: {counts['fail']} fail, {counts['pass']} pass, "
          f"{counts['undecided']} undecided of {arguments.runs}; largest detectable change {detectable:.2f}%", flush=True)  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("gnomon", "library", "model", "path"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=40)
    parser.add_argument("--busy", type=int, default=0)
    parser.add_argument("--sleep", type=float, action="append", default=[])
    arguments = parser.parse_args()
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(arguments.busy)]
    try:
        with tempfile.TemporaryDirectory() as place:
            folder = pathlib.Path(place)
            old = folder / "old_gnomon"
            shutil.copy(arguments.gnomon, old)
            for percent in arguments.sleep or [0]:
                study(arguments, old, folder, percent)
    finally:
        for process in busy:
            process.kill()


if __name__ == "__main__":
    main()

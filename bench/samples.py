#!/usr/bin/env python3
"""Measures the error and the time of pictures with 1, 4, 16 and 64 samples per pixel.

usage: bench/samples.py GNOMON [--runs N] "MODEL.gnm[ OPTION...]" ...

OPTIONs are passed to `gnomon render`. The reference picture has 1024 samples per pixel. The script prints one table row
per model. Errors are mean differences over all colour values, in percent of full scale. Times are medians of N runs,
divided by the time of one sample.
"""
import argparse
import pathlib
import statistics
import subprocess
import tempfile
import time

from first_look import read_png

MANY = 1024
FEW = 1, 4, 16, 64


def mean_difference(path, other):
    """Returns the mean difference between two pictures of the same size, in percent of full scale."""
    rows, theirs = read_png(path)[2], read_png(other)[2]
    apart = sum(abs(a - b) for row, their in zip(rows, theirs) for p, q in zip(row, their) for a, b in zip(p, q))
    return 100 * apart / (255 * sum(len(p) for row in rows for p in row))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gnomon")
    parser.add_argument("--runs", type=int, default=5, help="number of runs per picture; the time is their median [5]")
    parser.add_argument("views", nargs="+")
    options = parser.parse_args()
    print(f"| model | {', '.join(map(str, FEW))} samples against {MANY} | times of one: {', '.join(map(str, FEW[1:]))} |")
    for view in options.views:
        model, *arguments = view.split()
        with tempfile.TemporaryDirectory() as folder:

            def picture(samples):
                path = pathlib.Path(folder) / f"{samples}.png"
                command = [options.gnomon, "render", model, "-o", path, "--samples", str(samples), *arguments]
                begin = time.monotonic()
                subprocess.run(command, check=True, capture_output=True)
                return path, time.monotonic() - begin

            many = picture(MANY)[0]
            apart, times = [], []
            for samples in FEW:
                runs = [picture(samples) for _ in range(options.runs)]
                apart.append(mean_difference(runs[0][0], many))
                times.append(statistics.median(seconds for _, seconds in runs))
        shares = ", ".join(f"{a:.3f}%" for a in apart)
        print(f"| {pathlib.Path(model).stem} | {shares} | {', '.join(f'{t / times[0]:.1f}' for t in times[1:])} |", flush=True)


if __name__ == "__main__":
    main()

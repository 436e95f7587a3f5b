#!/usr/bin/env python3
"""Measures the build time, peak memory and file size of models with 10M to 372M triangles.

usage: bench/build_scale.py GNOMON CASE... [--work DIR] [--repetitions R] [--kills N] [--keep]

Cases:
- KIND:TRIANGLES:MEMORY[:ERROR] builds a mesh of `gnomon make`, for example statue:50M:1G or statue:10M:1G:estimated.
- FILE.ply:MEMORY[:ERROR] builds an existing file.
- shuffled:TRIANGLES:MEMORY[:ERROR] builds a statue twice: with vertices in file order, and in random order.
- tiled:COPIES:FILE.ply:MEMORY[:ERROR] builds copies of the file, side by side, as one model. The first properties of
  the vertices must be x, y and z, as little-endian floats.

MEMORY is the memory limit of the build, such as 1G. ERROR is `measured` (default) or another value of --error.

With --kills N, the script builds each case N more times. It kills each build with SIGKILL at a random moment, and
resumes it. All models must have the same content_hash.

The script prints one table row per build. Times are in seconds: the median of the repetitions, and max minus min in
parentheses. Peak memory is the max resident memory of the process (ru_maxrss), in MiB. The exit code is 1 if a
build exceeds its memory limit, or if content hashes differ. It is also 1 if a resumed build leaves temporary files.

A model and its PLY file need up to 19 + 12 bytes of disk per triangle. A build needs up to 40 more. With --keep, the
PLY file stays for the next run.
"""
import argparse
import array
import json
import multiprocessing
import os
import random
import signal
import statistics
import struct
import subprocess
import sys
import time



def read_ply_header(file):
    """Returns the bytes of the header, the number of vertices, and the number of bytes per vertex."""
    header = b""
    while not header.endswith(b"end_header\n"):
        header += file.readline()
    sizes = {"char": 1, "uchar": 1, "short": 2, "ushort": 2, "int": 4, "uint": 4, "float": 4, "double": 8}
    vertices = header.decode().split("element vertex ")[1].split("element ")[0].splitlines()
    return header, int(vertices[0]), sum(sizes[line.split()[1]] for line in vertices[1:] if line.startswith("property"))


def apart(function, *arguments):
    """Runs `function` in a separate process, so that this script uses little memory.

    A build starts as a fork of this script, and its measured peak memory includes the memory of the fork.
    """
    process = multiprocessing.Process(target=function, args=arguments)
    process.start()
    process.join()
    if process.exitcode != 0:
        sys.exit(process.exitcode)


def tile_path(source, folder, copy):
    return os.path.join(folder, f"tile_{copy}_{os.path.basename(source)}")


def tile(source, folder, count):
    """Writes `count` copies of the PLY file `source`, side by side along x, to `folder`."""
    with open(source, "rb") as file:
        header, vertices, size = read_ply_header(file)
        block = file.read(vertices * size)
        faces = file.read()
    xs = [struct.unpack_from("<f", block, at)[0] for at in range(0, len(block), size)]
    width = 1.01 * (max(xs) - min(xs))
    for copy in range(count):
        moved = bytearray(block)
        for i, x in enumerate(xs):
            struct.pack_into("<f", moved, i * size, x + copy * width)
        with open(tile_path(source, folder, copy), "wb") as file:
            file.write(header + moved + faces)


def shuffle_vertices(source, target, seed=1):
    """Writes the PLY file `source` (by `gnomon make`) to `target`, with the vertices in random order."""
    with open(source, "rb") as file:
        header, count, _ = read_ply_header(file)
        vertices = file.read(12 * count)
        faces = bytearray(file.read())
    order = array.array("I", range(count))
    generator = random.Random(seed)
    generator.shuffle(order)
    moved = bytearray(len(vertices))
    for old, new in enumerate(order):
        moved[12 * new:12 * new + 12] = vertices[12 * old:12 * old + 12]
    for row in range(0, len(faces), 13):
        corners = array.array("I", faces[row + 1:row + 13])
        faces[row + 1:row + 13] = array.array("I", (order[corner] for corner in corners)).tobytes()
    with open(target, "wb") as file:
        file.write(header)
        file.write(moved)
        file.write(faces)


def build(gnomon, sources, target, memory, error, extra=()):
    """Runs a build. Returns its report, wall-clock seconds, peak memory in bytes, and processor seconds."""
    command = [gnomon, "build", *sources, "-o", target, "--memory", memory, "--error", error, "--json",
               "--progress", "none", *extra]
    start = time.monotonic()
    process = subprocess.Popen(command, stdout=subprocess.PIPE)
    output = process.stdout.read()
    _, status, usage = os.wait4(process.pid, 0)
    seconds = time.monotonic() - start
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        sys.exit(f"build_scale: {' '.join(command)} ended with {process.returncode}")
    return json.loads(output), seconds, usage.ru_maxrss * 1024, usage.ru_utime + usage.ru_stime


def kill_and_resume(gnomon, sources, target, memory, error, seconds, kills, expected):
    """Kills `kills` builds at random moments within `seconds`, and resumes each one to its end.

    Returns true if all models have the content_hash `expected`.
    """
    generator = random.Random(7)
    different = 0
    resumed = 0
    for _ in range(kills):
        if os.path.exists(target):
            os.remove(target)
        command = [gnomon, "build", *sources, "-o", target, "--memory", memory, "--error", error, "--progress", "none",
                   "--resume"]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL)
        time.sleep(generator.uniform(0, seconds))
        if process.poll() is None:
            process.send_signal(signal.SIGKILL)
            resumed += 1
        process.wait()
        report, _, _, _ = build(gnomon, sources, target, memory, error, ["--resume"])
        different += report["content_hash"] != expected
        left = [name for name in os.listdir(os.path.dirname(target)) if name.startswith(os.path.basename(target) + ".")]
        if left:
            sys.exit(f"build_scale: left behind: {left}")
    print(f"{kills} builds, {resumed} killed and resumed: {different} with another content_hash", flush=True)
    return different == 0


def models_of(case, options):
    """Makes the source files of a case. Returns them, and the remaining words of the case (memory and error).

    The first result is a list with one entry per build: the source files, and true if the script must remove them.
    """
    words = case.split(":")
    if words[0].endswith(".ply"):
        models = [([words[0]], False)]
        rest = words[1:]
    elif words[0] == "tiled":
        apart(tile, words[2], options.work, int(words[1]))
        models = [([tile_path(words[2], options.work, copy) for copy in range(int(words[1]))], True)]
        rest = words[3:]
    else:
        kind = "statue" if words[0] == "shuffled" else words[0]
        plain = os.path.join(options.work, f"{kind}_{words[1]}.ply")
        if not os.path.exists(plain):
            subprocess.run([options.gnomon, "make", kind, "--triangles", words[1], "-o", plain, "--progress",
                            "none"], check=True, stdout=subprocess.DEVNULL)
        models = [([plain], not options.keep)]
        if words[0] == "shuffled":
            mixed = os.path.join(options.work, f"shuffled_{words[1]}.ply")
            if not os.path.exists(mixed):
                apart(shuffle_vertices, plain, mixed)
            models.append(([mixed], not options.keep))
        rest = words[2:]
    return models, rest


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gnomon")
    parser.add_argument("cases", nargs="+")
    parser.add_argument("--work", default="build_scale_work", help="a folder with room for the models")
    parser.add_argument("--repetitions", type=int, default=1)
    parser.add_argument("--kills", type=int, default=0)
    parser.add_argument("--keep", action="store_true")
    options = parser.parse_args()
    os.makedirs(options.work, exist_ok=True)
    print("| case | memory | seconds (spread) | M triangles/s | cores busy | peak MiB | temporary B/tri | B/tri | "
          "coarsest | stuck | content_hash |\n|---|---|---|---|---|---|---|---|---|---|---|", flush=True)
    good = True
    for case in options.cases:
        models, rest = models_of(case, options)
        memory = rest[0]
        error = rest[1] if len(rest) > 1 else "measured"
        for sources, is_made in models:
            target = os.path.join(options.work, "model.gnm")
            runs = [build(options.gnomon, sources, target, memory, error) for _ in range(options.repetitions)]
            report = runs[0][0]
            seconds = statistics.median(run[1] for run in runs)
            spread = max(run[1] for run in runs) - min(run[1] for run in runs)
            triangles = report["source_triangles"]
            peak = max(run[2] for run in runs)
            good = good and peak <= parse_memory(memory) and len({run[0]["content_hash"] for run in runs}) == 1
            print(f"| {os.path.basename(sources[0])} {error} | {memory} | {seconds:.1f} ({spread:.1f}) "
                  f"| {triangles / seconds / 1e6:.3f} | {runs[0][3] / runs[0][1]:.2f} | {peak / 2**20:.0f} "
                  f"| {report['temporary_bytes'] / triangles:.1f} | {report['bytes_per_source_triangle']:.2f} "
                  f"| {report['coarsest_triangles']} | {100 * report['stuck_triangles'] / triangles:.2f}% "
                  f"| {report['content_hash']} |", flush=True)
            for phase in report["phases"]:
                print(f"    {phase['name']}: {phase['seconds']:.1f} s, read {phase['bytes_read'] / 2**20:.0f} MiB, "
                      f"wrote {phase['bytes_written'] / 2**20:.0f} MiB", file=sys.stderr)
            if options.kills > 0:
                good = kill_and_resume(options.gnomon, sources, target, memory, error, seconds, options.kills,
                                       report["content_hash"]) and good
            os.remove(target)
            for source in sources if is_made else []:
                os.remove(source)
    sys.exit(0 if good else 1)


def parse_memory(text):
    return int(float(text[:-1]) * {"K": 2**10, "M": 2**20, "G": 2**30}[text[-1].upper()])


if __name__ == "__main__":
    main()

"""Holds the model of docs/many_machines.md against jobs on one machine whose processes have slow disks.

usage: many_machines.py [--mesh MESH] [--chunk-triangles N] [--rate SIZE] [--processes N,...] [--repetitions R] [-o FILE.json]

One build by one process gives the times of the phases and the bytes that they read and write; from these the model
tells how long N processes take that read and write `rate` bytes a second of temporary files each. Then N do.
$GNOMON and $GNOMON_MPI are the programs.
"""
import argparse
import json
import math
import pathlib
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests" / "mpi"))
from job import alone, run  # noqa: E402

UNITS = {"K": 1 << 10, "M": 1 << 20, "G": 1 << 30}


def scratch_bytes(phase, told, mesh_bytes):
    """Read and written of temporary files, without the source and the output."""
    read = phase["bytes_read"] - (mesh_bytes if phase["name"] in ("count", "bin") else 0)
    written = phase["bytes_written"] - (told["file_bytes"] if phase["name"] == "write" else 0)
    return max(read, 0), max(written, 0)


def predicted(told, mesh_bytes, processes, rate, cores):
    """Seconds: each task computes and then waits for its bytes; a phase lasts as long as its busiest process, and no
    more processes compute at a time than there are cores. What tasks have counted, rank 0 reads alone."""
    seconds = 0
    for phase in told["phases"]:
        read, written = scratch_bytes(phase, told, mesh_bytes)
        alone = read if phase["name"] == "count" or phase["tasks"] == 0 else 0
        tasks = max(phase["tasks"], 1)
        share = math.ceil(tasks / processes) / tasks
        seconds += (alone + share * (read - alone + written)) / rate
        seconds += max(share, 1 / cores if tasks > 1 else 1) * phase["seconds"]
    return seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mesh", type=pathlib.Path)
    parser.add_argument("--chunk-triangles", type=int, default=65536)
    parser.add_argument("--rate", default="8M")
    parser.add_argument("--processes", default="1,2,4,8")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--cores", type=int, default=2)
    parser.add_argument("-o", "--output", type=pathlib.Path)
    given = parser.parse_args()
    rate = int(given.rate[:-1]) * UNITS[given.rate[-1]]
    rows = []
    with tempfile.TemporaryDirectory(prefix="gnomon_machines_") as name:
        folder = pathlib.Path(name)
        mesh = given.mesh or folder / "statue.ply"
        if not given.mesh:
            alone("make", "statue", "--triangles", "1M", "-o", mesh)
        words = ("build", mesh, "-o", folder / "m.gnm", "--json", "--threads", "1", "--chunk-triangles", given.chunk_triangles)
        # By one process of MPI, which also counts tasks.
        told = min((json.loads(run(1, *words).stdout) for _ in range(given.repetitions)), key=lambda row: row["seconds"])
        for processes in map(int, given.processes.split(",")):
            expected = predicted(told, mesh.stat().st_size, processes, rate, given.cores)
            runs = [json.loads(run(processes, *words, "--scratch-rate", given.rate).stdout) for _ in range(given.repetitions)]
            assert all(row["content_hash"] == told["content_hash"] for row in runs)
            measured = statistics.median(row["seconds"] for row in runs)
            rows.append({"processes": processes, "predicted": expected, "measured": measured})
            print(f"{processes} processes: predicted {expected:.1f} s, measured {measured:.1f} s, "
                  f"{100 * (expected / measured - 1):+.0f}%", flush=True)  # fmt: skip
    if given.output:
        given.output.write_text(json.dumps({"rate": rate, "rows": rows, "one": told}, indent=1))


if __name__ == "__main__":
    main()

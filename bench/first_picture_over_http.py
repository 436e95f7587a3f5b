"""Measures the time until a model on a slow HTTP server appears, and until its picture is complete.

usage: first_picture_over_http.py GNOMON MODEL.gnm... [--mbit F] [--latency-ms F] [--seconds N] [--size WxH]

The server (tests/hierarchy/source/range_server.py) runs on this machine. It limits the bandwidth to --mbit megabits per
second (default: 10), and delays each answer by --latency-ms milliseconds (default: 50). The client has no cache.
The camera path has --seconds seconds (default: 30) with 5 frames each. The camera does not move, and frames do not wait
for pages.

The script prints per model:
- seconds from program start to the first picture, and to the first picture without missing pages
- megabytes that the server sent during the whole run, and triangles of the last picture
- the error in pixels of about eight pictures before the complete one
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests/hierarchy/source"))
from range_server import RangeServer  # noqa: E402


def still_path(gnomon, model, folder, seconds):
    """Writes a camera path that stays at the first view of an orbit for `seconds`, and returns its file."""
    orbit, still = folder / "orbit.json", folder / "still.json"
    subprocess.run([gnomon, "path", model, "--kind", "orbit", "-o", orbit], check=True, capture_output=True)
    first = json.loads(orbit.read_text())["keyframes"][0]
    still.write_text(json.dumps({"loop": False, "interpolation": "linear",
                                 "keyframes": [{**first, "time": 0}, {**first, "time": seconds}]}))
    return still


def watch(gnomon, model, options):
    with tempfile.TemporaryDirectory() as place, RangeServer(model.parent) as server:
        place = pathlib.Path(place)
        path = still_path(gnomon, model, place, options.seconds)
        server.faults.mbit, server.faults.latency = options.mbit, options.latency_ms / 1000
        rows = place / "rows.csv"
        subprocess.run(
            [gnomon, "bench", server.address(model.name), "--path", path, "--frames", str(options.seconds * 5),
             "--warmup", "0", "--no-wait", "--http-cache", "0", "--size", options.size, "--csv", rows],
            check=True, stdout=subprocess.DEVNULL, env={**os.environ, "NO_PROXY": "127.0.0.1", "no_proxy": "127.0.0.1"})
        with open(rows, newline="") as file:
            return list(csv.DictReader(file)), server.body_bytes


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("gnomon")
    parser.add_argument("models", nargs="+", type=pathlib.Path)
    parser.add_argument("--mbit", type=float, default=10)
    parser.add_argument("--latency-ms", type=float, default=50)
    parser.add_argument("--seconds", type=int, default=30)
    parser.add_argument("--size", default="800x800")
    options = parser.parse_args()
    for model in options.models:
        rows, sent = watch(options.gnomon, model.resolve(), options)
        seconds = [float(row["since_start_ms"]) / 1000 for row in rows]
        errors = [float(row["achieved_error_pixels"]) for row in rows]
        done = next((i for i, row in enumerate(rows) if int(row["pages_missing"]) == 0), None)
        complete = "not complete" if done is None else f"complete after {seconds[done]:.1f} s"
        print(f"{model.name}: first picture after {seconds[0]:.1f} s, {complete}, {sent / 1e6:.1f} MB sent, "
              f"{rows[-1]['image_triangles']} triangles")
        print("  error in pixels: " + ", ".join(f"{errors[i]:.3g} at {seconds[i]:.1f} s" for i in range(
            0, len(rows) if done is None else done + 1, max(1, (done or len(rows)) // 8))))


if __name__ == "__main__":
    main()

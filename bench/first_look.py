#!/usr/bin/env python3
"""Measures exposure, contrast and framing of the default picture of a model.

usage: bench/first_look.py GNOMON [--bars] [--out FOLDER] "MODEL.gnm[ OPTION...]" ...

OPTIONs are passed to `gnomon render`. The script prints one line per picture:
- covered: fraction of the pixels that show the model
- dark, burnt: fractions of the model's pixels with a luma below 5% or above 95% of full scale
- mean, dev: mean and standard deviation of the luma
- fill: larger fraction of the picture's width or height that the model covers
- centre: x and y of the model's centre, as fractions of the picture

With --bars, the exit code is 1 if more than 5% of the model is dark or burnt. It is also 1 if the model fills less than
85% or more than 90% of the picture. The rule for the fill does not apply to OPTIONs with --camera or --eye.
"""
import argparse
import array
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

MIN_VALUE, MAX_VALUE = 0.05 * 255, 0.95 * 255  # shapes are hardly visible in darker or brighter pixels
FRAMED = 0.85, 0.90  # min and max fraction of the picture's width or height that a default view fills


def read_png(path):
    """Returns width, height and rows of an 8-bit RGB or RGBA picture. Each pixel is a list of three levels."""
    data = path.read_bytes()
    width, height, depth, kind = struct.unpack(">IIBB", data[16:26])
    channels = {2: 3, 6: 4}[kind]
    assert depth == 8, "only 8-bit pictures are written"
    packed, at = b"", 8
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at : at + 8])
        packed += data[at + 8 : at + 8 + size] if name == b"IDAT" else b""
        at += 12 + size
    raw = zlib.decompress(packed)
    rows, before, stride = [], bytearray(width * channels), width * channels
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for x in range(stride):
            left = row[x - channels] if x >= channels else 0
            up, corner = before[x], before[x - channels] if x >= channels else 0
            if kind == 1:
                row[x] = (row[x] + left) & 255
            elif kind == 2:
                row[x] = (row[x] + up) & 255
            elif kind == 3:
                row[x] = (row[x] + (left + up) // 2) & 255
            elif kind == 4:
                guess = left + up - corner
                apart = abs(guess - left), abs(guess - up), abs(guess - corner)
                row[x] = (row[x] + (left, up, corner)[apart.index(min(apart))]) & 255
        rows.append(row)
        before = row
    return width, height, [[row[i : i + 3] for i in range(0, stride, channels)] for row in rows]


def read_pfm(path):
    """Returns the rows of a little-endian PFM file with one channel, from top to bottom."""
    data = path.read_bytes()
    width, height = (int(word) for word in data.split(b"\n", 3)[1].split())
    values = array.array("f", data[-4 * width * height :])
    return [values[y * width : (y + 1) * width] for y in reversed(range(height))]


def measure(picture, depth):
    """Returns exposure, contrast and framing of a model in `picture`. Its pixels have a finite value in `depth`."""
    width, height, rows = read_png(picture)
    light, columns, lines = [], set(), set()
    for y, (colors, depths) in enumerate(zip(rows, read_pfm(depth))):
        for x, (color, z) in enumerate(zip(colors, depths)):
            if math.isfinite(z):
                light.append(0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2])
                columns.add(x)
                lines.add(y)
    count = max(len(light), 1)
    mean = sum(light) / count
    fill = max((max(s) - min(s) + 1) / size for s, size in ((columns, width), (lines, height))) if light else 0
    middle = [(min(s) + max(s) + 1) / 2 / size for s, size in ((columns, width), (lines, height))] if light else [0, 0]
    return {
        "covered": count / (width * height),
        "dark": sum(value < MIN_VALUE for value in light) / count,
        "burnt": sum(value > MAX_VALUE for value in light) / count,
        "mean": mean / 255,
        "deviation": math.sqrt(sum((value - mean) ** 2 for value in light) / count) / 255,
        "fill": fill,
        "x": middle[0],
        "y": middle[1],
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("gnomon", type=pathlib.Path)
    parser.add_argument("models", nargs="+", help="MODEL.gnm, or 'MODEL.gnm OPTION ...' for `gnomon render`")
    parser.add_argument("--bars", action="store_true", help="exit with code 1 if a picture fails a limit")
    parser.add_argument("--out", type=pathlib.Path, help="store the pictures in this folder")
    options = parser.parse_args()
    missed = []
    print(f"{'picture':28} covered    dark   burnt    mean     dev    fill  centre")
    with tempfile.TemporaryDirectory() as scratch:
        folder = options.out or pathlib.Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        for model in options.models:
            path, *more = model.split(" ")
            name = pathlib.Path(path).stem + "".join(more).replace("/", "_").replace("--", "_")
            picture, depth = folder / f"{name[:60]}.png", pathlib.Path(scratch) / "depth.pfm"
            subprocess.run([options.gnomon, "render", path, "-o", picture, "--depth", depth, *more], check=True)
            found = measure(picture, depth)
            print(f"{name[:28]:28} {found['covered']:7.1%} {found['dark']:7.2%} {found['burnt']:7.2%} {found['mean']:7.1%} "
                  f"{found['deviation']:7.1%} {found['fill']:7.1%} {found['x']:.3f} {found['y']:.3f}", flush=True)  # fmt: skip
            if found["dark"] + found["burnt"] > 0.05:
                missed.append(f"{name}: {found['dark'] + found['burnt']:.1%} of the model is black or burnt out")
            if not {"--camera", "--eye"} & set(more) and not FRAMED[0] <= found["fill"] <= FRAMED[1]:
                missed.append(f"{name}: fills {found['fill']:.1%} of the picture")
    if options.bars and missed:
        sys.exit("\n".join(missed))


if __name__ == "__main__":
    main()

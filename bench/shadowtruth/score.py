#!/usr/bin/env python3
"""Scores shadow masks of any renderer against the shadowtruth set.

usage: score.py TRUTH MASK       two PNG files, or two folders with PNG files of the same names

TRUTH is the folder of the set, or one of its PNG files. A mask has the same size, with 8 bits per channel. A pixel is
lit if its first channel is 128 or more. docs/shadowtruth.md defines the columns of the output. The script needs numpy.
"""
import pathlib
import struct
import sys
import zlib

import numpy as np

LIT, DARK, THRESHOLD = 255, 0, 128
COLUMNS = ("case", "judged", "wrong", "false", "missed", "leaked", "wrong_%", "edge_p50", "edge_p99")


def unfiltered(kind, row, above, step):
    """Returns a row of a PNG without the filter `kind`. `above` is the row above, and `step` the bytes per pixel."""
    if kind == 0:
        return row
    if kind == 2:
        return row + above
    if kind == 1:
        return np.cumsum(row.reshape(-1, step), axis=0, dtype=np.uint8).reshape(-1)
    if kind not in (3, 4):
        raise ValueError(f"expected a filter from 0 to 4, found {kind}")
    out, up = bytearray(row.tobytes()), above.tobytes()
    for i in range(len(out)):
        a, b, c = (out[i - step] if i >= step else 0), up[i], (up[i - step] if i >= step else 0)
        if kind == 3:
            guess = (a + b) // 2
        else:
            p, q, r = abs(b - c), abs(a - c), abs(a + b - 2 * c)
            guess = a if p <= q and p <= r else b if q <= r else c
        out[i] = (out[i] + guess) & 255
    return np.frombuffer(bytes(out), np.uint8)


def read_png(path):
    """Returns the first channel of an 8-bit PNG as an array. Raises ValueError for a palette or interlace."""
    data = pathlib.Path(path).read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise ValueError(f"{path}: expected a PNG")
    place, packed, head = 8, b"", None
    while place + 12 <= len(data):
        length, kind = struct.unpack_from(">I4s", data, place)
        body = data[place + 8 : place + 8 + length]
        if kind == b"IHDR":
            head = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        place += 12 + length
    channels = {0: 1, 2: 3, 4: 2, 6: 4}
    if head is None or head[2] != 8 or head[3] not in channels or head[6]:
        raise ValueError(f"{path}: expected 8 bits per channel, no palette and no interlace, found {head}")
    width, height, step = head[0], head[1], channels[head[3]]
    try:
        raw = np.frombuffer(zlib.decompress(packed), np.uint8)
    except zlib.error as error:
        raise ValueError(f"{path}: {error}") from error
    if raw.size != height * (1 + width * step):
        raise ValueError(f"{path}: expected {height * (1 + width * step)} bytes, found {raw.size}")
    rows, above = raw.reshape(height, -1), np.zeros(width * step, np.uint8)
    picture = np.empty((height, width), np.uint8)
    for y in range(height):
        above = unfiltered(int(rows[y, 0]), rows[y, 1:], above, step)
        picture[y] = above[::step]
    return picture


def shifted(values, dy, dx, fill):
    """Returns `values` moved so that entry (y, x) is the old entry (y + dy, x + dx), with `fill` outside."""
    out = np.full_like(values, fill)
    h, w = values.shape
    out[max(-dy, 0) : h - max(dy, 0), max(-dx, 0) : w - max(dx, 0)] = values[max(dy, 0) : h + min(dy, 0), max(dx, 0) : w + min(dx, 0)]
    return out


def regions(inside):
    """Returns the label of the 8-connected region of each pixel of the mask `inside`, or -1 outside of the mask."""
    outside = inside.size
    label = np.where(inside, np.arange(outside).reshape(inside.shape), outside)
    while True:
        least = label
        for dy in (-1, 0, 1):
            for dx in (-1, 0, 1):
                least = np.minimum(least, shifted(label, dy, dx, outside))
        least = np.where(inside, least, outside)
        least = np.append(least.ravel(), outside)[least]  # each label becomes the label of the pixel with this index
        if np.array_equal(least, label):
            return np.where(inside, label, -1)
        label = least


def edges(lit, judged):
    """Returns the mask of edges: judged pixels next to a judged pixel (of four neighbours) with the other result."""
    found = np.zeros_like(judged)
    for dy, dx in ((0, 1), (1, 0), (0, -1), (-1, 0)):
        found |= judged & shifted(judged, dy, dx, False) & (lit != shifted(lit, dy, dx, False))
    return found


def distances(marked, at):
    """Returns the distance from each pixel of the mask `at` to the nearest pixel of the mask `marked`, in pixels.

    If no pixel is marked, the distance is the diagonal of the image.
    """
    h, w = marked.shape
    y, x = np.nonzero(at)
    if not marked.any():
        return np.full(y.size, np.hypot(h, w))
    rows, far = np.arange(h)[:, None], 4 * (h + w)
    last = np.maximum.accumulate(np.where(marked, rows, -far), axis=0)
    after = np.minimum.accumulate(np.where(marked, rows, far)[::-1], axis=0)[::-1]
    column = np.pad(np.minimum(rows - last, after - rows).astype(np.int64) ** 2, ((0, 0), (w, w)), constant_values=far * far)
    best = column[y, x + w]
    for dx in range(1, w):
        if y.size == 0 or dx * dx >= best.max():
            break
        best = np.minimum(best, np.minimum(column[y, x + w - dx], column[y, x + w + dx]) + dx * dx)
    return np.sqrt(best)


def score(truth, mask):
    """Returns the counts of a mask, and the distances of edge pixels. `truth` and `mask` are arrays of grey levels."""
    if truth.shape != mask.shape:
        raise ValueError(f"expected a mask of {truth.shape[1]}x{truth.shape[0]} pixels, found {mask.shape[1]}x{mask.shape[0]}")
    judged = (truth == LIT) | (truth == DARK)
    dark, lit = truth == DARK, mask >= THRESHOLD
    label = regions(dark)
    drawn = np.zeros(truth.size, bool)
    drawn[label[dark & ~lit]] = True  # regions of the true shadow with a dark pixel in the mask
    light = dark & lit
    missed = light & ~drawn[label]
    false = judged & ~dark & ~lit
    true_edges, mask_edges = edges(~dark, judged), edges(lit, judged)
    apart = np.concatenate([distances(mask_edges, true_edges), distances(true_edges, mask_edges)])
    counts = {"judged": judged, "wrong": light | false, "false": false, "missed": missed, "leaked": light & ~missed}
    return {name: int(pixels.sum()) for name, pixels in counts.items()}, apart


def percentile(values, share):
    """Returns the percentile of `values` at `share` (0 to 1, nearest rank), or 0 if there are no values."""
    return 0.0 if values.size == 0 else float(np.sort(values)[max(int(np.ceil(share * values.size)) - 1, 0)])


def line(name, counts, apart):
    wrong = 100 * counts["wrong"] / counts["judged"] if counts["judged"] else 0
    return [name, *(counts[c] for c in COLUMNS[1:6]), f"{wrong:.4f}", f"{percentile(apart, 0.5):.2f}", f"{percentile(apart, 0.99):.2f}"]


def score_all(pairs):
    """Returns one table row per pair (name, truth, mask), and a row for all pairs together."""
    total, everything, lines = dict.fromkeys(COLUMNS[1:6], 0), [], []
    for name, truth, mask in pairs:
        counts, apart = score(read_png(truth), read_png(mask))
        lines.append(line(name, counts, apart))
        everything.append(apart)
        total = {c: total[c] + counts[c] for c in total}
    return lines, line("all", total, np.concatenate(everything))


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    truth, mask = map(pathlib.Path, sys.argv[1:])
    names = sorted(p.name for p in truth.glob("*.png")) if truth.is_dir() else [truth.name]
    pairs = [(n[:-4], truth / n, mask / n) if truth.is_dir() else (n[:-4], truth, mask) for n in names]
    try:
        if not pairs:
            raise ValueError(f"{truth}: expected PNG files, found none")
        lines, total = score_all(pairs)
    except (OSError, ValueError, struct.error) as error:
        sys.exit(f"score.py: {error}")
    for row in [COLUMNS, *lines, *([total] if len(lines) > 1 else [])]:
        print("\t".join(map(str, row)))


if __name__ == "__main__":
    main()

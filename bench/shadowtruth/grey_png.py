"""Reads and writes PNG files with the Python standard library, for grey masks."""
import pathlib
import struct
import zlib


def chunk(kind, body):
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def paeth(a, b, c):
    p, q, r = abs(b - c), abs(a - c), abs(a + b - 2 * c)
    return a if p <= q and p <= r else b if q <= r else c


def predicted(kind, a, b, c):
    """Returns the prediction of PNG filter `kind` from the bytes `a` (left), `b` (above) and `c` (above left)."""
    return (0, a, b, (a + b) // 2, paeth(a, b, c))[kind]


def write_png(path, width, pixels, channels=1, filters=False):
    """Writes `pixels` (bytes, rows from top to bottom) as an 8-bit PNG.

    If `filters` is true, the rows use the five PNG filters in turn.
    """
    step, stride = channels, width * channels
    rows = [pixels[i : i + stride] for i in range(0, len(pixels), stride)]
    packed, above = b"", bytes(stride)
    for y, row in enumerate(rows):
        kind = y % 5 if filters else 0
        left, corner = bytes(step) + row[:-step], bytes(step) + above[:-step]
        packed += bytes([kind]) + bytes((row[i] - predicted(kind, left[i], above[i], corner[i])) & 255 for i in range(stride))
        above = row
    head = struct.pack(">IIBBBBB", width, len(rows), 8, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    pathlib.Path(path).write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(packed)) + chunk(b"IEND", b""))


def read_grey(path):
    """Returns the first channel of an 8-bit PNG, as a list of rows of grey levels."""
    data, place, packed = pathlib.Path(path).read_bytes(), 8, b""
    while place < len(data):
        length, kind = struct.unpack_from(">I4s", data, place)
        body = data[place + 8 : place + 8 + length]
        if kind == b"IHDR":
            width, height, _, colour = struct.unpack_from(">IIBB", body)
        elif kind == b"IDAT":
            packed += body
        place += 12 + length
    raw, step = zlib.decompress(packed), {0: 1, 2: 3, 6: 4}[colour]
    stride, rows, above = width * step, [], bytes(width * step)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for i in range(stride if kind else 0):
            left, corner = (row[i - step], above[i - step]) if i >= step else (0, 0)
            row[i] = (row[i] + predicted(kind, left, above[i], corner)) & 255
        rows.append(list(row[::step]))
        above = bytes(row)
    return rows

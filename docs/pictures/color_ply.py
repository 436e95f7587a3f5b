"""Copies a PLY of `gnomon make` and gives each vertex the colour of stone in layers.

usage: color_ply.py IN.ply OUT.ply
"""
import math
import pathlib
import struct
import sys

data = pathlib.Path(sys.argv[1]).read_bytes()
end = data.index(b"end_header\n") + len(b"end_header\n")
header = data[:end].decode()
vertices = int(header.split("element vertex ")[1].split()[0])
properties = header.split("element vertex ")[1].split("element face")[0].count("property float")
stride = 4 * properties
header = header.replace("element face", "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face")
heights = [struct.unpack_from("<f", data, end + stride * v + 4)[0] for v in range(vertices)]
low, high = min(heights), max(heights)
LIGHT, DARK = (226, 205, 170), (150, 92, 66)
with open(sys.argv[2], "wb") as file:
    file.write(header.encode())
    for v in range(vertices):
        row = data[end + stride * v:end + stride * (v + 1)]
        x, y, z = struct.unpack_from("<3f", row)
        height = 9 * (y - low) / (high - low)
        share = 0.5 + 0.5 * math.sin(2 * math.pi * (height + 0.35 * math.sin(7 * x / (high - low) + 5 * z / (high - low))))
        file.write(row + bytes(round(a + share * (b - a)) for a, b in zip(DARK, LIGHT)))
    file.write(data[end + stride * vertices:])

"""Makes meshes of which the up direction is known, with z up: furniture, rooms, buildings, cities, terrains, vehicles,
plants, characters. `shapes.py FOLDER [--seeds N]` writes FOLDER/KIND_SEED.ply for each kind and seed."""

import argparse
import json
import math
import pathlib
import random
import subprocess


class Mesh:
    def __init__(self):
        self.vertices = []
        self.faces = []

    def face(self, *points):
        first = len(self.vertices)
        self.vertices.extend(points)
        for i in range(1, len(points) - 1):
            self.faces.append((first, first + i, first + i + 1))

    def box(self, x0, y0, z0, x1, y1, z1):
        p = [(x, y, z) for z in (z0, z1) for y in (y0, y1) for x in (x0, x1)]
        for a, b, c, d in ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)):
            self.face(p[a], p[b], p[c], p[d])

    def revolve(self, x, y, profile, sides=24):
        """Turns `profile`, pairs of radius and height from bottom to top, around the vertical through x, y."""
        ring = [(math.cos(2 * math.pi * i / sides), math.sin(2 * math.pi * i / sides)) for i in range(sides)]
        for (r0, z0), (r1, z1) in zip(profile, profile[1:]):
            for (c0, s0), (c1, s1) in zip(ring, ring[1:] + ring[:1]):
                a, b = (x + r0 * c0, y + r0 * s0, z0), (x + r0 * c1, y + r0 * s1, z0)
                c, d = (x + r1 * c1, y + r1 * s1, z1), (x + r1 * c0, y + r1 * s0, z1)
                if r0 > 0:
                    self.face(a, b, c)
                if r1 > 0:
                    self.face(a, c, d)

    def tube(self, a, b, radius, sides=10):
        """A closed cylinder from point a to point b."""
        axis = [b[i] - a[i] for i in range(3)]
        length = math.sqrt(sum(v * v for v in axis))
        w = [v / length for v in axis]
        h = (1, 0, 0) if abs(w[0]) < 0.9 else (0, 1, 0)
        u = cross(w, h)
        n = math.sqrt(sum(v * v for v in u))
        u = [v / n for v in u]
        v = cross(w, u)
        rim = [[radius * (math.cos(t) * u[i] + math.sin(t) * v[i]) for i in range(3)]
               for t in (2 * math.pi * k / sides for k in range(sides))]
        for p, q in zip(rim, rim[1:] + rim[:1]):
            a0, a1 = add(a, p), add(a, q)
            b0, b1 = add(b, p), add(b, q)
            self.face(a0, a1, b1, b0)
            self.face(a, a1, a0)
            self.face(b, b0, b1)

    def ball(self, x, y, z, rx, ry, rz, sides=16):
        def point(i, j):
            t, p = 2 * math.pi * i / sides, math.pi * (j / (sides // 2) - 0.5)
            return (x + rx * math.cos(t) * math.cos(p), y + ry * math.sin(t) * math.cos(p), z + rz * math.sin(p))
        for j in range(sides // 2):
            for i in range(sides):
                self.face(point(i, j), point(i + 1, j), point(i + 1, j + 1))
                self.face(point(i, j), point(i + 1, j + 1), point(i, j + 1))

    def heights(self, n, width, depth, height):
        """An open sheet of n x n squares; height(u, v) for u, v from 0 to 1."""
        def point(i, j):
            return (width * i / n, depth * j / n, height(i / n, j / n))
        for j in range(n):
            for i in range(n):
                self.face(point(i, j), point(i + 1, j), point(i + 1, j + 1))
                self.face(point(i, j), point(i + 1, j + 1), point(i, j + 1))

    def write(self, path, turned=lambda p: p):
        with open(path, "w", encoding="ascii") as out:
            out.write("ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\nproperty float z\n"
                      "element face %d\nproperty list uchar int vertex_indices\nend_header\n"
                      % (len(self.vertices), len(self.faces)))
            for p in self.vertices:
                out.write("%.7g %.7g %.7g\n" % tuple(turned(p)))
            for f in self.faces:
                out.write("3 %d %d %d\n" % f)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def add(a, b):
    return [a[i] + b[i] for i in range(3)]


def table(m, r, x=0.0, y=0.0, z=0.0, s=1.0):
    w, d, h = s * r.uniform(0.8, 2), s * r.uniform(0.6, 1.1), s * r.uniform(0.65, 0.8)
    t, leg = s * r.uniform(0.02, 0.06), s * r.uniform(0.03, 0.09)
    m.box(x, y, z + h - t, x + w, y + d, z + h)
    for lx in (x, x + w - leg):
        for ly in (y, y + d - leg):
            m.box(lx, ly, z, lx + leg, ly + leg, z + h - t)


def chair(m, r, x=0.0, y=0.0, z=0.0):
    w, h, top = r.uniform(0.4, 0.5), r.uniform(0.42, 0.48), r.uniform(0.85, 1.1)
    leg = r.uniform(0.03, 0.05)
    m.box(x, y, z + h - 0.05, x + w, y + w, z + h)
    for lx in (x, x + w - leg):
        for ly in (y, y + w - leg):
            m.box(lx, ly, z, lx + leg, ly + leg, z + (top if ly > y else h - 0.05))
    m.box(x, y + w - leg, z + top - 0.35, x + w, y + w, z + top)


def round_table(m, r):
    h, w = r.uniform(0.7, 0.8), r.uniform(0.4, 0.7)
    m.revolve(0, 0, [(0, 0), (0.6 * w, 0), (0.5 * w, 0.04), (0.05, 0.08), (0.05, h - 0.04), (w, h - 0.04), (w, h), (0, h)])


def room(m, r):
    w, d, h, t = r.uniform(3, 8), r.uniform(3, 6), r.uniform(2.4, 3.2), r.uniform(0.05, 0.3)
    m.box(0, 0, -t, w, d, 0)
    m.box(0, 0, 0, w, t, h)
    m.box(0, d - t, 0, w, d, h)
    m.box(0, 0, 0, t, d, h)
    if r.random() < 0.5:
        m.box(w - t, 0, 0, w, d, h)
    for _ in range(r.randint(1, 4)):
        table(m, r, r.uniform(t, w - 2), r.uniform(t, d - 1.5))
        chair(m, r, r.uniform(t, w - 1), r.uniform(t, d - 1))
    m.box(t, t, 0, t + 1.2, t + 0.5, r.uniform(0.8, 2))


def floors(m, r):
    w, d, n = r.uniform(10, 40), r.uniform(10, 25), r.randint(2, 8)
    for i in range(n + 1):
        m.box(0, 0, 3 * i, w, d, 3 * i + 0.3)
    for x in (0.5, w / 2, w - 1):
        for y in (0.5, d - 1):
            m.box(x, y, 0, x + 0.5, y + 0.5, 3 * n)


def shelf(m, r):
    w, d, h, n = r.uniform(0.6, 1.2), r.uniform(0.25, 0.4), r.uniform(1.2, 2.2), r.randint(3, 6)
    for x in (0, w - 0.03):
        m.box(x, 0, 0, x + 0.03, d, h)
    for i in range(n):
        z = 0.08 + (h - 0.11) * i / (n - 1)
        m.box(0.03, 0, z, w - 0.03, d, z + 0.03)
        x = 0.05
        while i + 1 < n and x < w - 0.2:
            t, tall = r.uniform(0.02, 0.06), r.uniform(0.12, 0.22)
            m.box(x, 0.02, z + 0.03, x + t, d - 0.05, z + 0.03 + tall)
            x += t


def cupboard(m, r):
    w, d, h = r.uniform(0.6, 1.5), r.uniform(0.4, 0.6), r.uniform(0.8, 2)
    m.box(0, 0, 0.1, w, d, h)
    for x in (0.02, w - 0.08):
        for y in (0.02, d - 0.08):
            m.box(x, y, 0, x + 0.06, y + 0.06, 0.1)
    m.box(0.45 * w, -0.03, 0.5 * h, 0.47 * w, 0, 0.6 * h)


def bed(m, r):
    w, d, h = r.uniform(0.9, 1.8), 2.0, r.uniform(0.4, 0.6)
    m.box(0, 0, 0.25, w, d, h)
    m.box(0, d, 0, w, d + 0.05, r.uniform(0.8, 1.2))
    m.box(0, -0.05, 0, w, 0, h)
    m.box(0.1, d - 0.5, h, w - 0.1, d - 0.1, h + 0.1)
    for x in (0, w - 0.06):
        m.box(x, 0, 0, x + 0.06, 0.06, 0.25)


def sofa(m, r):
    w = r.uniform(1.5, 2.4)
    m.box(0, 0, 0.12, w, 0.8, 0.42)
    m.box(0, 0.65, 0.42, w, 0.85, 0.85)
    m.box(-0.15, 0, 0.12, 0, 0.85, 0.62)
    m.box(w, 0, 0.12, w + 0.15, 0.85, 0.62)
    for x in (0, w - 0.1):
        for y in (0.05, 0.7):
            m.box(x, y, 0, x + 0.08, y + 0.08, 0.12)


def house(m, r, x=0.0, y=0.0, ground=True):
    w, d, h, top = r.uniform(6, 12), r.uniform(6, 10), r.uniform(2.6, 6), r.uniform(2, 4)
    m.box(x, y, 0, x + w, y + d, h)
    e = 0.4
    a, b = (x - e, y - e, h), (x + w + e, y - e, h)
    c, f = (x + w + e, y + d + e, h), (x - e, y + d + e, h)
    p, q = (x - e, y + d / 2, h + top), (x + w + e, y + d / 2, h + top)
    m.face(a, b, q, p)
    m.face(c, f, p, q)
    m.face(b, c, q)
    m.face(f, a, p)
    m.box(x + 0.7 * w, y + 0.6 * d, h, x + 0.7 * w + 0.6, y + 0.6 * d + 0.6, h + top + 0.5)
    for i in range(3):
        m.box(x + 1 + 0.3 * w * i, y - 0.05, 0.9, x + 2 + 0.3 * w * i, y, 2.2)
    if ground and r.random() < 0.6:
        m.box(x - 6, y - 5, -0.2, x + w + 6, y + d + 5, 0)


def city(m, r):
    n = r.randint(4, 9)
    for i in range(n):
        for j in range(n):
            h = r.uniform(6, 20) if r.random() < 0.8 else r.uniform(30, 90)
            w, d = r.uniform(10, 18), r.uniform(10, 18)
            m.box(25 * i, 25 * j, 0, 25 * i + w, 25 * j + d, h)
            if r.random() < 0.4:
                m.box(25 * i + 2, 25 * j + 2, h, 25 * i + w / 2, 25 * j + d / 2, h + r.uniform(2, 6))
    if r.random() < 0.7:
        m.face((-10, -10, 0), (25 * n, -10, 0), (25 * n, 25 * n, 0), (-10, 25 * n, 0))


def skyscraper(m, r):
    w = r.uniform(20, 40)
    z = 0
    while w > 5:
        h = r.uniform(20, 60)
        m.box(-w / 2, -w / 2, z, w / 2, w / 2, z + h)
        z += h
        w *= r.uniform(0.6, 0.8)
    m.tube((0, 0, z), (0, 0, z + 20), 0.5)


def stadium(m, r):
    a, b, n = r.uniform(60, 90), r.uniform(40, 60), 48
    m.box(-a * 0.8, -b * 0.8, -1, a * 0.8, b * 0.8, 0)
    for step in range(10):
        s0, s1 = 1 + 0.05 * step, 1.05 + 0.05 * step
        z0, z1 = 1.0 * step, 1.0 * step + 1.0
        for i in range(n):
            t0, t1 = 2 * math.pi * i / n, 2 * math.pi * (i + 1) / n
            def at(t, s, z):
                return (a * s * math.cos(t), b * s * math.sin(t), z)
            m.face(at(t0, s0, z0), at(t1, s0, z0), at(t1, s0, z1), at(t0, s0, z1))
            m.face(at(t0, s0, z1), at(t1, s0, z1), at(t1, s1, z1), at(t0, s1, z1))
    for i in range(n):
        t0, t1 = 2 * math.pi * i / n, 2 * math.pi * (i + 1) / n
        m.face((a * 1.5 * math.cos(t1), b * 1.5 * math.sin(t1), -1), (a * 1.5 * math.cos(t0), b * 1.5 * math.sin(t0), -1),
               (a * 1.5 * math.cos(t0), b * 1.5 * math.sin(t0), 10), (a * 1.5 * math.cos(t1), b * 1.5 * math.sin(t1), 10))


def kitchen(m, r):
    w = r.uniform(3, 5)
    m.box(0, 0, -0.1, w, 4, 0)
    m.box(0, 3.9, 0, w, 4, 2.6)
    m.box(-0.1, 0, 0, 0, 4, 2.6)
    m.box(0, 3.3, 0, w - 0.7, 3.9, 0.88)
    m.box(0, 3.25, 0.88, w - 0.7, 3.9, 0.92)
    m.box(0, 3.55, 1.4, w - 0.7, 3.9, 2.1)
    m.box(w - 0.65, 3.25, 0, w, 3.9, 1.9)
    for i in range(4):
        m.tube((0.5 + 0.25 * i, 3.5, 0.92), (0.5 + 0.25 * i, 3.5, 0.94), 0.1)
    table(m, r, 1, 1)
    for x in (0.6, 2.4):
        chair(m, r, x, 1.1)


def noise(r):
    waves = [(r.uniform(-9, 9), r.uniform(-9, 9), r.uniform(0, 6.3), r.uniform(0.2, 1) / k) for k in range(1, 9)]
    return lambda u, v: sum(a * math.sin(p * u + q * v + f) for p, q, f, a in waves)


def terrain(m, r):
    f, s = noise(r), r.uniform(2, 25)
    m.heights(40, 300, 200 + 100 * r.random(), lambda u, v: s * f(u, v))


def block_terrain(m, r):
    f, s, n = noise(r), r.uniform(2, 10), 30
    def z(u, v):
        return s * f(u, v)
    m.heights(n, 200, 200, z)
    low = -5 * s
    for i in range(n):
        a, b = i / n, (i + 1) / n
        for p, q in (((a, 0), (b, 0)), ((b, 1), (a, 1)), ((0, b), (0, a)), ((1, a), (1, b))):
            m.face((200 * p[0], 200 * p[1], low), (200 * q[0], 200 * q[1], low),
                   (200 * q[0], 200 * q[1], z(*q)), (200 * p[0], 200 * p[1], z(*p)))
    m.face((0, 0, low), (0, 200, low), (200, 200, low), (200, 0, low))


def branch(m, r, at, way, length, radius, depth):
    end = add(at, [length * v for v in way])
    m.tube(at, end, radius, 6)
    if depth == 0:
        m.ball(*end, 0.5, 0.5, 0.4, 8)
        return
    for _ in range(r.randint(2, 3)):
        turn = [way[i] + r.uniform(-0.8, 0.8) for i in range(3)]
        turn[2] += 0.2
        n = math.sqrt(sum(v * v for v in turn))
        branch(m, r, end, [v / n for v in turn], 0.7 * length, 0.6 * radius, depth - 1)


def tree(m, r):
    branch(m, r, (0, 0, 0), (0, 0, 1), r.uniform(2, 3), r.uniform(0.15, 0.3), 4)


def conifer(m, r):
    h = r.uniform(5, 10)
    m.tube((0, 0, 0), (0, 0, h / 4), 0.25)
    for i in range(4):
        z = h / 5 + h / 5 * i
        m.revolve(0, 0, [(0, z), (2 - 0.4 * i, z), (0, z + h / 3)], 12)


def car(m, r):
    l, w, h = r.uniform(3.6, 5), r.uniform(1.6, 1.9), r.uniform(0.5, 0.8)
    m.box(0, 0, 0.25, l, w, 0.25 + h)
    a, b, z0, z1 = r.uniform(0.8, 1.5), l - r.uniform(0.4, 1.2), 0.25 + h, 0.25 + h + r.uniform(0.4, 0.8)
    lo = [(a, 0.05, z0), (b, 0.05, z0), (b, w - 0.05, z0), (a, w - 0.05, z0)]
    hi = [(a + 0.5, 0.15, z1), (b - 0.3, 0.15, z1), (b - 0.3, w - 0.15, z1), (a + 0.5, w - 0.15, z1)]
    m.face(*hi)
    for i in range(4):
        j = (i + 1) % 4
        m.face(lo[i], lo[j], hi[j], hi[i])
    for x in (0.7, l - 0.7):
        for y in (0.0, w - 0.2):
            m.tube((x, y, 0.33), (x, y + 0.2, 0.33), 0.33, 16)


def aeroplane(m, r):
    l, span = r.uniform(20, 60), r.uniform(20, 60)
    m.ball(0, 0, 0, l / 2, l / 20, l / 20, 20)
    for s in (-1, 1):
        m.face((l / 12, 0, -0.3), (-l / 20, s * span / 2, 0.8), (-l / 9, s * span / 2, 0.8), (-l / 8, 0, -0.3))
        m.face((-l / 8, 0, -0.6), (-l / 9, s * span / 2, 0.7), (-l / 20, s * span / 2, 0.7), (l / 12, 0, -0.6))
        m.face((-0.4 * l, 0, 0.5), (-0.47 * l, s * span / 6, 0.7), (-0.5 * l, s * span / 6, 0.7), (-0.49 * l, 0, 0.5))
        m.tube((0, s * span / 6, -l / 25), (-l / 10, s * span / 6, -l / 25), l / 45)
    m.face((-0.4 * l, 0, l / 25), (-0.5 * l, 0, l / 5), (-0.53 * l, 0, l / 5), (-0.5 * l, 0, l / 25))
    if r.random() < 0.5:
        for x, y in ((l / 3, 0), (-l / 20, l / 15), (-l / 20, -l / 15)):
            m.tube((x, y, -l / 20), (x, y, -l / 10), l / 150)
            m.tube((x, y - 0.2, -l / 9), (x, y + 0.2, -l / 9), l / 60)


def ship(m, r):
    l, w, h = r.uniform(40, 120), r.uniform(8, 16), r.uniform(5, 10)
    n = 20
    def rim(i, s, z):
        t = i / n
        narrow = (1 - t ** 4) * (0.6 + 0.4 * z / h)
        return (l * (t - 0.5), s * w / 2 * narrow, z)
    for i in range(n):
        for s in (-1, 1):
            for z0, z1 in ((0, h / 2), (h / 2, h)):
                m.face(*[rim(i, s, z0), rim(i + 1, s, z0), rim(i + 1, s, z1), rim(i, s, z1)][::s])
        m.face(rim(i, -1, h), rim(i + 1, -1, h), rim(i + 1, 1, h), rim(i, 1, h))
        m.face(rim(i, 1, 0), rim(i + 1, 1, 0), rim(i + 1, -1, 0), rim(i, -1, 0))
    m.face(rim(0, 1, 0), rim(0, -1, 0), rim(0, -1, h), rim(0, 1, h))
    m.box(-0.4 * l, -w / 4, h, -0.1 * l, w / 4, h + 0.8 * h)
    m.box(-0.3 * l, -w / 6, 1.8 * h, -0.2 * l, w / 6, 2.4 * h)
    m.tube((0.2 * l, 0, h), (0.2 * l, 0, 3 * h), 0.4)


def tower(m, r):
    h, w = r.uniform(20, 60), r.uniform(4, 8)
    m.revolve(0, 0, [(0, 0), (w, 0), (0.8 * w, 0.1 * h), (0.65 * w, 0.75 * h), (0.85 * w, 0.8 * h), (0.85 * w, 0.9 * h),
                     (0, 1.1 * h)])


def mast(m, r):
    h, w, n = r.uniform(20, 60), r.uniform(2, 5), 8
    def corner(k, t):
        s = w * (1 - 0.9 * t)
        return ((s, s, h * t), (-s, s, h * t), (-s, -s, h * t), (s, -s, h * t))[k % 4]
    for i in range(n):
        for k in range(4):
            m.tube(corner(k, i / n), corner(k, (i + 1) / n), 0.1, 5)
            m.tube(corner(k, i / n), corner(k + 1, (i + 1) / n), 0.06, 5)


def bridge(m, r):
    l, h, n = r.uniform(60, 200), r.uniform(8, 20), r.randint(2, 5)
    m.box(0, 0, h, l, 10, h + 1)
    for y in (0, 9.7):
        m.box(0, y, h + 1, l, y + 0.3, h + 2)
    for i in range(n + 1):
        x = (l - 2) * i / n
        m.box(x, 1, 0, x + 2, 9, h)


def character(m, r, x=0.0, y=0.0):
    h = r.uniform(1.5, 1.9)
    hip, neck = 0.5 * h, 0.83 * h
    for s in (-1, 1):
        m.tube((x, y + s * 0.1, 0.06), (x, y + s * 0.1, hip), 0.07)
        m.box(x - 0.08, y + s * 0.1 - 0.05, 0, x + 0.2, y + s * 0.1 + 0.05, 0.07)
        if r.random() < 0.5:
            m.tube((x, y + s * 0.2, 0.8 * h), (x + 0.1, y + s * 0.3, 0.45 * h), 0.045)
        else:
            m.tube((x, y + s * 0.2, 0.8 * h), (x, y + s * 0.8, 0.8 * h), 0.045)
    m.ball(x, y, (hip + neck) / 2, 0.14, 0.21, (neck - hip) / 1.8)
    m.ball(x + 0.02, y, 0.92 * h, 0.1, 0.085, 0.13)


def animal(m, r):
    l, h = r.uniform(0.8, 2), r.uniform(0.5, 1.2)
    m.ball(0, 0, h, l / 2, l / 6, l / 5)
    for x in (-0.35 * l, 0.35 * l):
        for y in (-l / 9, l / 9):
            m.tube((x, y, 0), (x * 0.95, y, h), l / 22)
    m.tube((0.4 * l, 0, h), (0.6 * l, 0, h + 0.3 * l), l / 14)
    m.ball(0.67 * l, 0, h + 0.33 * l, l / 8, l / 14, l / 14)
    for y in (-1, 1):
        m.ball(0.6 * l, y * l / 20, h + 0.42 * l, l / 40, l / 60, l / 14, 8)
    m.tube((-0.48 * l, 0, h + 0.05), (-0.6 * l, 0, h - 0.3 * l), l / 50)


def bust(m, r):
    b = r.uniform(0.1, 0.14)
    m.box(-b, -b, 0, b, b, r.uniform(0.1, 0.25))
    z = 0.25
    m.ball(0, 0, z + 0.1, 0.13, 0.22, 0.12)
    m.tube((0, 0, z + 0.1), (0.02, 0, z + 0.3), 0.06)
    m.ball(0.03, 0, z + 0.4, 0.11, 0.085, 0.14, 24)
    m.ball(0.14, 0, z + 0.38, 0.03, 0.015, 0.03, 8)


def vase(m, r):
    h, a, b, c = r.uniform(0.2, 0.5), r.uniform(0.04, 0.1), r.uniform(0.1, 0.18), r.uniform(0.03, 0.08)
    m.revolve(0, 0, [(0, 0), (a, 0), (b, 0.45 * h), (c, 0.85 * h), (1.3 * c, h), (1.2 * c, h), (0.9 * c, 0.84 * h),
                     (0.93 * b, 0.45 * h), (0.8 * a, 0.02 * h), (0, 0.02 * h)])


def bottle(m, r):
    h, w, n = r.uniform(0.2, 0.35), r.uniform(0.03, 0.05), r.uniform(0.012, 0.02)
    m.revolve(0, 0, [(0, 0), (w, 0), (w, 0.6 * h), (n, 0.75 * h), (n, h), (0, h)])


def bowl(m, r):
    w, h = r.uniform(0.1, 0.2), r.uniform(0.05, 0.12)
    m.revolve(0, 0, [(0, 0), (0.4 * w, 0), (0.75 * w, 0.3 * h), (w, h), (0.96 * w, h), (0.7 * w, 0.35 * h),
                     (0.35 * w, 0.1 * h), (0, 0.1 * h)])


def lamp(m, r):
    h = r.uniform(0.4, 1.7)
    m.revolve(0, 0, [(0, 0), (0.15, 0), (0.15, 0.02), (0.015, 0.03), (0.015, 0.75 * h), (0.2, 0.72 * h), (0.12, h),
                     (0.11, h), (0.19, 0.72 * h)])


def brick(m, r):
    n, k = r.randint(1, 6), r.randint(1, 4)
    m.box(0, 0, 0, 8 * n, 8 * k, 9.6)
    for i in range(n):
        for j in range(k):
            x, y = 8 * i + 4, 8 * j + 4
            m.tube((x, y, 9.6), (x, y, 11.4), 2.4, 16)


def stairs(m, r):
    n, w = r.randint(5, 14), r.uniform(0.8, 2)
    for i in range(n):
        m.box(0.28 * i, 0, 0, 0.28 * (i + 1), w, 0.17 * (i + 1))


def pyramid(m, r):
    h = r.uniform(0.5, 1)
    a, b, c, d = (-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)
    m.face(a, d, c, b)
    for p, q in ((a, b), (b, c), (c, d), (d, a)):
        m.face(p, q, (0, 0, h))


def village(m, r):
    f = noise(r)
    m.heights(30, 200, 200, lambda u, v: 0.8 * f(u, v) - 3)
    for _ in range(r.randint(5, 15)):
        house(m, r, r.uniform(0, 180), r.uniform(0, 180), False)


def crowd(m, r):
    m.box(-1, -1, -0.1, 9, 9, 0)
    for _ in range(8):
        character(m, r, r.uniform(0, 8), r.uniform(0, 8))


def rail(m, r):
    l = r.uniform(20, 80)
    for y in (0, 1.5):
        m.box(0, y, 0.2, l, y + 0.15, 0.22)
        m.box(0, y + 0.06, 0.22, l, y + 0.09, 0.32)
        m.box(0, y + 0.04, 0.32, l, y + 0.11, 0.37)
    x = 0.0
    while x < l:
        m.box(x, -0.5, 0, x + 0.25, 2.2, 0.2)
        x += 0.6


KINDS = {f.__name__: f for f in (
    table, chair, round_table, room, floors, shelf, cupboard, bed, sofa, house, city, skyscraper, stadium, kitchen,
    terrain, block_terrain, tree, conifer, car, aeroplane, ship, tower, mast, bridge, character, animal, bust, vase,
    bottle, bowl, lamp, brick, stairs, pyramid, village, crowd, rail)}


def made(kind, seed):
    mesh = Mesh()
    KINDS[kind](mesh, random.Random("%s %d" % (kind, seed)))
    return mesh


# What turns z to each axis.
TURNS = {"x": lambda p: (p[2], p[0], p[1]), "-x": lambda p: (-p[2], -p[0], p[1]),
         "y": lambda p: (p[1], p[2], p[0]), "-y": lambda p: (p[0], -p[2], p[1]),
         "z": lambda p: p, "-z": lambda p: (p[0], -p[1], -p[2])}


def check(gnomon, folder, seeds):
    """Builds each shape in all six axes and prints which guesses are wrong, and how many are sure."""
    counts = {"sure": 0, "guess": 0, "sure and wrong": 0, "guess and wrong": 0}
    for kind in KINDS:
        for seed in range(seeds):
            mesh = made(kind, seed)
            for axis, turned in TURNS.items():
                mesh.write(folder / "turned.ply", turned)
                built = subprocess.run([gnomon, "build", folder / "turned.ply", "-o", folder / "turned.gnm", "--json"],
                                       check=True, capture_output=True)
                report = json.loads(built.stdout)
                counts[report["up_confidence"]] += 1
                if report["up"] != axis:
                    counts[report["up_confidence"] + " and wrong"] += 1
                    print(kind, seed, axis, report["up"], report["up_confidence"])
    print(counts)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--check", metavar="GNOMON", help="build each shape in six axes in FOLDER instead")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    if arguments.check:
        check(arguments.check, arguments.folder, arguments.seeds)
        return
    for kind in KINDS:
        for seed in range(arguments.seeds):
            made(kind, seed).write(arguments.folder / ("%s_%d.ply" % (kind, seed)))


if __name__ == "__main__":
    main()

"""Reads a .gnm from docs/file_format.md alone: slow, without the program, and checked against what it exports.

Only Python and two libraries that the program needs anyway: libzstd (to unpack pages) and libxxhash (for checksums).
"""
import ctypes
import ctypes.util
import math
import struct

MAGIC = b"\x89GNM\r\n\x1a\n"
HEADER_BYTES = 40
FOOTER_BYTES = 72
NO_NORMAL = 0x80008000
WHITE = 0xFFFFFFFF
MASK32 = 0xFFFFFFFF
NOT_ENTERED = 15
EXPLICIT = 15


class Damaged(Exception):
    """The bytes are not those of a model."""


def library(name):
    found = ctypes.util.find_library(name)
    if found is None:
        raise OSError(f"lib{name} is not installed")
    return ctypes.CDLL(found)


def checksum64(data):
    xxh = library("xxhash")
    xxh.XXH3_64bits.restype = ctypes.c_uint64
    return xxh.XXH3_64bits(bytes(data), ctypes.c_size_t(len(data)))


def unpack_zstd(data, size):
    zstd = library("zstd")
    zstd.ZSTD_decompress.restype = ctypes.c_size_t
    plain = ctypes.create_string_buffer(max(size, 1))
    got = zstd.ZSTD_decompress(plain, ctypes.c_size_t(size), data, ctypes.c_size_t(len(data)))
    if got != size:
        raise Damaged("a page does not unpack to the size that it promises")
    return plain.raw[:size]


class Bytes:
    """Takes values one after the other."""

    def __init__(self, data):
        self.data = data
        self.at = 0

    def raw(self, count):
        if self.at + count > len(self.data):
            raise Damaged("the bytes end too early")
        self.at += count
        return self.data[self.at - count:self.at]

    def take(self, form):
        return struct.unpack("<" + form, self.raw(struct.calcsize("<" + form)))

    def one(self, form):
        return self.take(form)[0]

    def varint(self):
        value = shift = 0
        while True:
            byte = self.one("B")
            value |= (byte & 0x7F) << shift
            if byte < 0x80:
                return value
            shift += 7

    def text(self):
        return self.raw(self.varint()).decode()

    def end(self):
        if self.at != len(self.data):
            raise Damaged(f"{len(self.data) - self.at} bytes too many")


def unzigzag(code):
    return (code >> 1) ^ -(code & 1)


class Model:
    """The header, the tables and, page by page, the geometry."""

    def __init__(self, path):
        with open(path, "rb") as file:
            self.data = file.read()
        data = self.data
        if data[:8] != MAGIC:
            raise Damaged("not a model")
        self.version, self.flags, checksum = struct.unpack("<IIQ", data[8:24])
        if self.version not in (3, 4):
            raise Damaged(f"format version {self.version}")
        if checksum64(data[:16] + data[24:40]) != checksum:
            raise Damaged("the header's checksum is wrong")
        self.content_hash = data[24:40].hex()
        footer = data[-FOOTER_BYTES:]
        places = struct.unpack("<9Q", footer)
        if checksum64(footer[:-8]) != places[8] or places[6] != len(data):
            raise Damaged("the footer is wrong")
        self.summary = self.read_summary(Bytes(self.table(*places[3:6])), self.version)
        self.pages = self.read_page_table(Bytes(self.table(*places[0:3])), places[7])

    def table(self, offset, size, checksum):
        table = self.data[offset:offset + size]
        if checksum64(table) != checksum:
            raise Damaged("a table's checksum is wrong")
        return table

    @staticmethod
    def read_summary(rest, version):
        summary = {"origin": rest.take("3d"), "step": math.ldexp(1, rest.one("i")),
                   "bounds": (rest.take("3d"), rest.take("3d"))}
        for name in ("source_triangles", "source_vertices", "coarsest_triangles"):
            summary[name] = rest.varint()
        summary["flags"] = rest.one("I")
        summary["dropped"] = {rest.text(): rest.varint() for _ in range(rest.varint())}
        summary["options"] = {rest.text(): rest.text() for _ in range(rest.varint())}
        summary["levels"] = [{"triangles": rest.varint(), "clusters": rest.varint(), "groups": rest.varint(),
                              "max_error": rest.one("d")} for _ in range(rest.varint())]
        summary.update({"up": (0.0, 1.0, 0.0), "unit": 0, "fields": []})
        if version >= 4:
            summary["up"], summary["unit"] = rest.take("3d"), rest.one("B")
            summary["fields"] = [(rest.text(), *rest.take("2d"), rest.varint()) for _ in range(rest.varint())]
        for level in summary["levels"]:
            level["max_attribute_error"] = rest.one("d") if version >= 4 else 0.0
        rest.end()
        return summary

    @staticmethod
    def read_page_table(rest, count):
        pages = []
        offset = HEADER_BYTES
        for _ in range(count):
            page = dict(zip(("stored_bytes", "level", "checksum"), rest.take("IIQ")))
            page.update(zip(("groups", "clusters", "refinements", "vertices", "triangles"), rest.take("5I")))
            page["box"] = (rest.take("3I"), rest.take("3I"))
            children = rest.one("I")
            page["bounds"] = (rest.take("3d"), rest.one("d"))
            page["min_error"], page["max_error"] = rest.take("2d")
            page["children"] = rest.take(f"{children}I")
            page["offset"] = offset
            offset += page["stored_bytes"]
            pages.append(page)
        rest.end()
        return pages

    def plain_page(self, row):
        stored = self.data[row["offset"]:row["offset"] + row["stored_bytes"]]
        if checksum64(stored) != row["checksum"]:
            raise Damaged("a page's checksum is wrong")
        rest = Bytes(stored)
        packing, size = rest.one("B"), rest.varint()
        body = rest.raw(len(stored) - rest.at)
        return unpack_zstd(body, size) if packing & 1 else body, bool(packing & 2), bool(packing & 4)

    def page(self, number):
        plain, has_attribute_errors, has_fields = self.plain_page(self.pages[number])
        page = Page(Bytes(plain), self.pages[number], has_attribute_errors, has_fields)
        if page.field_bits != [bits for _, _, _, bits in self.summary["fields"]]:
            raise Damaged("a page has other fields than the summary")
        return page

    def field_values(self, numbers):
        """The values of a vertex's fields, by name."""
        return {name: low + number * (high - low) / (2 ** bits - 1)
                for number, (name, low, high, bits) in zip(numbers, self.summary["fields"])}

    def uniform_cut(self, limit):
        """The clusters that stand for the surface where every group of a drawn error above `limit` is refined:
        (page, cluster) for each."""
        for number, row in enumerate(self.pages):
            if row["max_error"] <= limit:
                continue
            page = self.page(number)
            for cluster in page.clusters:
                if cluster["group_error"] > limit and not cluster["refinement_error"] > limit:
                    yield page, cluster

    def world(self, position):
        return tuple(o + self.summary["step"] * p for o, p in zip(self.summary["origin"], position))


class Page:
    """One decoded page: `clusters`, each with its vertices and triangles."""

    def __init__(self, rest, row, has_attribute_errors, has_fields):
        self.field_bits = []
        def drawn_error():
            return max(rest.take("2d" if has_attribute_errors else "d"))
        groups = [(rest.varint(), rest.take("4d"), drawn_error()) for _ in range(row["groups"])]
        refinements = [(rest.varint(), rest.varint(), rest.take("4d"), drawn_error())
                       for _ in range(row["refinements"])]
        self.clusters = []
        for count, _, error in groups:
            for _ in range(count):
                vertices, triangles = rest.take("BB")
                cluster = {"vertices": vertices + 1, "triangles": triangles + 1, "group_error": error,
                           "refinement_error": -1.0}
                if row["level"] > 0:
                    cluster["refinement_error"] = refinements[rest.varint()][3]
                self.clusters.append(cluster)
        codes = Bytes(rest.raw(sum(cluster["triangles"] for cluster in self.clusters)))
        indices = Bytes(rest.raw(rest.varint()))
        for cluster in self.clusters:
            cluster["faces"], cluster["edges"] = decode_triangles(codes, indices, cluster)
        indices.end()
        self.decode_vertices(rest, has_fields)
        rest.end()

    def decode_vertices(self, rest, has_fields):
        anchors = Bytes(rest.raw(rest.varint()))
        has_normals, has_colors, shift = rest.take("BBB")
        count = sum(cluster["vertices"] for cluster in self.clusters)
        references = planes(rest, count)
        fresh = references.count(0)
        channels = [planes(rest, fresh) for _ in range(3 + 2 * bool(has_normals) + 4 * bool(has_colors))]
        if has_fields:
            self.field_bits = list(rest.raw(rest.one("B")))
            channels += [planes(rest, fresh) for _ in self.field_bits]
        numbers = zip(*channels)
        width = 16 - shift
        anchor = (0, 0, 0)
        self.vertices = []
        for cluster in self.clusters:
            first = expected = cluster["first"] = len(self.vertices)
            for v in range(cluster["vertices"]):
                code = references[first + v]
                if code != 0:
                    earlier = expected + unzigzag(code - 1)
                    if not 0 <= earlier < first:
                        raise Damaged("a vertex refers to a later vertex")
                    self.vertices.append(self.vertices[earlier])
                    expected = earlier + 1
                    continue
                if v == 0:
                    anchor = tuple((a + unzigzag(anchors.varint())) & MASK32 for a in anchor)
                self.vertices.append(self.fresh_vertex(cluster, v, next(numbers), anchor, width, has_normals, has_colors))
        anchors.end()

    def fresh_vertex(self, cluster, v, numbers, anchor, width, has_normals, has_colors):
        """A vertex is (position, normal as two offset-binary numbers of `width` bits, colour as four bytes, fields)."""
        first = cluster["first"]
        edge = cluster["edges"].get(v)
        if v == 0:
            a = b = c = (anchor, (0, 0), (255,) * 4, (0,) * len(self.field_bits))
        elif edge is not None and max(edge) < v:
            a, b, c = (self.vertices[first + corner] for corner in edge)
        else:
            a = b = c = self.vertices[first + v - 1]
        position = tuple((unzigzag(n) + p + q - r) & MASK32 for n, p, q, r in zip(numbers, a[0], b[0], c[0]))
        normal = (0, 0)
        rest = numbers[3:]
        if has_normals:
            normal = tuple(((p + q) // 2 + unzigzag(n)) & ((1 << width) - 1) for n, p, q in zip(rest, a[1], b[1]))
            rest = rest[2:]
        color = (255,) * 4
        if has_colors:
            color = tuple(((p + q) // 2 + unzigzag(n)) & 0xFF for n, p, q in zip(rest, a[2], b[2]))
            rest = rest[4:]
        fields = tuple(((p + q) // 2 + unzigzag(n)) & ((1 << bits) - 1)
                       for n, p, q, bits in zip(rest, a[3], b[3], self.field_bits))
        return position, normal, color, fields


def planes(rest, count):
    """`count` numbers that lie byte plane by byte plane, low bytes first."""
    numbers = [0] * count
    for plane in range(rest.one("B")):
        for i, byte in enumerate(rest.raw(count)):
            numbers[i] |= byte << (8 * plane)
    return numbers


def decode_triangles(codes, indices, cluster):
    """The triangles of one cluster, and by vertex the edge across which it was new: (from, to, opposite)."""
    faces, edges, open_edges = [], {}, []
    new = 0
    for _ in range(cluster["triangles"]):
        code = codes.one("B")
        age, low = code >> 4, code & 15
        if age == NOT_ENTERED:
            corners = []
            for k in range(3):
                if low >> k & 1:
                    corners.append(new)
                    new += 1
                else:
                    corners.append(indices.one("B"))
            a, b, c = corners
            open_edges.append((b, a, c))
        else:
            if age >= len(open_edges):
                raise Damaged("a triangle is entered across an edge that is not there")
            a, b, opposite = open_edges[-1 - age]
            if low == 0:
                c = new
                edges[new] = (a, b, opposite)
                new += 1
            else:
                c = indices.one("B") if low == EXPLICIT else new - low
        open_edges += [(a, c, b), (c, b, a)]
        if not max(a, b, c) < cluster["vertices"] or min(a, b, c) < 0:
            raise Damaged("a triangle refers to a missing vertex")
        faces.append((a, b, c))
    return faces, edges

"""What must not matter: relations between builds, frames and verdicts that hold to the byte, on random models and views.

usage: relations.py [--instances N] [--seed S] [--models DIR] [RELATION...]

Each relation changes something that must not matter (where the mesh lies, how large it is, in which file its vertices
are, how many threads there are, how bright the light is) and says what stays the same: the bytes of the model, the
pixels of a picture, or what is printed. The random meshes are of dyadic numbers, so that moving and scaling them is
exact. With --models each relation of frames is held on every .gnm of the folder, too. $GNOMON is the program.
"""
import argparse
import json
import pathlib
import random
import shutil
import struct
import subprocess
import sys
import tempfile
import time

from instances import Fails, Instance, Mesh, Model, pixels, run


def equal(one, other, what):
    if one != other:
        raise Fails(what)


# Builds ------------------------------------------------------------------------------------------------------------


def threads_of_a_build(i):
    equal(i.build("a.ply", "b.gnm", "--threads", str(i.chance.choice((1, 2, 3, 5)))), i.first(), "other bytes")


def memory_of_a_build(i):
    equal(i.build("a.ply", "b.gnm", "--memory", i.chance.choice(("512M", "700M", "3G"))), i.first(), "other bytes")


def without_temporary_files(i):
    equal(i.build("a.ply", "b.gnm", "--in-memory"), i.first(), "other bytes")


def text_or_binary(i):
    i.mesh.write(i.folder / "b.ply", "ascii")
    equal(i.build("b.ply", "b.gnm"), i.first(), "other bytes")


def order_of_bytes(i):
    i.mesh.write(i.folder / "b.ply", "binary_big_endian")
    equal(i.build("b.ply", "b.gnm"), i.first(), "other bytes")


def obj_or_ply(i):
    i.mesh.write_obj(i.folder / "b.obj")
    equal(i.build("b.obj", "b.gnm"), i.first(), "other bytes")


def unused_vertices(i):
    i.built(Mesh(i.mesh.vertices + [(1.0, 0.5, 1.0)] * i.chance.randint(1, 9), i.mesh.triangles))
    equal(finest(i, "b.gnm"), finest(i, "a.gnm"), "another finest surface")


def doubled_triangles(i):
    i.built(Mesh(i.mesh.vertices, i.mesh.triangles + i.chance.sample(i.mesh.triangles, 5)))
    equal(finest(i, "b.gnm"), finest(i, "a.gnm"), "another finest surface")


def triangles_without_area(i):
    some = [(a, a, b) for a, b, _ in i.chance.sample(i.mesh.triangles, 5)]
    i.built(Mesh(i.mesh.vertices, i.mesh.triangles + some))
    equal(finest(i, "b.gnm"), finest(i, "a.gnm"), "another finest surface")


def surface(data):
    """The triangles of an exported PLY as a sorted list of sorted positions, whatever the order of its rows."""
    head, body = data.split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in head.splitlines() if line.startswith(b"element")]
    properties = [line.split()[1] for line in head.splitlines() if line.startswith(b"property") and b"list" not in line]
    sizes = {b"double": "d", b"float": "f", b"uchar": "B", b"float64": "d", b"float32": "f"}
    row = struct.Struct("<" + "".join(sizes[name] for name in properties))
    points = [row.unpack_from(body, row.size * k)[:3] for k in range(counts[0])]
    at, found = row.size * counts[0], []
    for k in range(counts[1]):
        found.append(tuple(sorted(points[corner] for corner in struct.unpack_from("<3i", body, at + 13 * k + 1))))
    return sorted(found)


def finest(i, model):
    run(i.folder, "export", model, "--triangles", "1M", "-o", "cut.ply")
    return surface((i.folder / "cut.ply").read_bytes())


def order_of_triangles(i):
    shuffled = list(i.mesh.triangles)
    i.chance.shuffle(shuffled)
    i.built(Mesh(i.mesh.vertices, shuffled))
    equal(finest(i, "b.gnm"), finest(i, "a.gnm"), "another finest surface")


def order_of_vertices(i):
    order = list(range(len(i.mesh.vertices)))
    i.chance.shuffle(order)
    place = {old: new for new, old in enumerate(order)}
    i.built(Mesh([i.mesh.vertices[old] for old in order], [tuple(place[c] for c in t) for t in i.mesh.triangles]))
    equal(finest(i, "b.gnm"), finest(i, "a.gnm"), "another finest surface")


def several_inputs(i):
    half = len(i.mesh.triangles) // 2
    Mesh(i.mesh.vertices, i.mesh.triangles[:half]).write(i.folder / "b1.ply")
    Mesh(i.mesh.vertices, i.mesh.triangles[half:]).write(i.folder / "b2.ply")
    i.build(["b1.ply", "b2.ply"], "b.gnm")
    equal(finest(i, "b.gnm"), finest(i, "a.gnm"), "another finest surface")


def moved_by_grid_steps(i):
    by = tuple(float(i.chance.randint(-4096, 4096)) for _ in range(3))
    i.built(i.mesh.moved(by))
    equal(payload(i, "b.gnm"), payload(i, "a.gnm"), "other pages")


def scaled_by_a_power_of_two(i):
    i.built(i.mesh.scaled(2.0 ** i.chance.randint(-20, 20)))
    equal([row["triangles"] for row in levels(i, "b.gnm")], [row["triangles"] for row in levels(i, "a.gnm")], "other levels")


def levels(i, model):
    return json.loads(run(i.folder, "info", model, "--json"))["levels"]


def payload(i, model):
    """Everything that `info` says of a model but where it lies and its name."""
    told = json.loads(run(i.folder, "info", model, "--json"))
    return {name: told[name] for name in ("levels", "pages", "clusters", "triangles") if name in told}


def built_again_from_its_export(i):
    run(i.folder, "export", "a.gnm", "--triangles", "1M", "-o", "again.ply")
    i.build("again.ply", "b.gnm")
    equal(finest(i, "b.gnm"), finest(i, "a.gnm"), "another finest surface")


def other_folder(i):
    (i.folder / "deep").mkdir(exist_ok=True)
    shutil.copy(i.folder / "a.ply", i.folder / "deep/x y.ply")
    equal(i.build("deep/x y.ply", str(i.folder / "deep/o.gnm")), i.first(), "other bytes")


# Frames ------------------------------------------------------------------------------------------------------------


def threads_of_a_frame(i):
    equal(i.picture("a.gnm", None, "--threads", "1"), i.picture("a.gnm", None, "--threads", "5"), "other pixels")


def brightness_of_the_light(i):
    by = i.chance.choice((0.25, 2.0, 1024.0))
    equal(i.picture("a.gnm", i.view.words(light=tuple(by * part for part in i.view.light))), i.picture(), "other pixels")


def moved_with_the_camera(i):
    by = tuple(float(i.chance.randint(-512, 512)) for _ in range(3))
    i.built(i.mesh.moved(by))
    words = i.view.words(*(tuple(a + b for a, b in zip(place, by)) for place in (i.view.eye, i.view.target)))
    equal(i.picture("b.gnm", words), i.picture(), "other pixels")


def scaled_with_the_camera(i):
    by = 2.0 ** i.chance.randint(-8, 8)
    i.built(i.mesh.scaled(by))
    words = i.view.words(*(tuple(a * by for a in place) for place in (i.view.eye, i.view.target)))
    equal(i.picture("b.gnm", words), i.picture(), "other pixels")


def occlusion(i):
    equal(i.picture("a.gnm", None, "--occlusion", "on"), i.picture("a.gnm", None, "--occlusion", "off"), "other pixels")


def culled_casters(i):
    maps = ("--shadows", "maps", "--z-partitions", "2", "--warp", i.chance.choice(("none", "lspsm", "psm")), "--shadow-texels", "256x256")
    pictures = [i.picture("a.gnm", None, *maps, "--cull-casters", how) for how in ("on", "off", "receivers")]
    equal(pictures[1:], pictures[:1] * 2, "other pixels")


def warp_of_exact_shadows(i):
    exact = ("--shadows", "exact")
    equal(i.picture("a.gnm", None, *exact, "--memory", "300M"), i.picture("a.gnm", None, *exact), "other pixels")


def same_run_twice(i):
    equal(i.picture(), i.picture(), "other pixels")


def language_and_place(i):
    equal(i.picture(LC_ALL="de_DE.UTF-8", TZ="Asia/Kathmandu", HOME="/"), i.picture(), "other pixels")


def exact_shadows_are_the_oracles(i):
    run(i.folder, "render", "a.gnm", "-o", "p.png", *i.view.words(), "--shadows", "exact", "--oracle", "exact", "--stats", "s.json")
    told = json.loads((i.folder / "s.json").read_text())
    equal(told["wrong_pixels_all"], 0, f"{told['wrong_pixels_all']} pixels differ")


def far_beyond_everything(i):
    exact = ("--shadows", "exact", "--shadow-near", "0.001")
    equal(i.picture("a.gnm", None, *exact, "--shadow-far", "1e5"), i.picture("a.gnm", None, *exact, "--shadow-far", "4e6"), "other pixels")


def camera_of_a_file(i):
    """A camera said by options, or by a file of one keyframe."""
    frame = {"eye": i.view.eye, "target": i.view.target, "up": i.view.up, "fov_y": 60}
    (i.folder / "c.json").write_text(json.dumps(frame))
    words = ("--camera", "c.json", "--light", ",".join(map(repr, i.view.light)), "--size", i.view.size, "--samples", "1")
    equal(i.picture("a.gnm", words), i.picture(), "other pixels")


def most_differ(one, other, share, what):
    """That no more than this share of pixels differs by more than 2 of 255."""
    width, height, channels, rows = one
    equal(other[:3], one[:3], "another size")
    wrong = sum(
        any(abs(a - b) > 2 for a, b in zip(row[x : x + channels], twin[x : x + channels]))
        for row, twin in zip(rows, other[3]) for x in range(0, width * channels, channels)
    )  # fmt: skip
    if wrong > share * width * height:
        raise Fails(f"{what}: {wrong} of {width * height} pixels differ, expected at most {share:.1%}")


def drawn(i, model, words=None, *more):
    i.picture(model, words, "--error-pixels", "0.001", *more)
    return pixels(i.folder / "p.png")


def triangles_in_another_order(i):
    shuffled = list(i.mesh.triangles)
    i.chance.shuffle(shuffled)
    i.built(Mesh(i.mesh.vertices, shuffled))
    most_differ(drawn(i, "a.gnm"), drawn(i, "b.gnm"), 0.002, "another order of triangles")


def reversed_winding(i):
    i.built(Mesh(i.mesh.vertices, [(a, c, b) for a, b, c in i.mesh.triangles]))
    most_differ(drawn(i, "a.gnm"), drawn(i, "b.gnm"), 0.002, "corners the other way round")


LIT = ("--shading", "lit")


def mirrored(i):
    """x becomes -x, left becomes right; but for the eye's own light, which is brighter to the right than to the left."""
    def mirror(place):
        return (-place[0], *place[1:])

    i.built(Mesh([mirror(vertex) for vertex in i.mesh.vertices], [(a, c, b) for a, b, c in i.mesh.triangles]))
    words = i.view.words(mirror(i.view.eye), mirror(i.view.target), mirror(i.view.light))
    width, height, channels, rows = drawn(i, "b.gnm", words, *LIT)
    flipped = [b"".join(row[x : x + channels] for x in range((width - 1) * channels, -1, -channels)) for row in rows]
    most_differ(drawn(i, "a.gnm", None, *LIT), (width, height, channels, flipped), 0.005, "mirrored")


def turned_axes(i):
    def turn(place):
        return (place[2], place[0], place[1])

    i.mesh.turned().write(i.folder / "b.ply")
    run(i.folder, "build", "b.ply", "-o", "b.gnm", "--chunk-triangles", "500", "--up", "z")
    words = i.view.words(turn(i.view.eye), turn(i.view.target), turn(i.view.light), turn(i.view.up))
    most_differ(drawn(i, "a.gnm"), drawn(i, "b.gnm", words), 0.005, "turned axes")


def triangles_split_inside(i):
    """At a point of each of some triangles that lies on its plane exactly."""
    vertices, triangles = list(i.mesh.vertices), []
    for a, b, c in i.mesh.triangles:
        if i.chance.random() < 0.8:
            triangles.append((a, b, c))
            continue
        inside = tuple(p + (q - p) / 2 + (r - p) / 4 for p, q, r in zip(vertices[a], vertices[b], vertices[c]))
        vertices.append(inside)
        triangles += [(a, b, len(vertices) - 1), (b, c, len(vertices) - 1), (c, a, len(vertices) - 1)]
    i.built(Mesh(vertices, triangles))
    flat = ("--shading", "flat", "--shadows", "exact")
    most_differ(drawn(i, "a.gnm", None, *flat), drawn(i, "b.gnm", None, *flat), 0.002, "split triangles")


def hidden_object(i):
    """Two triangles below the ground, which they do not touch, under an eye above it."""
    first = len(i.mesh.vertices)
    both = Mesh(i.mesh.vertices + [(3.0, -1.0, 3.0), (4.0, -1.0, 3.0), (3.0, -1.0, 4.0), (4.0, -1.0, 4.0)],
                i.mesh.triangles + [(first, first + 1, first + 3), (first, first + 3, first + 2)])  # fmt: skip
    i.view.eye = (i.view.eye[0], max(i.view.eye[1], 3.0), i.view.eye[2])
    i.built(both)
    most_differ(drawn(i, "a.gnm"), drawn(i, "b.gnm"), 0.002, "a hidden object")


RELATIONS = {
    function.__name__: function
    for function in (
        threads_of_a_build, memory_of_a_build, without_temporary_files, text_or_binary, order_of_bytes, obj_or_ply,
        unused_vertices, doubled_triangles, triangles_without_area, order_of_triangles, order_of_vertices, several_inputs,
        moved_by_grid_steps, scaled_by_a_power_of_two, built_again_from_its_export, other_folder,
        threads_of_a_frame, brightness_of_the_light, moved_with_the_camera, scaled_with_the_camera, occlusion,
        culled_casters, warp_of_exact_shadows, same_run_twice, language_and_place, exact_shadows_are_the_oracles,
        far_beyond_everything, camera_of_a_file, triangles_in_another_order, reversed_winding,
        mirrored, turned_axes, triangles_split_inside, hidden_object,
    )
}  # fmt: skip


OF_REAL_MODELS = (
    "threads_of_a_frame", "brightness_of_the_light", "occlusion", "culled_casters", "warp_of_exact_shadows",
    "same_run_twice", "language_and_place", "exact_shadows_are_the_oracles", "far_beyond_everything",
)  # fmt: skip


def instances(given):
    """(relation, name of the instance, how to make it in a folder)."""
    models = sorted(given.models.glob("*.gnm")) if given.models else []
    for name in given.relations or RELATIONS:
        for number in range(given.instances):
            chance = random.Random(f"{given.seed} {name} {number}")
            yield name, f"instance {number} of seed {given.seed}", lambda folder, chance=chance: Instance(folder, chance)
        for model in models if name in OF_REAL_MODELS else ():
            chance = random.Random(f"{given.seed} {name} {model.name}")
            yield name, model.name, lambda folder, chance=chance, model=model: Model(folder, chance, model)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--instances", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--models", type=pathlib.Path)
    parser.add_argument("relations", nargs="*", metavar="RELATION")
    given = parser.parse_args()
    held, fails, started = 0, 0, time.monotonic()
    for name, which, make in instances(given):
        with tempfile.TemporaryDirectory(prefix="gnomon_torture_") as folder:
            try:
                RELATIONS[name](make(pathlib.Path(folder)))
                held += 1
            except (Fails, subprocess.TimeoutExpired) as wrong:
                fails += 1
                print(f"{name}, {which}: {wrong}", flush=True)
    print(f"{len(given.relations or RELATIONS)} relations, {held + fails} instances, {fails} broken, {time.monotonic() - started:.0f} s")
    sys.exit(1 if fails else 0)


if __name__ == "__main__":
    main()

"""What a newcomer gets wrong, a row each: the exit code, one line on stderr, and the words in it that say what to do."""
import json
import os
import unittest

from program import DATA, ProgramTest, run

PLY = "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
FACES = "element face {}\nproperty list uchar int vertex_indices\nend_header\n"
TRIANGLE = "0 0 0\n1 0 0\n0 1 0\n"
FILES = {
    "empty.ply": "",
    "empty.obj": "",
    "none.ply": PLY.format(0) + FACES.format(0),
    "cloud.ply": PLY.format(3) + "end_header\n" + TRIANGLE,
    "cut_off.ply": PLY.format(3) + FACES.format(1) + TRIANGLE,
    "no_header_end.ply": "ply\nformat ascii 1.0\n",
    "nan.ply": PLY.format(3) + FACES.format(1) + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n",
    "far_index.ply": PLY.format(3) + FACES.format(1) + TRIANGLE + "3 0 1 7\n",
    "far_index.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n",
    "bad_number.obj": "v 0 0 zero\n",
    "no_end.stl": "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
    "mesh.glb": "glTF\2\0\0\0",
    "scene.fbx": "Kaydara FBX Binary  ",
    "notes.txt": "a text of no importance, long enough not to be called cut off, as it would be were it shorter than the\n" * 3,
    "short": "hello",
    "not.json": "{",
    "list.json": "[]",
    "no_keys.json": '{"keyframes": []}',
}

# Exit code, words of the line, words of the command; a name of FILES or of a made file stands for its place.
ROWS = [
    (2, "gnomon --help lists them", "rendr sundial.gnm -o a.png"),
    (2, "gnomon --help lists them", "sundial.gnm"),
    (2, "--at: expected LAT,LON in degrees", "sun position --at 95,0 --time 2026-06-21T12:00Z"),
    (2, "--light 0,1,0 contradict", "render sundial.gnm -o a.png --light 0,1,0 --sun 50,10,2026-06-21T12:00Z"),
    (2, "--north 10 needs --sun", "render sundial.gnm -o a.png --north 10"),
    (2, "it is up from", "render sundial.gnm -o a.png --sun 50,10,2026-06-21T00:00Z"),
    (2, "with its offset from UTC, such as 2026-06-21T12:00+02:00", "sun position --at 50,10 --time 2026-06-21T12:00"),
    (2, "--help", ""),
    (2, "MODEL is required; see gnomon render --help", "render"),
    (2, "--output is required; see gnomon render --help", "render sundial.gnm"),
    (1, "missing.gnm: cannot open: No such file", "render missing.gnm -o a.png"),
    (1, "gnomon build MESH -o MODEL.gnm makes one", "render sundial.ply -o a.png"),
    (1, "gnomon build MESH -o MODEL.gnm makes one", "info sundial.ply"),
    (1, "gnomon build MESH -o MODEL.gnm makes one", "explain sundial.ply"),
    (1, "gnomon build MESH -o MODEL.gnm makes one", "verify sundial.ply"),
    (1, "gnomon build MESH -o MODEL.gnm makes one", "export sundial.ply -o b.ply --error 1"),
    (1, "gnomon build MESH -o MODEL.gnm makes one", "path sundial.ply --kind walk -o p.json"),
    (1, "gnomon build MESH -o MODEL.gnm makes one", "bench sundial.ply --path path.json"),
    (1, "gnomon build MESH -o MODEL.gnm makes one", "render short -o a.png"),
    (1, "this is a folder", "render folder -o a.png"),
    (1, "cut off", "render cut_off.gnm -o a.png"),
    (1, "damaged", "render damaged.gnm -o a.png"),
    (2, "a name ending in .png", "render sundial.gnm -o a.jpg"),
    (1, "short/a.png", "render sundial.gnm -o short/a.png"),
    (2, "WxH", "render sundial.gnm -o a.png --size 0x4"),
    (2, "WxH", "render sundial.gnm -o a.png --size 800"),
    (2, "at most 16384 pixels", "render sundial.gnm -o a.png --size 99999x4"),
    (2, "--light", "render sundial.gnm -o a.png --light 0,0,0"),
    (2, "x,y,z", "render sundial.gnm -o a.png --light 1,2"),
    (2, "--eye", "render sundial.gnm -o a.png --eye 1,2,3 --target 1,2,3"),
    (2, "--fov-y", "render sundial.gnm -o a.png --fov-y 0"),
    (2, "--fov-y", "render sundial.gnm -o a.png --fov-y 190"),
    (1, "No such file", "render sundial.gnm -o a.png --camera missing.json"),
    (1, "not.json", "render sundial.gnm -o a.png --camera not.json"),
    (2, "contradict", "render sundial.gnm -o a.png --camera camera.json --eye 1,2,3"),
    (2, "--shadow-near", "render sundial.gnm -o a.png --shadow-near -1"),
    (2, "--shadow-far", "render sundial.gnm -o a.png --shadow-near 10 --shadow-far 1"),
    (2, "--error-pixels", "render sundial.gnm -o a.png --error-pixels 0"),
    (2, "--z-partitions", "render sundial.gnm -o a.png --z-partitions 0"),
    (2, "--z-partitions", "render sundial.gnm -o a.png --z-partitions many"),
    (2, "--up: expected auto, x, y, z, -x, -y, -z or x,y,z", "build sundial.ply -o a.gnm --up w"),
    (2, "--up: expected auto, x, y, z, -x, -y, -z or x,y,z", "render sundial.gnm -o a.png --up 0,0,0"),
    (2, "--textures: on not in {bake,off}", "build sundial.ply -o a.gnm --textures on"),
    (2, "--unit: km not in {m,cm,mm,ft,in}", "build sundial.ply -o a.gnm --unit km"),
    (2, "--view: expected front, back, left, right, top, bottom or iso", "render sundial.gnm -o a.png --view side"),
    (2, "--view top and --eye 1,2,3 contradict", "render sundial.gnm -o a.png --view top --eye 1,2,3"),
    (2, "lspsm", "render sundial.gnm -o a.png --warp wavy"),
    (2, "maps", "render sundial.gnm -o a.png --shadows maybe"),
    (2, "--stabilize", "render sundial.gnm -o a.png --stabilize on --warp lspsm"),
    (2, "--filter", "render sundial.gnm -o a.png --filter -3"),
    (2, "--shadow-texels", "render sundial.gnm -o a.png --shadow-texels 0x0"),
    (2, "--memory", "render sundial.gnm -o a.png --memory 1Q"),
    (2, "software", "render sundial.gnm -o a.png --backend vulkan"),
    (2, "--threads", "render sundial.gnm -o a.png --threads -1"),
    (2, "none", "render sundial.gnm -o a.png --progress loud"),
    (2, "partitions", "render sundial.gnm -o a.png --overlay heat"),
    (2, "--max-triangles", "render sundial.gnm -o a.png --max-triangles 0"),
    (2, "--max-aliasing", "render sundial.gnm -o a.png --max-aliasing 0"),
    (1, "No such file", "render sundial.gnm -o a.png --reference missing.png"),
    (2, "--samples", "render sundial.gnm -o a.png --samples 0"),
    (2, "--samples", "render sundial.gnm -o a.png --samples 2.5"),
    (2, "--samples", "render sundial.gnm -o a.png --samples 65536"),
    (2, "--samples 4 and --stats contradict", "render sundial.gnm -o a.png --samples 4 --stats s.json"),
    (2, "--samples 4 and --depth contradict", "render sundial.gnm -o a.png --samples 4 --depth d.pfm"),
    (2, "--samples 4 and --oracle contradict", "render sundial.gnm -o a.png --samples 4 --oracle exact"),
    (2, "--sky 8 and --samples 1 contradict", "render sundial.gnm -o a.png --sky 8 --samples 1"),
    (2, "--sun-angle 0.5 and --stats contradict", "render sundial.gnm -o a.png --sun-angle 0.5 --stats s.json"),
    (2, "--sky", "render sundial.gnm -o a.png --sky 8,blue"),
    (2, "--light-error", "render sundial.gnm -o a.png --light-error 0.001"),
    (2, "--samples 4 and --overlay contradict", "render sundial.gnm -o a.png --samples 4 --overlay lod"),
    (2, "--samples 4 and --color-by contradict", "render sundial.gnm -o a.png --samples 4 --color-by slope"),
    (1, "vertex, height, slope, error", "render sundial.gnm -o a.png --color-by depth"),
    (2, "viridis", "render sundial.gnm -o a.png --color-by slope --colormap jet"),
    (2, "LO,HI", "render sundial.gnm -o a.png --color-by slope --color-range 9,1"),
    (2, "--color-range needs --color-by", "render sundial.gnm -o a.png --color-range 1,9"),
    (2, "without an overlay", "render sundial.gnm -o a.png --color-by slope --overlay lod"),
    (2, "--light-at 0,9,0 and --light 1,1,1", "render sundial.gnm -o a.png --light-at 0,9,0 --light 1,1,1"),
    (2, "--light-at 0,9,0 and --warp lspsm", "bench sundial.gnm --path a.json --light-at 0,9,0 --warp lspsm"),
    (2, "--light-at and sun hours", "sun hours sundial.gnm -o a.png --at 47,8 --from 2026-06-21T00:00+02:00 --to 2026-06-22T00:00+02:00 --step 1h --light-at 0,9,0"),
    (2, "--color-by", "render sundial.gnm -o a.png --color-by slope --background transparent"),
    (2, "see gnomon render --help", "render sundial.gnm -o a.png --colour red"),
    (1, "No such file", "build missing.ply -o b.gnm"),
    (1, "this is a folder", "build folder -o b.gnm"),
    (1, "expected PLY, OBJ, STL, OFF or glTF", "build notes.txt -o b.gnm"),
    (1, "expected a header of 20 bytes, found 8", "build mesh.glb -o b.gnm"),
    (1, "FBX is not read: convert it to glTF", "build scene.fbx -o b.gnm"),
    (1, "expected PLY, OBJ, STL, OFF or glTF", "build short -o b.gnm"),
    (1, "this file is already a model", "build sundial.gnm -o b.gnm"),
    (1, "the file is empty", "build empty.ply -o b.gnm"),
    (1, "the file is empty", "build empty.obj -o b.gnm"),
    (1, "empty: it has no vertices and no faces", "build none.ply -o b.gnm"),
    (1, "make a mesh of it first", "build cloud.ply -o b.gnm"),
    (1, "ends too early", "build cut_off.ply -o b.gnm"),
    (1, "no end_header", "build no_header_end.ply -o b.gnm"),
    (1, "not finite", "build nan.ply -o b.gnm"),
    (1, "out of range", "build far_index.ply -o b.gnm"),
    (1, "one of 3 vertices", "build far_index.obj -o b.gnm"),
    (1, "not a number", "build bad_number.obj -o b.gnm"),
    (1, "ends too early", "build no_end.stl -o b.gnm"),
    (2, "a name ending in .gnm", "build sundial.ply -o b.ply"),
    (2, "--output is required", "build sundial.ply"),
    (2, "such as 512M or 2G", "build sundial.ply -o b.gnm --memory lots"),
    (1, "expected --memory", "build sundial.ply -o b.gnm --memory 1M"),
    (2, "--tmp", "build sundial.ply -o b.gnm --tmp missing"),
    (1, "short/b.gnm", "build sundial.ply -o short/b.gnm"),
    (2, "either --triangles N or --error E", "export sundial.gnm -o b.ply"),
    (2, "--triangles", "export sundial.gnm -o b.ply --triangles few"),
    (2, "a name ending in .ply", "export sundial.gnm -o b.stl --error 1"),
    (2, "a name ending in .glb", "export sundial.gnm -o b.ply --format glb --error 1"),
    (2, "3dtiles writes all levels of detail", "export sundial.gnm -o tiles --format 3dtiles --error 1"),
    (2, "expected a memory size", "export sundial.gnm -o tiles --format 3dtiles --memory lots"),
    (1, "bad latitude", "export sundial.gnm -o tiles --format 3dtiles --geodetic 91,0,0"),
    (1, "found other files", "export sundial.gnm -o . --format 3dtiles"),
    (2, "--format: obj not in {ply,glb,3dtiles}", "export sundial.gnm -o b.ply --format obj --error 1"),
    (2, "walk, orbit, flyby, approach or source", "path sundial.gnm --kind dance -o p.json"),
    (2, "--path is required", "bench sundial.gnm"),
    (1, "No such file", "bench sundial.gnm --path missing.json"),
    (1, "list.json", "bench sundial.gnm --path list.json"),
    (1, "no_keys.json", "bench sundial.gnm --path no_keys.json"),
    (2, "--warp", "bench sundial.gnm --path path.json --warp none,"),
    (1, "No such file", "bench sundial.gnm --path path.json --baseline missing.json"),
    (2, "{statue,plant,planes}", "make house -o b.ply"),
    (2, "expected at least", "make plant --triangles 3 -o b.ply"),
    (1, "No such file", "verify sundial.gnm --source missing.ply"),
    (1, "No such file", "theory eval missing.json"),
]  # fmt: skip


class WrongInputs(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        for name, text in FILES.items():
            (cls.place / name).write_text(text)
        (cls.place / "folder").mkdir()
        model = cls.sundial.read_bytes()
        (cls.place / "cut_off.gnm").write_bytes(model[: len(model) // 2])
        (cls.place / "damaged.gnm").write_bytes(model[:20] + bytes(32) + model[52:])
        for name, source in (("sundial.ply", "models/sundial.ply"), ("path.json", "paths/sundial_orbit.json"),
                             ("camera.json", "cameras/sundial_low.json")):  # fmt: skip
            (cls.place / name).write_bytes((DATA / source).read_bytes())
        cls.before = sorted(os.listdir(cls.place.path))

    def test_each_is_told_in_one_line_what_to_do(self):
        self.assertGreaterEqual(len(ROWS), 60)
        for code, said, words in ROWS:
            with self.subTest(words):
                result = self.expect(code, said, *words.split(), cwd=self.place.path)
                if not words.startswith("verify"):  # which prints its table all the same
                    self.assertEqual(result.stdout, "")
                self.assertLess(len(result.stderr), 240, "a line that is read")
                if os.environ.get("SHOW_LINES"):
                    print(f"$ gnomon {words}\n  {result.stderr}", end="")
        self.assertEqual(sorted(os.listdir(self.place.path)), self.before, "something was left behind")

    def test_what_is_not_kept_is_named_once(self):
        rows = "0 0 0 255 0 0 9 0.5\n1 0 0 255 0 0 9 0.5\n0 1 0 255 0 0 9 0.5\n"
        vertex = PLY.format(3) + "".join(f"property uchar {name}\n" for name in ("red", "green", "blue", "alpha"))
        face = FACES.format(1).replace("end_header\n", "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n")
        (self.place / "rich.ply").write_text(vertex + "property float quality\n" + face + rows + "3 0 1 2 1 2 3\n")
        (self.place / "rich.obj").write_text(
            "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nusemtl red\nf 1/1 2/2 3/1\n")  # fmt: skip
        (self.place / "rich.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n")
        for mesh, kept in (
            ("rich.ply", {"alpha (3)", "vertex quality (3)", "face colours (1)"}),
            ("rich.obj", {"texture coordinates (2)", "material libraries that are not there (1)",
                          "materials that no library has (1)"}),
            ("rich.off", {"face colours by their numbers in a table (1)"}),
            ("sundial.ply", set()),
        ):
            told = run("build", self.place / mesh, "-o", self.place / "rich.gnm").stdout.splitlines()
            named = [line.removeprefix("not kept: ") for line in told if line.startswith("not kept: ")]
            self.assertEqual(set(named), kept, mesh)
            self.assertEqual(len(named), len(kept), mesh)

    def test_progress_is_shown_by_every_command_and_never_passes_the_end(self):
        made = self.place / "made"
        for words in (
            ("make", "plant", "--triangles", "20k", "-o", f"{made}.ply"),
            ("build", f"{made}.ply", "-o", f"{made}.gnm"),
            ("info", f"{made}.gnm"),
            ("verify", f"{made}.gnm", "--cuts", "2"),
            ("export", f"{made}.gnm", "-o", f"{made}2.ply", "--triangles", "5000"),
            ("path", f"{made}.gnm", "--kind", "walk", "-o", f"{made}.json"),
            ("render", f"{made}.gnm", "-o", f"{made}.png", "--size", "64x64"),
            ("explain", f"{made}.gnm"),
            ("measure", f"{made}.gnm", "--point", "0,0,0", "--point", "1,0,0"),
            ("bench", f"{made}.gnm", "--path", f"{made}.json", "--frames", "2", "--size", "64x64"),
            ("theory", "table", "--near", "1", "--far", "10", "--fov-y", "60", "--light", "1,2,3"),
        ):
            told = run(*words, "--progress", "json")
            self.assertEqual(told.returncode, 0, f"{words}: {told.stderr}")
            lines = [json.loads(line) for line in told.stderr.splitlines() if line.startswith("{")]
            for line in lines:
                self.assertLessEqual(line["done"], line["total"], words)
            if words[0] not in ("info", "explain", "theory"):  # these take no time
                self.assertTrue(lines, words)


if __name__ == "__main__":
    unittest.main()

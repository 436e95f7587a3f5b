"""Pictures in number: files along a path and all around, the y4m stream of the same, and a path's camera at a time."""
import json
import pathlib
import re
import shlex
import shutil
import struct
import subprocess
import unittest
import zlib

from program import DATA, GNOMON, ProgramTest

PATH = DATA / "paths/sundial_orbit.json"
SIZE = ("--size", "48x32", "--shadow-texels", "128x128")


def png(path):
    """Rows of (r, g, b) of an 8-bit RGB PNG."""
    data, at, packed = pathlib.Path(path).read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", data[at + 8 : at + 18])
            assert (depth, color) == (8, 2)
        if kind == b"IDAT":
            packed += data[at + 8 : at + 8 + length]
        at += length + 12
    raw, stride, rows, above = zlib.decompress(packed), 3 * width, [], bytes(3 * width)
    for y in range(height):
        kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for i in range(stride):
            a, b, c = row[i - 3] if i >= 3 else 0, above[i], above[i - 3] if i >= 3 else 0
            paeth = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
            row[i] = (row[i] + (0, a, b, (a + b) // 2, paeth)[kind]) % 256
        rows.append([tuple(row[i : i + 3]) for i in range(0, stride, 3)])
        above = bytes(row)
    return rows


def yuv(r, g, b):
    """BT.709 in the limited range, by its definition."""
    y = 0.2126 * r + 0.7152 * g + 0.0722 * b
    return 16 + 219 / 255 * y, 128 + 224 / 255 * 0.5 * (b - y) / (1 - 0.0722), 128 + 224 / 255 * 0.5 * (r - y) / (1 - 0.2126)


class Series(ProgramTest):
    def pictures(self, stem):
        return [path.read_bytes() for path in sorted(self.place.path.glob(f"{stem}*.png"))]

    def test_a_path_is_drawn_frame_by_frame_as_a_stream_has_it(self):
        words = ("render", self.sundial, "--path", PATH, "--frames", "3", *SIZE)
        self.expect(0, "", *words, "-o", self.place / "walk%03d.png")
        self.assertEqual(sorted(path.name for path in self.place.path.glob("walk*")), [f"walk00{i}.png" for i in range(3)])
        self.assertEqual(len(set(self.pictures("walk"))), 3, "a loop draws no picture twice")
        stream = subprocess.run([GNOMON, *map(str, words), "-o", "-"], capture_output=True, timeout=60)
        self.assertEqual(stream.returncode, 0, stream.stderr)
        head, _, rest = stream.stdout.partition(b"\n")
        times = [key["time"] for key in json.loads(PATH.read_text())["keyframes"]]
        rate = round(1000 * 3 / (times[-1] - times[0]))
        self.assertEqual(head, f"YUV4MPEG2 W48 H32 F{rate}:1000 Ip A1:1 C444 XCOLORRANGE=LIMITED".encode())
        frame = 6 + 3 * 48 * 32
        self.assertEqual(len(rest), 3 * frame)
        for i in range(3):
            self.assertEqual(rest[i * frame : i * frame + 6], b"FRAME\n")
            planes = rest[i * frame + 6 : (i + 1) * frame]
            pixels = [pixel for row in png(self.place / f"walk00{i}.png") for pixel in row]
            for place, pixel in enumerate(pixels):
                for plane, value in enumerate(yuv(*pixel)):
                    self.assertLessEqual(abs(planes[plane * 48 * 32 + place] - value), 0.51, pixel)

    @unittest.skipUnless(shutil.which("ffmpeg"), "there is no ffmpeg")
    def test_a_video_shows_the_colours_of_the_pictures(self):
        """As the page about looks says: through ffmpeg, of an odd size too, and back by the tags of the video."""
        colors = [(191, 64, 32), (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255), (16, 96, 160)]
        for number, color in enumerate(colors):
            size = "48x32" if number % 2 == 0 else "47x33"
            drawn = ("render", self.sundial, "--size", size, "--background", "#%02x%02x%02x" % color, "--turntable", "2")
            away = ("--eye", "0,50,0", "--target", "0,99,1")  # nothing but the background
            stream = subprocess.run([GNOMON, *map(str, drawn), *away, "-o", "-"], capture_output=True, timeout=60)
            self.assertEqual(stream.returncode, 0, stream.stderr)
            video = self.place / f"color{number}.mp4"
            line = re.search(r"\| (ffmpeg -i - .*) turn.mp4", (DATA.parent / "docs/guide.md").read_text())[1]
            made = subprocess.run([*shlex.split(line), "-v", "error", "-y", video], input=stream.stdout, timeout=60)
            self.assertEqual(made.returncode, 0)
            back = ("ffmpeg", "-v", "error", "-i", video, "-f", "rawvideo", "-pix_fmt", "rgb24", "-")
            shown = subprocess.run(back, capture_output=True, timeout=60).stdout
            middle = 3 * (16 * 48 + 24)
            for got, meant in zip(shown[middle : middle + 3], color):
                self.assertLessEqual(abs(got - meant), 2, f"{color} is shown as {tuple(shown[middle:middle + 3])}")

    def test_a_turntable_goes_around_and_begins_where_it_is_told(self):
        self.expect(0, "", "render", self.sundial, *SIZE, "--turntable", "4", "-o", self.place / "turn%d.png")
        self.expect(0, "", "render", self.sundial, *SIZE, "--turntable", "2", "-o", self.place / "half%d.png")
        turned = self.pictures("turn")
        self.assertEqual(len(turned), 4)
        self.assertEqual(len(set(turned)), 4)
        self.assertEqual(turned[::2], self.pictures("half"), "framed for the whole turn, not for the first picture")
        pose = ("--eye", "3,9,20", "--target", "0,1,0")
        self.expect(0, "", "render", self.sundial, *SIZE, *pose, "--turntable", "2", "-o", self.place / "posed%d.png")
        self.expect(0, "", "render", self.sundial, *SIZE, *pose, "-o", self.place / "alone.png")
        self.assertEqual(self.pictures("posed")[0], (self.place / "alone.png").read_bytes())

    def test_a_camera_of_a_path_is_that_of_its_frame(self):
        times = [key["time"] for key in json.loads(PATH.read_text())["keyframes"]]
        self.expect(0, "", "render", self.sundial, *SIZE, "--path", PATH, "--frames", "3", "-o", self.place / "of%d.png")
        second = times[0] + (times[-1] - times[0]) / 3  # of three frames of a loop
        self.expect(0, "", "render", self.sundial, *SIZE, "--camera", PATH, "--time", second, "-o", self.place / "at.png")
        self.assertEqual((self.place / "at.png").read_bytes(), (self.place / "of1.png").read_bytes())

    def test_light_has_as_many_directions_as_show(self):
        def drawn(name, *words):
            self.expect(0, "", "render", self.sundial, *SIZE, "--samples", "4", "-o", self.place / name, *words)
            return (self.place / name).read_bytes()

        def planned(*words):
            return json.loads(self.expect(0, "", "explain", self.sundial, *SIZE, "--json", *words).stdout)

        point, soft = drawn("point.png"), ("--sun-angle", "20", "--light-error", "0.2")
        self.assertEqual(point, drawn("off.png", "--sun-angle", "0", "--sky", "0"))
        self.assertEqual(planned(*soft)["light_directions"], 16)
        self.assertNotEqual(point, drawn("soft.png", *soft))
        self.assertEqual(drawn("soft.png", *soft), drawn("again.png", *soft, "--threads", "1"))
        self.assertEqual(point, drawn("narrow.png", "--sun-angle", "0.001"))
        omitted = planned("--sun-angle", "0.001")["omitted"]
        self.assertIn("0.47 pixels", {each["effect"]: each["reason"] for each in omitted}["penumbrae"])
        sky = ("--sky", "6,overcast")
        self.assertEqual(planned(*sky)["sky_directions"], 6)
        self.assertEqual(drawn("sky.png", *sky), drawn("again.png", *sky, "--threads", "1"))
        self.assertNotEqual(drawn("sky.png", *sky), point)

    def test_samples_are_sixteen_where_nothing_is_said(self):
        def drawn(name, *words):
            self.expect(0, "", "render", self.sundial, *SIZE, "-o", self.place / name, *words)
            return (self.place / name).read_bytes()

        usual, one = drawn("usual.png"), drawn("one.png", "--samples", "1")
        self.assertEqual(usual, drawn("sixteen.png", "--samples", "16", "--threads", "1"))
        self.assertNotEqual(usual, one)
        for words in (("--depth", self.place / "d.pfm"), ("--stats", self.place / "s.json"),
                      ("--reference", self.place / "one.png", "--reference-threshold", "0")):  # fmt: skip
            self.assertEqual(one, drawn("beside.png", *words), words)
        drawn("again.png", "--samples", "16", "--reference", self.place / "usual.png", "--reference-threshold", "0")
        row = json.loads((self.place / "s.json").read_text())
        self.assertEqual((row["image_width_drawn"], row["samples_per_pixel"]), (48, 1))
        three = ("--samples", "3", "--eye", "3,9,20")
        self.expect(0, "", "render", self.sundial, *SIZE, "--turntable", "1", "-o", self.place / "turn%d.png", *three)
        self.assertEqual(self.pictures("turn")[0], drawn("three.png", *three))

    def test_what_contradicts_itself_is_refused(self):
        out = ("-o", self.place / "no%d.png")
        for said, words in (
            ("such as frame%04d.png", ("--turntable", "3", "-o", self.place / "no.png")),
            ("such as frame%04d.png", ("--turntable", "3", "-o", self.place / "no%s.png")),
            ("such as frame%04d.png", ("--turntable", "3", "-o", self.place / "no%d_%d.png")),
            ("ending in .png", ("--turntable", "3", "-o", self.place / "no%d.jpg")),
            ("contradict", ("--turntable", "3", "--path", PATH, *out)),
            ("contradict", ("--path", PATH, "--eye", "1,2,3", *out)),
            ("--frames needs --path", ("--frames", "3", *out)),
            ("a single picture", ("--turntable", "3", "--stats", self.place / "no.json", *out)),
            ("a single frame", ("--turntable", "3", "--samples", "2", "--overlay", "lod", *out)),
            ("--time needs a path", ("--time", "1", *out)),
            ("contradict", ("--camera", PATH, "--time", "1", "--eye", "1,2,3", *out)),
        ):
            self.expect(2, said, "render", self.sundial, *SIZE, *words)
        self.assertEqual(list(self.place.path.glob("no*")), [])


if __name__ == "__main__":
    unittest.main()

"""Models on servers: what is read of them is what lies on disk, and what goes wrong is one line and an end."""
import csv
import json
import os
import pathlib
import shutil
import ssl
import subprocess
import sys
import threading
import time
import unittest
import unittest.mock

from program import DATA, ProgramTest, run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "hierarchy/source"))
from range_server import RangeServer  # noqa: E402

VIEW = ("--size", "160x120", "--shadow-texels", "256x256", "--error-pixels", "0.3")
WALK = ("--path", DATA / "paths/sundial_orbit.json", "--frames", "6", "--warmup", "0", *VIEW)
# What a run reads beside pages: its head and its tail, in which tables are.
BESIDE_PAGES = 66 << 10


class HttpTest(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.model = "model.gnm"
        built = run("make", "plant", "--triangles", "120k", "-o", cls.place / "model.ply")
        assert built.returncode == 0, built.stderr
        built = run("build", cls.place / "model.ply", "-o", cls.place / cls.model)
        assert built.returncode == 0, built.stderr
        cls.disk = cls.place / cls.model
        drawn = run("render", cls.disk, "-o", cls.place / "disk.png", "--stats", cls.place / "disk.json", *VIEW)
        assert drawn.returncode == 0, drawn.stderr
        cls.picture = (cls.place / "disk.png").read_bytes()
        cls.bytes_read = json.loads((cls.place / "disk.json").read_text())["bytes_read"]
        cls.environment = unittest.mock.patch.dict(
            os.environ, XDG_CACHE_HOME=str(cls.place / "cache"), NO_PROXY="127.0.0.1", no_proxy="127.0.0.1")
        cls.environment.start()

    @classmethod
    def tearDownClass(cls):
        cls.environment.stop()
        super().tearDownClass()

    def setUp(self):
        shutil.rmtree(self.place / "cache", ignore_errors=True)
        self.server = RangeServer(self.place.path)
        self.server.__enter__()
        self.faults = self.server.faults
        self.address = self.server.address(self.model)

    def tearDown(self):
        self.server.__exit__()

    def render(self, *words, code=0, said=""):
        """What was drawn of the server's model, and the row of the log."""
        output, row = self.place / "http.png", self.place / "http.json"
        result = self.expect(code, said, "render", self.address, "-o", output, "--stats", row, *VIEW, *words)
        return (output.read_bytes(), json.loads(row.read_text()), result.stderr) if code == 0 else None

    def expect_refused(self, said, *words):
        """In one line, and soon: the server is one that is not worth waiting for."""
        begun = time.monotonic()
        result = self.expect(1, said, *(words or ("info", self.address)))
        self.assertIn("http", result.stderr)
        self.assertLess(time.monotonic() - begun, 60)

    def test_pictures_are_those_from_disk_and_no_byte_is_read_twice(self):
        picture, row, said = self.render()
        self.assertEqual((picture, said), (self.picture, ""))
        self.assertEqual(row["bytes_read"], self.bytes_read)
        self.assertLessEqual(self.server.body_bytes, 1.05 * self.bytes_read + BESIDE_PAGES)
        self.assertEqual(len(set(self.server.ranges_sent)), len(self.server.ranges_sent))
        asked = self.server.requests
        self.assertEqual(self.render()[0], self.picture)
        self.assertEqual(self.server.requests, asked + 1, "all but the first question is answered from the cache")

    def test_the_cache_keeps_to_its_cap_and_forgives_damage(self):
        self.render("--http-cache", "0")
        self.assertFalse((self.place / "cache").exists())
        cap = 300 << 10
        self.assertEqual(self.render("--http-cache", str(cap))[0], self.picture)
        files = [file for file in (self.place / "cache").rglob("*") if file.is_file()]
        self.assertGreater(len(files), 1)
        self.assertLessEqual(sum(file.stat().st_size for file in files), cap)
        self.assertEqual(self.render()[0], self.picture)
        for file in (self.place / "cache").rglob("*"):
            if file.is_file():
                kept = bytearray(file.read_bytes())
                kept[len(kept) // 2] ^= 1
                file.write_bytes(kept)
        self.assertEqual(self.render()[0::2], (self.picture, ""))

    def test_every_command_that_reads_a_model_reads_addresses(self):
        for words in (("info", "--json"), ("verify", "--cuts", "3", "--json"), ("explain", "--json"),
                      ("measure", "--pixel", "80,60", "--pixel", "60,60", "--csv", *VIEW)):
            local, remote = (run(words[0], model, *words[1:]) for model in (self.disk, self.address))
            self.assertEqual(remote.returncode, 0, remote.stderr)
            self.assertEqual(remote.stdout.replace(self.address, str(self.disk)), local.stdout)
        for command, name in ((("export", "--error", "0.5"), "cut.ply"), (("path", "--kind", "orbit"), "path.json")):
            made = []
            for model in (self.disk, self.address):
                self.expect(0, "", command[0], model, *command[1:], "-o", self.place / name)
                made.append((self.place / name).read_bytes())
            self.assertEqual(*made)

    def walk(self, model):
        self.expect(0, "", "bench", model, *WALK, "--csv", self.place / "walk.csv", "--images", self.place / "images")
        timed = ("_ms", "run", "model")
        with open(self.place / "walk.csv", newline="") as file:
            rows = [{k: v for k, v in row.items() if not k.endswith(timed)} for row in csv.DictReader(file)]
        return rows, [image.read_bytes() for image in sorted((self.place / "images").iterdir())]

    def test_a_walk_goes_on_after_the_server_was_killed(self):
        expected = self.walk(self.disk)
        killed = threading.Event()

        def restart():
            port = self.server.server_port
            self.server.__exit__()
            time.sleep(0.6)
            self.server = RangeServer(self.place.path, port)
            self.server.__enter__()

        def kill(number):
            if number == 8 and not killed.is_set():
                killed.set()
                threading.Thread(target=restart, daemon=True).start()
                time.sleep(0.2)

        self.faults.status = kill
        self.assertEqual(self.walk(self.address), expected)
        self.assertTrue(killed.is_set())

    def test_servers_that_are_busy_or_break_off_are_asked_again(self):
        self.faults.status = lambda number: 503 if number % 3 == 2 else None
        self.assertEqual(self.render()[0::2], (self.picture, ""))
        shutil.rmtree(self.place / "cache")
        self.faults.status = lambda number: setattr(self.faults, "body", "whole" if number % 3 else "short")
        self.assertEqual(self.render()[0::2], (self.picture, ""))

    def test_a_view_over_a_slow_line_sharpens_until_it_is_complete(self):
        framed = json.loads((DATA / "paths/sundial_orbit.json").read_text())
        bounds = json.loads(run("info", self.disk, "--json").stdout)["bounds"]
        middle = [(a + b) / 2 for a, b in zip(bounds["min"], bounds["max"])]
        still = {**framed["keyframes"][0], "target": middle, "eye": [
            m + f * (b - a) for m, a, b, f in zip(middle, bounds["min"], bounds["max"], (0.3, 1, 1))]}
        path = self.place / "still.json"
        path.write_text(json.dumps({**framed, "loop": False, "interpolation": "linear",
                                    "keyframes": [{**still, "time": 0}, {**still, "time": 4}]}))
        words = ("--path", path, "--frames", "40", "--warmup", "0", *VIEW)
        self.expect(0, "", "bench", self.disk, *words, "--csv", self.place / "disk.csv")
        self.faults.mbit, self.faults.latency = 2, 0.05
        self.expect(0, "", "bench", self.address, *words, "--no-wait", "--csv", self.place / "slow.csv")
        with open(self.place / "disk.csv", newline="") as disk, open(self.place / "slow.csv", newline="") as slow:
            whole, rows = next(csv.DictReader(disk)), list(csv.DictReader(slow))
        # The nearest point that is drawn, from which the rule measures, comes out the same but for the last digits.
        errors = [round(float(row["achieved_error_pixels"]), 6) for row in rows]
        self.assertGreater(int(rows[0]["pages_missing"]), 0, "the first picture does not wait")
        self.assertEqual(errors, sorted(errors, reverse=True), "it never gets coarser")
        self.assertGreater(len(set(errors)), 3, "it sharpens in steps")
        for name in ("pages_missing", "image_triangles", "achieved_error_pixels"):
            self.assertAlmostEqual(float(rows[-1][name]), float(whole[name]), 6, "in the end it is what disk gives")

    def pages_asked_for(self):
        self.render()
        shutil.rmtree(self.place / "cache")
        size = self.disk.stat().st_size
        return [first for first, _ in self.server.ranges_sent if 1024 < first < size - (64 << 10)]

    def test_a_damaged_page_draws_its_parents_and_damage_on_the_way_nothing(self):
        page = self.damage_that_shows()
        spoilt = []

        def spoil(path, first, data):
            if first == page:
                spoilt.append(first)
                return data[:-1] + bytes([data[-1] ^ 1])
            return data

        self.faults.damage = spoil
        picture, row, said = self.render()
        self.assertEqual(row["pages_damaged"], 1)
        self.assertEqual(len(spoilt), 2, "it was asked for again")
        self.assertEqual(said.count("\n"), 1)
        self.assertIn("a page is damaged, coarser pages are drawn instead", said)
        self.assertEqual(picture, (self.place / "damaged.png").read_bytes())
        self.assertNotEqual(picture, self.picture)
        spoilt.clear()
        shutil.rmtree(self.place / "cache")
        self.faults.damage = lambda path, first, data: data if spoilt else spoil(path, first, data)
        self.assertEqual(self.render()[0::2], (self.picture, ""))
        asked = self.server.requests
        self.assertEqual(self.render()[0::2], (self.picture, ""), "what was damaged is not kept")
        self.assertEqual(self.server.requests, asked + 1)

    def damage_that_shows(self):
        """The place of a page without which the picture is another one; damaged.png is that one, drawn from disk. Which
        page was asked for last is chance, and it may be one of which nothing is seen."""
        for page in sorted(self.pages_asked_for(), reverse=True):
            on_disk = bytearray(self.disk.read_bytes())
            on_disk[self.end_of(page) - 1] ^= 1
            (self.place / "damaged.gnm").write_bytes(on_disk)
            self.expect(0, "damaged", "render", self.place / "damaged.gnm", "-o", self.place / "damaged.png",
                        "--stats", self.place / "damaged.json", *VIEW)
            if (self.place / "damaged.png").read_bytes() != self.picture:
                return page
        self.fail("no page shows")

    def end_of(self, page):
        return next(last for first, last in self.server.ranges_sent if first == page) + 1

    def test_what_has_changed_or_vanished_is_said(self):
        size = self.disk.stat().st_size
        self.faults.status = lambda number: setattr(self.faults, "tag", "new") if number == 3 else None
        self.render(code=1, said="changed on the server since it was opened")
        for status, said in ((404, "has no such file"), (410, "has no such file"), (403, "does not let it be read"),
                             (416, "ends earlier")):
            self.faults.status = lambda number, status=status: status if self.server.requests > begun + 1 else None
            begun = self.server.requests
            self.render("--http-cache", "0", code=1, said=said)
        self.faults.status = None
        with open(self.disk, "rb") as file, open(self.place / "short.gnm", "wb") as short:
            short.write(file.read(size - 100))
        self.expect_refused("cut off", "info", self.server.address("short.gnm"))

    def test_hostile_servers_are_left(self):
        for body, said in (("endless", "sends more bytes than it announced"), ("header", "header does not end"),
                           ("other", "sends another range"), ("crumbs", "less than it has"), ("none", ""),
                           ("encoded", "compresses its answer")):
            self.faults.body = body
            with self.subTest(body):
                self.expect_refused(said)
        self.faults.body = "whole"
        self.faults.damage = lambda path, first, data: self.set_body("crumbs" if first >= 1024 else "whole", data)
        self.faults.body = "crumbs"
        self.expect_refused("less than it has")
        self.faults.damage, self.faults.body = None, "whole"
        for status, said in ((503, "refuses"), (301, "redirect"), (400, "refuses")):
            self.faults.status = lambda number, status=status: status
            with self.subTest(status):
                self.expect_refused(said)

    def set_body(self, body, data):
        self.faults.body = body
        return data

    def test_addresses_that_are_none_and_servers_that_are_none(self):
        self.faults.ranges = False
        self.expect_refused("gives no byte ranges, by which a model is read")
        self.faults.ranges = True
        self.expect_refused("has no such file", "info", self.server.address("none.gnm"))
        self.expect_refused("not a model", "info", self.server.address("model.ply"))
        self.faults.says_when = False
        self.assertEqual(self.render()[0], self.picture)
        self.assertFalse((self.place / "cache").exists(), "nothing would tell old ranges from new ones")
        secret = self.address.replace("//", "//user:word@").replace("model", "none") + "?key=word"
        result = run("info", secret)
        self.assertEqual(result.returncode, 1)
        self.assertNotIn("word", result.stderr)
        self.server.__exit__()
        self.expect_refused("")

    def test_certificates_are_asked_for(self):
        made = subprocess.run(
            ["openssl", "req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes", "-keyout",
             self.place / "key.pem", "-out", self.place / "cert.pem", "-days", "2", "-subj", "/CN=gnomon test",
             "-addext", "subjectAltName=IP:127.0.0.1"], capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        tls = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        tls.load_cert_chain(self.place / "cert.pem", self.place / "key.pem")
        with RangeServer(self.place.path, tls=tls) as server:
            address = server.address(self.model)
            self.expect_refused("certificate", "info", address)
            trusting = run("info", address, "--cacert", self.place / "cert.pem")
            self.assertEqual(trusting.stdout, run("info", self.disk).stdout.replace(str(self.disk), address))
            self.expect_refused("", "info", address, "--cacert", self.disk)
            self.expect(2, "--cacert", "info", address, "--cacert", self.place / "none.pem")


if __name__ == "__main__":
    unittest.main()

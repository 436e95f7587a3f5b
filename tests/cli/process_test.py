"""What a process meets that is no file of ours: closed descriptors, hostile names and texts, a full stdout."""
import lzma
import os
import pathlib
import signal
import subprocess
import time
import unittest

from program import DATA, GNOMON, ProgramTest, run

IS_SANITIZED = any(name in pathlib.Path(GNOMON).read_bytes() for name in (b"__asan_init", b"__tsan_init"))
CAMERA = (DATA / "cameras/sundial_low.json").read_text()
PATH = DATA / "paths/sundial_orbit.json"
SMALL = ("--size", "8x8", "--shadow-texels", "16x16")


class Process(ProgramTest):
    def closed(self, descriptors, *words):
        """What came of GNOMON with some of its standard descriptors closed."""
        return subprocess.run(["bash", "-c", f'exec "$0" "$@" {descriptors}', GNOMON, *map(str, words)],
                              capture_output=True, text=True, timeout=60)  # fmt: skip

    def test_no_output_takes_the_place_of_a_closed_descriptor(self):
        mesh, model, made = DATA / "models/sundial.ply", self.place / "closed.gnm", self.place / "closed.ply"
        for words, output in (
            (("make", "statue", "--triangles", "1M", "--progress", "json", "-o", made), made),  # more than one line of it
            (("build", mesh, "--progress", "json", "-o", model), model),
        ):
            run(*words)
            whole = output.read_bytes()
            for descriptors in ("2>&-", "<&- 2>&-"):
                output.unlink()
                self.assertEqual(self.closed(descriptors, *words).returncode, 0)
                self.assertTrue(output.read_bytes() == whole, f"{words} {descriptors}")
        told = self.closed("<&- >&-", "build", mesh, "-o", model)
        self.assertEqual((told.returncode, told.stderr.count("\n")), (1, 1), told.stderr)
        self.assertEqual(model.read_bytes(), whole)
        made.unlink()

    @unittest.skipIf(IS_SANITIZED, "a sanitizer's library has to come first")
    def test_a_library_that_changed_floating_point_is_refused(self):
        library = os.environ["CHANGED_FLOATS_LIBRARY"]
        for how, said in (("", None), ("upward", "to nearest"), ("flushed", "subnormal numbers")):
            environment = dict(os.environ, LD_PRELOAD=library, CHANGED_FLOATS=how)
            told = subprocess.run([GNOMON, "info", self.sundial], capture_output=True, text=True, env=environment)
            if said is None:
                self.assertEqual((told.returncode, told.stderr), (0, ""))
                continue
            self.assertEqual((told.returncode, told.stderr.count("\n"), told.stdout), (1, 1, ""), told.stderr)
            self.assertIn("gnomon: floating point: a loaded library", told.stderr)
            self.assertIn(said, told.stderr)

    def test_a_full_stdout_does_not_hide_that_the_model_is_complete(self):
        model, log = self.place / "full.gnm", self.place / "full.csv"
        for words, said in (
            (("build", DATA / "models/sundial.ply", "-o", model), f"the model {model} is complete"),
            (("bench", self.sundial, "--path", PATH, *SMALL, "--frames", "1", "--csv", log), "complete"),
        ):
            with open("/dev/full", "w") as full:
                told = subprocess.run([GNOMON, *map(str, words)], stdout=full, stderr=subprocess.PIPE, text=True)
            self.assertEqual((told.returncode, told.stderr.count("\n")), (1, 1), told.stderr)
            self.assertIn("gnomon: stdout: cannot write: ", told.stderr)
            self.assertIn(said, told.stderr)
        self.expect(0, "", "info", model)
        self.assertTrue(log.exists())

    def json_refused(self, text, *said):
        bad = self.place / "bad.json"
        bad.write_text(text)
        for words in (
            ("theory", "eval", bad),
            ("explain", self.sundial, "--camera", bad),
            ("bench", self.sundial, *SMALL, "--frames", "1", "--path", bad),
            ("bench", self.sundial, *SMALL, "--frames", "1", "--path", PATH, "--baseline", bad),
        ):
            told = self.expect(1, "bad.json", *words)
            for part in said:
                self.assertIn(part, told.stderr)
            self.assertNotIn("json.exception", told.stderr)

    def test_json_that_is_nested_deep_is_refused_with_where(self):
        deep = 100_000
        self.json_refused('{"rows": ' + "[" * deep + "]" * deep + "}", "byte 72: nested too deep: expected at most 64")
        self.json_refused('{"a":' * deep + "1" + "}" * deep, "byte 320: nested too deep")
        quoted = '{"rows": [], "note": "' + "[" * 100 + '\\"' + "{" * 100 + '"}'
        rows = self.place / "quoted.json"
        rows.write_text(quoted)
        self.expect(0, "", "theory", "eval", rows)
        self.json_refused("[" * 64 + "]" * 64)

    def test_the_json_files_that_overflowed_the_stack_are_refused(self):
        faults = DATA.parent.parent / "shared/faults"
        if not faults.is_dir():
            self.skipTest("the files of shared/faults are not here")
        for name in ("deep_path", "deep_baseline", "deep_theory"):
            self.json_refused(lzma.open(faults / f"{name}.json.xz").read().decode(), "nested too deep")

    def test_json_of_too_much_is_refused(self):
        large = self.place / "large.json"
        with open(large, "wb") as file:
            file.truncate(65 << 20)
        self.expect(1, "at most 64.00 MiB", "theory", "eval", large)
        self.json_refused("{" + ",".join(f'"{i}":0' for i in range(5000)) + "}", "expected at most 4096 entries")

    def test_a_number_beyond_doubles_is_refused_in_our_own_words(self):
        for number in ("1e400", "-1e400", "9" * 400):
            self.json_refused('{"rows": [' + number + "]}", "byte 10: a number is too large", "found " + number[:20])
        tiny = self.place / "tiny.json"
        tiny.write_text('{"rows": [], "note": 1e-400}')
        self.expect(0, "", "theory", "eval", tiny)

    def test_names_and_texts_reach_the_terminal_without_controls(self):
        evil = "two\nlines \x1b[31m"
        shown = "two\\nlines \\x1b[31m"
        self.expect(1, shown, "info", self.place / evil)
        self.expect(1, shown, "render", self.place / evil, "-o", self.place / "undone.png")
        self.expect(2, shown, "render", self.sundial, "-o", self.place / "undone.png", "--light", evil)
        self.expect(2, shown, evil)
        for words in (
            ("make", "statue", "--triangles", "2k", "-o", self.place / f"{evil}.ply"),
            ("build", DATA / "models/sundial.ply", "-o", self.place / f"{evil}.gnm"),
            ("info", self.place / f"{evil}.gnm"),
            ("export", self.place / f"{evil}.gnm", "--error", "1", "-o", self.place / f"{evil}.ply"),
        ):
            told = self.expect(0, "", *words)
            self.assertIn(shown, told.stdout + told.stderr)
            self.assertNotIn("\x1b", told.stdout + told.stderr)

    def test_what_a_driver_says_of_a_shader_is_one_line(self):
        shaders = self.place / "shaders"
        subprocess.run(["cp", "-r", str(DATA.parent / "shaders"), str(shaders)], check=True)
        for shader in shaders.rglob("*.frag"):
            shader.write_text("void main() {\n  wrong;\n  twice wrong;\n}\n")
        told = self.expect(1, "this shader does not compile", "render", self.sundial, "-o", self.place / "undone.png",
                           "--backend", "osmesa", "--shaders", shaders, *SMALL)  # fmt: skip
        self.assertNotIn("\\n", told.stderr)

    def interrupted(self, signals, output, *words, ready):
        """What came of GNOMON that got `signals` once something of the name `ready` was there."""
        process = subprocess.Popen([GNOMON, *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                   text=True)  # fmt: skip
        late = time.monotonic() + 60
        while not list(self.place.path.glob(ready)) and process.poll() is None and time.monotonic() < late:
            time.sleep(0.002)
        for sent in signals:
            process.send_signal(sent)
        told = process.communicate(timeout=60)[1]
        self.assertEqual((process.returncode, told), (1, "gnomon: interrupted; nothing was left half-written\n"), words)
        self.assertFalse(output.exists())
        left = [path.name for path in self.place.path.iterdir() if ".partial" in path.name or ".building" in path.name]
        self.assertEqual(left, [], words)

    def test_every_signal_ends_a_command_and_leaves_nothing(self):
        mesh = self.place / "interrupted.ply"
        self.expect(0, "", "make", "statue", "--triangles", "200k", "-o", mesh)
        model, log = self.place / "never.gnm", self.place / "never.csv"
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE):
            self.interrupted([sent], model, "build", mesh, "-o", model, ready="never.gnm.building")
            self.interrupted([sent], log, "bench", self.sundial, "--path", PATH, *SMALL, "--frames", "1000000",
                             "--csv", log, ready="never.csv.*.partial")  # fmt: skip
        mesh.unlink()

    def test_a_command_that_polls_nothing_ends_by_a_signal_too(self):
        rows, answers = self.place / "rows.fifo", self.place / "never.json"
        os.mkfifo(rows)
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE):
            process = subprocess.Popen([GNOMON, "theory", "eval", str(rows), "-o", str(answers)],
                                       stderr=subprocess.PIPE, text=True)  # fmt: skip
            with open(rows, "w"):  # once it reads
                process.send_signal(sent)
                told = process.communicate(timeout=60)[1]
            self.assertEqual((process.returncode, told), (1, "gnomon: interrupted; nothing was left half-written\n"))
        picture, folder = self.place / "never.png", self.place / "maps"
        self.interrupted([signal.SIGTERM], picture, "render", self.sundial, "-o", picture, "--size", "4096x4096",
                         "--memory", "4G", "--shadow-depth", folder, "--oracle", ready="maps")  # fmt: skip
        self.assertFalse(folder.exists())

    @unittest.skipIf(IS_SANITIZED, "a sanitizer's library has to come first")
    def test_a_signal_before_the_libraries_are_ready_ends_it_cleanly_too(self):
        for sent in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE):
            told = subprocess.run([GNOMON, "info", self.sundial], capture_output=True, text=True, timeout=60,
                                  env=self.preloaded(RAISE_EARLY=int(sent)))  # fmt: skip
            self.assertEqual((told.returncode, told.stdout, told.stderr),
                             (1, "", "gnomon: interrupted; nothing was left half-written\n"), sent)  # fmt: skip

    @staticmethod
    def preloaded(**how):
        """An environment in which calls of the system do what `how` says."""
        return dict(os.environ, LD_PRELOAD=os.environ["FAILING_READS"], **{name: str(what) for name, what in how.items()})

    @unittest.skipIf(IS_SANITIZED, "a sanitizer's library has to come first")
    def test_what_cannot_be_removed_is_tried_again_and_told_of_by_name(self):
        model, mesh = self.place / "removed.gnm", DATA / "models/sundial.ply"
        folder = self.place / "removed.gnm.building"
        for failures, said in ((1, ""), (1000, f"cannot remove {folder}/checkpoints: Input/output error\n")):
            told = subprocess.run([GNOMON, "build", str(mesh), "-o", str(model)], capture_output=True, text=True,
                                  timeout=60, env=self.preloaded(FAIL_REMOVALS=failures))  # fmt: skip
            self.assertEqual((told.returncode, folder.exists()), (0, said != ""), told.stderr)
            self.assertTrue(told.stderr.endswith(said), told.stderr)
        self.expect(0, "", "build", mesh, "-o", model, "--resume")
        self.assertFalse(folder.exists())

    def test_a_small_limit_of_stacks_is_large_enough(self):
        mesh, model, picture = DATA / "models/colonnade.obj", self.place / "stack.gnm", self.place / "stack.png"
        pictures = []
        for limit in ("ulimit -s 64", "true"):
            for words in (("build", mesh, "-o", model), ("verify", model, "--cuts", "2"),
                          ("render", model, "-o", picture, "--size", "64x64")):  # fmt: skip
                told = subprocess.run(["bash", "-c", f'{limit}; exec "$@"', "bash", GNOMON, *map(str, words)],
                                      capture_output=True, text=True, timeout=60)  # fmt: skip
                self.assertEqual(told.returncode, 0, f"{limit} {words}: {told.stderr}")
            pictures.append((model.read_bytes(), picture.read_bytes()))
        self.assertTrue(pictures[0] == pictures[1])

    def test_no_character_of_a_name_acts_on_a_terminal(self):
        hidden = "\x1b[31m \u061c \u200b \u200d \u202e \u2066 \u2060 \ufeff \x9b \x7f \u2028 \U000e0041"
        mesh, model = self.place / f"{hidden}.ply", self.place / f"{hidden}.gnm"
        mesh.write_bytes((DATA / "models/sundial.ply").read_bytes())
        for words in (("build", mesh, "-o", model, "--progress", "json"), ("info", model), ("info", model, "--json"),
                      ("verify", model, "--cuts", "1", "--json"), ("info", self.place / f"no{hidden}.gnm"),
                      ("measure", model, "--point", "0,0,0", "--point", "1,0,0", "--json"),
                      ("build", mesh, "-o", model, "--json"), ("render", model, "-o", self.place / f"{hidden}.x")):
            told = run(*words)
            for character in told.stdout + told.stderr:
                self.assertTrue(character.isprintable() or character == "\n", f"{words}: {character!r}")

    def test_what_nohup_ignores_stays_ignored(self):
        model = self.place / "nohup.gnm"
        words = [GNOMON, "build", str(DATA / "models/sundial.ply"), "-o", str(model)]
        told = subprocess.run(["bash", "-c", 'trap "" HUP PIPE; "$@" & kill -HUP $!; wait $!', "bash", *words],
                              capture_output=True, timeout=60)  # fmt: skip
        self.assertEqual((told.returncode, model.exists()), (0, True), told.stderr)

    def test_what_others_put_beside_temporary_files_stays_and_is_told_of(self):
        model, mesh = self.place / "shared.gnm", DATA / "models/sundial.ply"
        folder = self.place / "shared.gnm.building"
        folder.mkdir()
        (folder / "notes.txt").write_text("mine")
        (folder / "scratch.0").write_text("left by a killed build")
        told = self.expect(0, "shared.gnm.building: it stays", "build", mesh, "-o", model)
        self.assertEqual(told.stderr.count("\n"), 1)
        self.assertEqual([path.name for path in folder.iterdir()], ["notes.txt"])
        self.assertEqual((folder / "notes.txt").read_text(), "mine")
        (folder / "notes.txt").unlink()
        self.assertEqual(self.expect(0, "", "build", mesh, "-o", model, "--resume").stderr, "")
        self.assertFalse(folder.exists())

    def test_no_link_among_temporary_files_is_written_through(self):
        model, mesh, victim = self.place / "linked.gnm", DATA / "models/sundial.ply", self.place / "victim"
        folder = self.place / "linked.gnm.building"
        victim.write_text("precious")
        folder.symlink_to(self.place.path)
        self.expect(1, "cannot use this folder for temporary files", "build", mesh, "-o", model)
        folder.unlink()
        for name in ("scratch.0", "checkpoints"):
            folder.mkdir(exist_ok=True)
            (folder / name).symlink_to(victim)
            self.expect(0, "", "build", mesh, "-o", model)
            self.assertFalse(folder.exists())
        for name, more in (("lock", []), ("checkpoints", ["--resume"])):
            folder.mkdir()
            (folder / name).symlink_to(victim)
            self.expect(1, "cannot open", "build", mesh, "-o", model, *more)
            (folder / name).unlink()
            folder.rmdir() if not any(folder.iterdir()) else [(folder / "lock").unlink(), folder.rmdir()]
        self.assertEqual(victim.read_text(), "precious")

    def test_no_folder_stays_where_its_first_write_fails(self):
        model = self.place / "unwritten.gnm"
        told = subprocess.run(["bash", "-c", 'ulimit -f 0; exec "$@"', "bash", GNOMON, "build",
                               str(DATA / "models/sundial.ply"), "-o", str(model)],
                              capture_output=True, text=True, timeout=60)  # fmt: skip
        self.assertEqual((told.returncode, told.stderr.count("\n")), (1, 1), told.stderr)
        self.assertIn("File too large", told.stderr)
        self.assertEqual(list(self.place.path.glob("unwritten*")), [])

    def test_an_output_keeps_its_permissions(self):
        model = self.place / "private.gnm"
        for mode in (0o600, 0o640):
            model.write_text("before")
            model.chmod(mode)
            self.expect(0, "", "build", DATA / "models/sundial.ply", "-o", model)
            self.assertEqual(model.stat().st_mode & 0o7777, mode)

    def test_too_little_address_space_is_one_line(self):
        def limited(mebibytes, *words):
            shell = f'ulimit -c 0; ulimit -v {mebibytes << 10}; exec "$@"'
            return subprocess.run(["bash", "-c", shell, "bash", GNOMON, *map(str, words)], capture_output=True, text=True,
                                  timeout=60)  # fmt: skip

        if limited(200, "--version").returncode != 0:
            self.skipTest("this program needs more to start")
        bench = ("bench", self.sundial, "--path", PATH, *SMALL, "--frames", "1", "--warmup", "0", "--backend")
        codes = set()
        for mebibytes, words in (
            *((size, (*bench, "software")) for size in (90, 110, 130, 200)),
            *((size, (*bench, "osmesa")) for size in (260, 300, 500, 550, 900)),
            *((size, ("build", DATA / "models/sundial.ply", "-o", self.place / "limited.gnm")) for size in (90, 120)),
            *((size, ("verify", self.sundial, "--cuts", "1")) for size in (90, 120)),
        ):
            told = limited(mebibytes, *words)
            codes.add(told.returncode)
            self.assertIn(told.returncode, (0, 1), f"{mebibytes} MiB, {words}: {told.stderr}")
            if told.returncode:
                self.assertEqual((told.stderr[:8], told.stderr.count("\n")), ("gnomon: ", 1), told.stderr)
        self.assertEqual(codes, {0, 1})


if __name__ == "__main__":
    unittest.main()

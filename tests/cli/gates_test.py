"""The gates of a bench: each one fails where it should, with its exit code, and the files of other tools are readable."""
import json
import os
import pathlib
import shutil
import stat
import subprocess
import sys
import unittest

from program import DATA, GNOMON, ProgramTest

PATH = DATA / "paths/sundial_orbit.json"
MESH = DATA / "models/sundial.ply"
SMALL = ("--size", "48x48", "--frames", "4", "--warmup", "1", "--threads", "1")
FAR = ("--fail-above", "1e9")  # no time gate of medians fails
LONG = "250000"  # microseconds, many times the time of a frame
COMPARE = pathlib.Path("/usr/share/benchmark/compare.py")


class Gates(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.old = cls.place / "old_gnomon"
        shutil.copy(GNOMON, cls.old)  # the same program with another name

    def bench(self, code, said, *words, **options):
        usual = [word for option, value in zip(SMALL[::2], SMALL[1::2]) if option not in words for word in (option, value)]
        return self.expect(code, said, "bench", self.sundial, "--path", PATH, *usual, *words, **options)

    def written(self, *words, **options):
        """The JSON of a bench, and the file."""
        file = self.place / "written.json"
        self.bench(0, "", "--json-file", file, *words, **options)
        return json.loads(file.read_text()), file

    def verdict(self, code, *words, **options):
        """The quantities of the failing gates."""
        file = self.place / "verdict.json"
        self.bench(code, "", *words, "--verdict", file, **options)
        document = json.loads(file.read_text())
        self.assertEqual(document["exit_code"], code)
        self.assertEqual(document["verdict"] == "fail", code != 0)
        return {gate["quantity"] for gate in document["gates"] if gate["fails"]}

    def changed(self, change, *words):
        """A baseline of this program, after `change` of each entry."""
        document, file = self.written(*words)
        for entry in document["benchmarks"]:
            change(entry)
        file.write_text(json.dumps(document))
        return file

    def defaulting(self, *extra):
        """A program with other defaults: it adds the options `extra`, of which its results say nothing."""
        script = self.place / "defaulting.py"
        names = [option[2:].replace("-", "_") for option in extra[::2]]
        script.write_text(
            f"#!{sys.executable}\nimport json, re, subprocess, sys\n"
            f"words = sys.argv[1:]\ncode = subprocess.run(['{GNOMON}', *words, *{list(extra)!r}]).returncode\n"
            "file = words[words.index('--json-file') + 1]\n"
            "document = json.load(open(file))\ncontext = document['context']\n"
            f"given = [each for each in context['options'].split(', ') if each.split(':')[0] not in {names!r}]\n"
            "context['options'] = ', '.join(given) or 'none'\n"
            "for entry in document['benchmarks']:\n"
            "    for key in ('name', 'run_name'):\n"
            f"        for name in {names!r}:\n"
            "            entry[key] = re.sub(',' + name + ':[^/,]*', '', entry[key])\n"
            "        entry[key] = re.sub('/[^/]*px/', '/default/', entry[key])\n"
            "json.dump(document, open(file, 'w'))\nsys.exit(code)\n")
        script.chmod(script.stat().st_mode | stat.S_IXUSR)
        return script

    def test_the_same_program_passes(self):
        _, before = self.written("--repetitions", "3")
        self.assertEqual(self.verdict(0, "--repetitions", "3", "--baseline", before, *FAR), set())
        told = self.bench(0, "", "--against", self.old, "--repetitions", "2", "--shadows", "maps", *FAR)
        for quantity in ("triangles", "pages", "aliasing bound", "median", "99th percentile", "peak memory"):
            self.assertIn(quantity, told.stdout)

    def test_each_time_gate_fails_with_three(self):
        slow = {**os.environ, "LD_PRELOAD": os.environ["SLOW_FRAMES"], "SLOW_PROGRAM": str(pathlib.Path(GNOMON).resolve())}
        against = ("--against", self.old, "--repetitions", "3")
        failing = self.verdict(3, *against, env={**slow, "SLOW_MICROSECONDS": LONG})
        self.assertLessEqual({"median", "99th percentile"}, failing)
        failing = self.verdict(3, *against[:2], "--repetitions", "6", "--frames", "40", *FAR[:1], "50",
                               env={**slow, "SLOW_MICROSECONDS": "60000", "SLOW_EVERY": "3"})  # fmt: skip
        self.assertIn("share of frames above twice the median", failing)
        failing = self.verdict(3, *against, *FAR[:1], "50", env={**slow, "SLOW_BYTES": str(1 << 29)})
        self.assertIn("peak memory", failing)
        early = self.changed(lambda entry: entry.update(process_first_picture_ms=1e-6))
        self.assertEqual(self.verdict(3, "--baseline", early, "--fail-above", "1e6"), {"time to the first picture"})
        self.bench(3, "budget", "--budget-ms", "0.0001")
        self.bench(0, "", "--budget-ms", "1e9")

    def test_each_gate_of_work_and_accuracy_fails_with_four(self):
        for key, quantity in (("work_triangles", "triangles"), ("work_fragments", "fragments"), ("work_pages", "pages"),
                              ("work_bytes_read", "bytes_read"), ("error_promised_aliasing", "aliasing bound")):  # fmt: skip
            less = self.changed(lambda entry, key=key: entry.update({key: 0.99 * entry[key]}), "--shadows", "maps")
            self.assertEqual(self.verdict(4, "--baseline", less, "--shadows", "maps", *FAR), {quantity})
        words = ("--shadows", "exact")
        less = self.changed(lambda entry: entry.update(work_sample_tests=0.99 * entry["work_sample_tests"]), *words)
        self.assertEqual(self.verdict(4, "--baseline", less, *words, *FAR), {"sample_tests"})
        self.assertEqual(self.verdict(0, "--baseline", less, *words, *FAR, "--work-above", "0,sample_tests=2"), set())
        words = ("--oracle", "--shadows", "maps", "--shadow-texels", "64x64")
        for key, quantity in (("wrong_pixels_all", "wrong pixels"), ("image_difference", "image difference")):
            less = self.changed(lambda entry, key="error_" + key: entry.update({key: 0.99 * entry[key]}), *words)
            with_them = ("--oracle", "--shadows", "maps", "--shadow-texels", "64x64", *FAR)
            self.assertEqual(self.verdict(4, "--baseline", less, *with_them), {quantity})

    def test_programs_with_other_defaults_fail_with_four(self):
        maps = ("--shadows", "maps", "--repetitions", "1", *FAR)
        finer = self.defaulting("--shadow-texels", "8192x8192")
        self.assertIn("aliasing bound", self.verdict(4, "--against", finer, *maps))
        coarser = self.defaulting("--error-pixels", "100000")
        self.assertIn("triangles", self.verdict(4, "--against", coarser, *maps))
        more = self.defaulting("--cull-casters", "off")  # in the roles of old and new
        self.assertEqual(self.verdict(0, "--against", more, *maps), set())

    def test_what_is_not_comparable_fails_with_five(self):
        document, before = self.written()
        for key in ("model_content_hash", "path_content_hash", "image_size", "options", "picture", "cpu",
                    "library_build_type", "threads", "frames"):  # fmt: skip
            other = self.place / "other.json"
            other.write_text(json.dumps({**document, "context": {**document["context"], key: "another"}}))
            told = self.bench(5, key, "--baseline", other, *FAR)
            self.assertEqual(told.stdout, "", "it has walked first")
            allowed = ("--other-machine",) if key == "cpu" else ()
            self.bench(0 if allowed else 5, "" if allowed else key, "--baseline", other, *FAR, *allowed)
        two = self.changed(lambda entry: None, "--error-pixels", "1,2")
        self.assertEqual(self.verdict(5, "--baseline", two, "--error-pixels", "1,3", *FAR), {"run"})
        self.assertIn("model_source", self.verdict(
            5, "--against", self.old, "--repetitions", "1", *FAR, "--against-model", self.place / "colonnade.gnm"))

    def test_another_model_of_the_same_source_is_allowed(self):
        other = self.place / "other.gnm"
        self.expect(0, "", "build", MESH, "-o", other, "--cluster-triangles", "64")
        words = ("--repetitions", "1", *FAR, "--work-above", "1000")
        self.assertEqual(self.verdict(0, "--against", self.old, "--against-model", other, *words), set())

    def test_code_five_comes_before_four_and_four_before_three_and_all_are_listed(self):
        worse = self.changed(lambda entry: entry.update(
            work_triangles=1, error_promised_aliasing=1e-6, frame_ms=[1e-9] * 4, frame_cpu_ms=[1e-9] * 4), "--shadows", "maps")
        failing = self.verdict(4, "--baseline", worse, "--shadows", "maps")
        self.assertLessEqual({"triangles", "aliasing bound", "median"}, failing)
        document = json.loads(worse.read_text())
        document["benchmarks"].append({**document["benchmarks"][0], "name": "gone"})
        worse.write_text(json.dumps(document))
        failing = self.verdict(5, "--baseline", worse, "--shadows", "maps")
        self.assertLessEqual({"run", "triangles", "aliasing bound", "median"}, failing)

    def test_an_undecided_gate_fails_if_asked(self):
        _, before = self.written("--repetitions", "2")  # the interval of two repetitions is very wide
        self.bench(3, "median", "--repetitions", "2", "--baseline", before, "--fail-above", "0", "--undecided", "fail")

    def test_a_limit_without_a_comparison_is_refused(self):
        for words in (("--fail-above", "3"), ("--work-above", "3"), ("--undecided", "fail"), ("--other-machine",)):
            self.bench(2, words[0], *words)
        for value in ("x", "-1", "1,2", "0,nothing=2", "nan"):
            self.bench(2, "--work-above", "--against", self.old, "--work-above", value)
        self.bench(2, "--against-model", "--against-model", self.sundial)
        self.bench(2, "--against", "--against", self.old, "--baseline", PATH)
        self.bench(2, "--against", "--against", self.old, "--csv", self.place / "no.csv")
        self.bench(1, "cannot start", "--against", self.place / "missing", "--repetitions", "1")

    def test_an_earlier_file_compares_only_times(self):
        document, file = self.written()
        entry = document["benchmarks"][0]
        old = {"name": "run", "p50": entry["p50"], "cpu_time": entry["cpu_time"], "pages_missing": 0}
        file.write_text(json.dumps({"context": document["context"], "benchmarks": [old]}))
        told = self.bench(0, "", "--baseline", file, *FAR)
        self.assertIn("only times are compared", told.stdout)
        self.assertNotIn("triangles:", told.stdout)

    def test_work_is_equal_for_any_number_of_threads(self):
        counters = []
        for threads in ("1", "2"):
            document, _ = self.written("--threads", threads, "--shadows", "maps,exact")
            counters.append([{key: value for key, value in entry.items() if key.startswith("work_")}
                             for entry in document["benchmarks"]])  # fmt: skip
        self.assertEqual(counters[0], counters[1])

    def test_json_goes_to_stdout_alone(self):
        told = self.bench(0, "", "--json-file", "-")
        document = json.loads(told.stdout)
        context = document["context"]
        for key in ("threads", "caches", "commit", "host_class", "load", "steal_seconds", "governor", "cpu", "simd_bits",
                    "library_build_type", "light", "picture"):  # fmt: skip
            self.assertIn(key, context)
        name = document["benchmarks"][0]["name"]
        self.assertRegex(name, r"^sundial/sundial_orbit/auto/48x48/default/software$")

    def test_a_build_has_the_same_gates(self):
        file, verdict = self.place / "build.json", self.place / "verdict.json"
        words = ("bench", "build", MESH, "--repetitions", "2", "--threads", "1")
        told = self.expect(0, "", *words, "--json-file", file, "--bmf", self.place / "bmf.json")
        self.assertIn("tightness", told.stdout)
        document = json.loads(file.read_text())
        entry = document["benchmarks"][0]
        self.assertRegex(entry["name"], r"^sundial/build/quadric/\d+/measured/cpu$")
        for key in ("work_file_bytes", "work_temporary_bytes", "error_tightness", "triangles_per_second"):
            self.assertIn(key, entry)
        baseline = ("--baseline", file, "--verdict", verdict, "--fail-above", "1e9")
        self.expect(0, "", *words, *baseline)
        self.expect(5, "options", *words, *baseline, "--error", "estimated")
        self.expect(5, "source_hash", "bench", "build", DATA / "models/colonnade.obj", "--threads", "1", *baseline)
        for key, code in (("work_file_bytes", 4), ("error_tightness", 4)):
            changed = {**document, "benchmarks": [{**each, key: 0.9 * entry[key]} for each in document["benchmarks"]]}
            file.write_text(json.dumps(changed))
            self.expect(code, "", *words, *baseline)
        self.expect(0, "", *words, "--against", self.old, "--fail-above", "1e9")

    def test_googles_tool_reads_the_file(self):
        if not COMPARE.exists():
            self.skipTest("compare.py is not installed")
        _, file = self.written("--repetitions", "9", "--frames", "2")
        done = subprocess.run(["/usr/bin/python3", COMPARE, "benchmarks", file, file], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"_pvalue .* U Test, Repetitions: 9 vs 9")


if __name__ == "__main__":
    unittest.main()

"""Each rule of the house must go red for its breach and stay green for what is allowed."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import house


class House(unittest.TestCase):
    def breaches(self, rule, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {"src/core/none.h": "", "preprocess/read/none.h": "", "tests/core/none.cpp": "", **files}.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return list(house.RULES[rule](root))

    def test_a_circle_of_folders_is_one_breach_and_a_room_in_a_layer_is_none(self):
        circle = {"src/a/x.h": '#include "b/y.h"\n', "src/b/y.h": '#include "c/z.h"\n', "src/c/z.h": '#include "a/w.h"\n', "src/a/w.h": ""}
        self.assertEqual(["folders include each other: a, b, c"], self.breaches("folder cycles", circle))
        self.assertEqual([], self.breaches("unit cycles", circle))
        self.assertEqual([], self.breaches("folder cycles", {
            "src/a/x.h": '#include "a/room/y.h"\n', "src/a/room/y.h": '#include "a/z.h"\n', "src/a/z.h": ""}))
        self.assertEqual(1, len(self.breaches("folder cycles", {
            "preprocess/a/x.h": '#include "preprocess/b/y.h"\n', "preprocess/b/y.h": '#include "preprocess/a/z.h"\n',
            "preprocess/a/z.h": ""})))

    def test_a_circle_of_units_takes_headers_and_sources_together(self):
        self.assertEqual(["units include each other: a/x, a/y"], self.breaches("unit cycles", {
            "src/a/x.h": '#include "a/y.h"\n', "src/a/y.h": "", "src/a/y.cpp": '#include "a/y.h"\n#include "a/x.h"\n'}))
        self.assertEqual([], self.breaches("unit cycles", {
            "src/a/x.h": '#include "a/y.h"\n', "src/a/x.cpp": '#include "a/x.h"\n#include "a/y.h"\n', "src/a/y.h": ""}))

    def test_a_folder_and_a_file_may_be_just_as_large_as_allowed(self):
        for count, found in ((house.MOST_FILES, 0), (house.MOST_FILES + 1, 1)):
            self.assertEqual(found, len(self.breaches("full folders", {f"src/a/{i}.h": "" for i in range(count)})))
        for lines, found in ((house.MOST_LINES, 0), (house.MOST_LINES + 1, 1)):
            for name in ("src/a/x.h", "tests/cli/x.py", "scripts/x", "shaders/x.glsl", "bench/x.cpp"):
                with self.subTest(name, lines=lines):
                    self.assertEqual(found, len(self.breaches("long files", {name: "\n" * lines})))
        self.assertEqual([], self.breaches("long files", {"tests/golden/x.json": "\n" * 1000}))

    def test_the_program_itself_stays_small(self):
        for lines, found in ((house.MOST_APP_LINES - 1, 0), (house.MOST_APP_LINES, 1)):
            self.assertEqual(found, len(self.breaches("large app", {"src/app/x.cpp": "\n" * lines, "src/app/x.txt": "\n"})))

    def test_only_the_app_and_the_settings_name_options(self):
        for name, text, found in (
            ("src/plan/x.cpp", 'throw Error("--near is too far");', 1),
            ("preprocess/chunk/x.cpp", 'f("a", "see --chunk-triangles");', 1),
            ("src/plan/x.cpp", '--count; f("a--", "b"); // "--near"', 0),
            ("src/app/x.cpp", '"--near"', 0),
            ("src/settings/x.cpp", '"--near"', 0),
        ):
            with self.subTest(name, text=text):
                self.assertEqual(found, len(self.breaches("options below app", {name: text})))

    def test_only_the_app_prints(self):
        for name, text, found in (
            ("src/measure/x.cpp", 'std::fprintf(stderr, "%s");', 2),
            ("src/viewer/x.h", "std::cerr << 1;", 1),
            ("preprocess/read/x.cpp", "snprintf(text); // to stdout", 0),
            ("src/core/check.cpp", "std::fprintf(stderr);", 0),
            ("src/app/x.cpp", "std::printf();", 0),
        ):
            with self.subTest(name, text=text):
                self.assertEqual(found, len(self.breaches("streams below app", {name: text})))

    def test_functions_that_clang_tidy_does_not_read_are_measured(self):
        for lines, found in ((house.MOST_FUNCTION_LINES, 0), (house.MOST_FUNCTION_LINES + 1, 1)):
            python = "def f():\n" + "    pass\n" * (lines - 1)
            braces = " {\n" + "    a;\n" * (lines - 2) + "}\n"
            for name, text in {"tests/x.py": python, "scripts/x": "f()" + braces, "shaders/x.glsl": "vec3 f(vec3 a, int b)" + braces,
                               "tests/y.sh": "f()" + braces}.items():
                with self.subTest(name, lines=lines):
                    self.assertEqual(found, len(self.breaches("long functions", {name: text})))

    def test_a_unit_is_tested_where_a_test_names_its_header(self):
        self.assertEqual(["preprocess/read/none.h: no test includes it", "src/core/y.h: no test includes it"], sorted(self.breaches(
            "untested units", {"src/core/x.h": "", "src/core/y.h": "",
                               "tests/core/x_test.cpp": '#include "core/x.h"\n#include "core/none.h"\n// core/y.h\n'})))

    def test_a_unit_without_a_test_has_a_reason_and_no_other_has_one(self):
        header = {"src/core/x.h": "", "preprocess/read/none.h": "", "tests/core/none.cpp": '#include "core/none.h"\n'}
        for reasons, found in (
            ("# why\n\nsrc/core/x.h: a window\npreprocess/read/none.h: a: b\n", []),
            ("src/core/x.h: a window\n", ["preprocess/read/none.h: no test includes it"]),
            ("src/core/x.h: a window\npreprocess/read/none.h: b\nsrc/core/none.h: c\nsrc/gone.h: d\n",
             [f"{house.UNTESTED}: {name}: it is no header that no test includes" for name in ("src/core/none.h", "src/gone.h")]),
        ):
            self.assertEqual(found, list(self.breaches("untested units", {**header, house.UNTESTED: reasons})))

    def test_tests_are_weighed_against_the_source(self):
        for lines, found in ((7, 0), (6, 1)):
            self.assertEqual(found, len(self.breaches("few tests", {
                "src/core/x.h": "\n" * 5, "preprocess/read/x.cpp": "\n" * 5, "tests/core/x.cpp": "\n" * lines, "tests/x.py": "\n" * 9})))

    def test_a_report_never_fails_and_names_every_rule(self):
        run = subprocess.run([sys.executable, house.__file__, "--report", str(pathlib.Path(house.__file__).parents[2])],
                             check=True, capture_output=True, text=True)
        for name in house.RULES:
            self.assertIn(f"{name} (", run.stdout)
        self.assertIn("tests to source", run.stdout)


if __name__ == "__main__":
    unittest.main()

"""Each rule of the house must go red for its breach and stay green for what is allowed."""
import pathlib
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
        for lines, found in ((house.MAX_FUNCTION_LINES, 0), (house.MAX_FUNCTION_LINES + 1, 1)):
            python = "def f():\n" + "    pass\n" * (lines - 1)
            braces = " {\n" + "    a;\n" * (lines - 2) + "}\n"
            for name, text in {"tests/x.py": python, "scripts/x": "f()" + braces, "shaders/x.glsl": "vec3 f(vec3 a, int b)" + braces,
                               "tests/y.sh": "f()" + braces}.items():
                with self.subTest(name, lines=lines):
                    self.assertEqual(found, len(self.breaches("long functions", {name: text})))


if __name__ == "__main__":
    unittest.main()

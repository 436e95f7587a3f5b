"""The mutations change what they say and nothing else, and the layers are those of the table and of the folders."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import layers
import mutate
import mutations

ROOT = pathlib.Path(__file__).resolve().parents[2]


def changes(text):
    """(kind, changed text) of every mutation of `text`"""
    return [(m.kind, mutations.applied(text, m)) for m in mutations.mutations(text)]


class Mutations(unittest.TestCase):
    def expect(self, text, *expected):
        self.assertEqual(sorted(expected), sorted(changes(text)))

    def test_a_comparison_takes_or_leaves_its_bound(self):
        for before, after in (("<", "<="), ("<=", "<"), (">", ">="), (">=", ">"), ("==", "!="), ("!=", "==")):
            with self.subTest(before):
                self.expect(f"a {before} b", ("comparison", f"a {after} b"))

    def test_logic_and_signs_are_turned(self):
        self.expect("a && b", ("logic", "a || b"))
        self.expect("a || b", ("logic", "a && b"))
        self.expect("a + b", ("sign", "a - b"))
        self.expect("a -= b;", ("sign", "a += b;"))
        self.expect("f(-a)", ("sign", "f(a)"))
        self.expect("return -a;", ("sign", "return a;"))

    def test_choices_are_swapped(self):
        self.expect("std::min(a, b)", ("choice", "std::max(a, b)"))
        self.expect("glm::max(a, b)", ("choice", "glm::min(a, b)"))
        self.expect("return true;", ("choice", "return false;"))
        self.expect("box.min, numeric_limits<T>::max_digits")

    def test_numbers_keep_their_type(self):
        for before, after in (("0", "1"), ("7U", "8U"), ("1'000", "1001"), ("0xF0U", "0xf1U"), ("0.5", "1.0"),
                              ("0.0F", "1.0F"), ("1e-9", "2e-09"), ("1e3F", "2000.0F")):
            with self.subTest(before):
                self.expect(f"f({before})", ("constant", f"f({after})"))
        self.expect("x2 = vec3(y1)")

    def test_an_index_is_off_by_one(self):
        self.expect("a[i]", ("index", "a[i + 1]"))
        self.expect("f(x)[b.size()]", ("index", "f(x)[b.size() + 1]"))
        self.expect("a[i] = {b}; [this](int x) {}; [&] {};", ("index", "a[i + 1] = {b}; [this](int x) {}; [&] {};"))

    def test_what_is_no_code_stays(self):
        for text in ("// a < b 1\n", "/* a < b\n 1 */", '"a < 1 \\" && 2"', "R\"(a < 1)\"", "'<'", "#include <a>\n#if A == 1\n",
                     "#define A(x) \\\n    (x < 1)\n", 'static_assert(sizeof(a) == 4, "b");', "GNOMON_CHECK_OP(a, <, f(1));",
                     "template <class T, int N = 3>", "std::vector<std::span<int>> a", "T&& a", "a->b", "++a"):
            with self.subTest(text):
                self.expect(text)

    def test_a_members_zero_stays_and_a_variables_does_not(self):
        self.expect("struct A {\n    int a = 0;\n    bool b = false;\n};")
        self.expect("struct A {\n    int a = 2;\n};", ("constant", "struct A {\n    int a = 3;\n};"))
        self.expect("struct A {\n    void f() {\n        int a = 0;\n    }\n};",
                    ("constant", "struct A {\n    void f() {\n        int a = 1;\n    }\n};"))

    def test_every_change_of_this_project_touches_one_line_of_code(self):
        for path in layers.sources(ROOT, "lod"):
            text = path.read_text()
            code = mutations.code_only(text)
            self.assertEqual(len(text), len(code))
            for m in mutations.mutations(text):
                self.assertEqual(text[m.start:m.end], code[m.start:m.end])
                self.assertNotEqual(text[m.start:m.end], m.new)
                self.assertNotIn("\n", text[m.start:m.end])


class Layers(unittest.TestCase):
    ROWS = {"core": set(), "shadow": {"core"}, "plan": {"core", "shadow"}, "frame": {"core", "shadow", "plan"},
            "culling": {"core", "shadow"}, "app": {"core", "shadow", "plan", "frame", "culling"}}

    def test_directly_above_leaves_no_layer_between(self):
        self.assertEqual(["shadow"], layers.directly_above(self.ROWS, "core"))
        self.assertEqual(["plan", "culling"], layers.directly_above(self.ROWS, "shadow"))
        self.assertEqual(["frame"], layers.directly_above(self.ROWS, "plan"))

    def test_a_row_is_found_with_and_without_its_folder(self):
        rows = {"core": set(), "preprocess/read": {"core"}}
        self.assertEqual("preprocess/read", layers.row_of(rows, "read"))
        self.assertEqual("preprocess/read", layers.row_of(rows, "preprocess/read"))
        self.assertEqual("core", layers.row_of(rows, "core"))

    def test_programs_and_libraries_are_those_of_the_folders(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {"src/layers.txt": "# table\ncore: | glm\npreprocess/read: core |\n", "src/core/CMakeLists.txt": "gnomon_layer(core\n  SOURCES a.cpp)",
                               "preprocess/read/CMakeLists.txt": "gnomon_layer(read_it SOURCES a.cpp)", "preprocess/read/a.cpp": "",
                               "tests/read/CMakeLists.txt": "gnomon_tests(read\n SOURCES a.cpp)\ngnomon_tests(words SOURCES b.cpp)"}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            self.assertEqual({"core": set(), "preprocess/read": {"core"}}, layers.read_rows(root))
            self.assertEqual(["read_tests", "words_tests"], layers.test_programs(root, "preprocess/read"))
            self.assertEqual("gnomon_read_it", layers.library(root, "preprocess/read"))
            self.assertEqual([root / "preprocess/read/a.cpp"], layers.sources(root, "preprocess/read"))


class Draw(unittest.TestCase):
    def test_a_seed_draws_the_same_and_another_seed_others(self):
        first, again, other = (mutate.draw(ROOT, "lod", seed) for seed in (1, 1, 2))
        self.assertEqual(first, again)
        self.assertNotEqual(first[:5], other[:5])
        self.assertCountEqual([(m.path, m.mutation) for m in first], [(m.path, m.mutation) for m in other])

    def test_layers_share_the_count_and_what_does_not_count_is_drawn_anew(self):
        lottery = mutate.Lottery(ROOT, ["lod", "plan"], 5, 1)
        drawn = []
        while mutant := lottery.take():
            mutant.outcome = "same code" if not drawn else "caught"
            drawn.append(mutant.layer)
            lottery.put_back(mutant)
        self.assertEqual((4, 2), (drawn.count("lod"), drawn.count("plan")))
        rows = mutate.summary(lottery.tried, ["lod", "plan"])
        self.assertEqual([(3, 100.0), (2, 100.0), (5, 100.0)], [(row["caught"], row["caught_percent"]) for row in rows])

    def test_a_copy_follows_the_tree_and_the_tree_is_left_alone(self):
        with tempfile.TemporaryDirectory() as folder:
            tree, copy = pathlib.Path(folder) / "tree", pathlib.Path(folder) / "copy"
            tree.mkdir()
            subprocess.run(["git", "init", "-q"], cwd=tree, check=True)
            (tree / "a.cpp").write_text("int a = 1;\n")
            mutate.copy_tree(tree, copy)
            (copy / "a.cpp").write_text("int a = 2;\n")
            (copy / "gone.cpp").write_text("")
            (copy / "build").mkdir()
            (copy / "build/kept.o").write_text("")
            mutate.copy_tree(tree, copy)
            self.assertEqual("int a = 1;\n", (copy / "a.cpp").read_text())
            self.assertEqual("int a = 1;\n", (tree / "a.cpp").read_text())
            self.assertFalse((copy / "gone.cpp").exists())
            self.assertTrue((copy / "build/kept.o").exists())

    def test_the_list_needs_no_build(self):
        run = subprocess.run([sys.executable, mutate.__file__, "--layers", "plan", "--count", "2", "--list"],
                             check=True, capture_output=True, text=True)
        self.assertEqual(2, run.stdout.count("@@ -"))


if __name__ == "__main__":
    unittest.main()

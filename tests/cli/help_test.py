"""--help shows the everyday options, --help-all shows all, and old names of options work without being listed."""
import re
import unittest

from manual_test import COMMANDS, printed
from program import ProgramTest, run


def options_of(text):
    """The options in the labels of a help text, in order: lines with an indented option, behind a group or none."""
    labels = re.findall(r"^(?:[A-Z][a-z]+ +| {2,10})((?:-\w, )?--[a-z][a-z-]*)(?![a-z-])(?! --)", text, re.M)
    return [label.split(", ")[-1] for label in labels]


class Help(unittest.TestCase):
    def test_of_everyday_options_is_short(self):
        for command in COMMANDS:
            text = run(*command, "--help").stdout
            self.assertLessEqual(text.count("\n"), 25, command)
            self.assertLessEqual(max(map(len, text.splitlines())), 100, command)
            self.assertIn("--help-all", text.splitlines()[-1])

    def test_of_render_has_the_groups_that_a_newcomer_needs(self):
        text = run("render", "--help").stdout
        labels = re.findall(r"^([A-Z][a-z]+)  ", text, re.M)
        self.assertEqual(labels, ["Input", "View", "Light", "Quality", "Output"])
        shown = options_of(text)
        self.assertTrue(18 <= len(shown) <= 22, shown)
        self.assertLessEqual({"--size", "--view", "--sun", "--shadows", "--output"}, set(shown))
        self.assertFalse({"--warp", "--eta", "--split-lambda"} & set(shown), "research")

    def test_of_all_options_has_each_once_in_its_group(self):
        for command in COMMANDS:
            text = run(*command, "--help-all").stdout
            self.assertLessEqual(max(map(len, text.splitlines())), 100, command)
            listed = options_of(text)
            self.assertEqual(len(listed), len(set(listed)), command)
            self.assertLessEqual(set(options_of(run(*command, "--help").stdout)), set(listed), command)
            self.assertLessEqual({"--help", "--help-all"}, set(listed), command)
        research = run("render", "--help-all").stdout.partition("\nResearch:\n")[2]
        self.assertLessEqual({"--warp", "--eta", "--split-lambda", "--shadow-near"}, set(options_of(research)))


class OldNames(ProgramTest):
    RENAMED = (("render", "--near", "--shadow-near"), ("render", "--far", "--shadow-far"),
               ("bench", "--real-time", "--no-wait"), ("export", "--ecef", "--geodetic"))

    def test_are_listed_nowhere(self):
        pages = "".join(printed("man", command) for command in ("render", "bench", "export")).replace("\\-", "-")
        for command, old, new in self.RENAMED:
            text = run(command, "--help-all").stdout
            self.assertIn(new, options_of(text))
            self.assertNotIn(old, options_of(text))
            self.assertIn(f"{new}\\fR", pages)
            self.assertNotIn(f"{old}\\fR", pages)
            for shell in ("bash", "zsh", "fish"):
                found = re.findall(rf"(?:--|-l ){old[2:]}\b(?!-)", printed(shell))
                self.assertLessEqual(len(found), 2 if old in ("--near", "--far") else 0, shell)  # of theory table

    def test_work_as_the_new_names_do(self):
        def plan(*words):
            return self.expect(0, "", "explain", self.sundial, "--json", *words).stdout
        self.assertEqual(plan("--near", "1", "--far", "25"), plan("--shadow-near", "1", "--shadow-far", "25"))
        self.assertNotEqual(plan("--near", "1", "--far", "25"), plan())
        self.expect(2, "--shadow-near: expected", "render", self.sundial, "-o", "a.png", "--near", "-1")
        self.expect(1, "bad latitude", "export", self.sundial, "-o", self.place / "t", "--format", "3dtiles", "--ecef", "91,0,0")
        self.expect(1, "no_such.json", "bench", self.sundial, "--path", "no_such.json", "--real-time")


if __name__ == "__main__":
    unittest.main()

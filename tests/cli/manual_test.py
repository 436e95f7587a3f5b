"""Manual pages and completions, against --help and in the programs that read them."""
import re
import shutil
import subprocess
import tempfile
import pathlib
import unittest

from program import run

COMMANDS = [[], ["make"], ["build"], ["info"], ["verify"], ["export"], ["path"], ["render"], ["explain"], ["bench"],
            ["view"], ["sun"], ["sun", "position"], ["sun", "hours"], ["theory"], ["theory", "eval"]]


def printed(*words):
    done = run("manual", *words)
    assert done.returncode == 0, done.stderr
    return done.stdout


def long_options(text):
    """Those that lines of --help or of a page begin with."""
    return set(re.findall(r"^ {2,10}(?:-\w, ?)?(--[a-z][a-z-]*)", text, re.M))


class ManualPages(unittest.TestCase):
    def test_name_every_option_of_help(self):
        if not shutil.which("groff"):
            self.skipTest("groff is not installed")
        for command in COMMANDS:
            page = subprocess.run(["groff", "-man", "-Tascii", "-P-c", "-P-b", "-P-u", "-ww"],
                                  input=printed("man", *command), capture_output=True, text=True)
            self.assertEqual(page.stderr, "", command)
            help_text = run(*command, "--help-all").stdout
            self.assertGreaterEqual(len(long_options(help_text)), 1, command)
            self.assertEqual(long_options(page.stdout), long_options(help_text), command)

    def test_an_unknown_command_is_one_line(self):
        done = run("manual", "man", "nothing")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr.count("\n"), 1)


class Completions(unittest.TestCase):
    def test_in_bash_name_every_option_of_help(self):
        script = printed("bash")
        for command in COMMANDS:
            words = re.search(rf"^        '{' '.join(command)}'\) options='([^']*)'", script, re.M)[1].split()
            listed = sorted(word for word in words if word.startswith("--"))
            self.assertEqual(listed, sorted(long_options(run(*command, "--help-all").stdout)), command)

    CASES = [  # what is typed, some of what is offered, what is not
        ("gnomon ", {"build", "render", "sun"}, {"hours", "manual"}),
        ("gnomon re", {"render"}, {"build"}),
        ("gnomon sun ", {"position", "hours"}, {"build"}),
        ("gnomon sun hours --at", {"--at"}, {"--output"}),
        ("gnomon build --pro", {"--progress"}, {"--triangles"}),
        ("gnomon render m.gnm --shadows ", {"exact", "maps", "off"}, {"--shadows"}),
    ]

    def check(self, complete):
        for line, offered, not_offered in self.CASES:
            found = complete(line)
            self.assertLessEqual(offered, found, line)
            self.assertFalse(not_offered & found, line)

    def test_in_bash(self):
        with tempfile.NamedTemporaryFile("w", suffix=".bash") as script:
            script.write(printed("bash"))
            script.flush()

            def complete(line):
                words = line.split(" ")
                quoted = " ".join(f"'{word}'" for word in words)
                code = (f"source {script.name}; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; _gnomon; "
                        'printf "%s\\n" "${COMPREPLY[@]}"')
                return set(subprocess.run(["bash", "-uc", code], capture_output=True, text=True, check=True).stdout.split())

            self.check(complete)

    def test_in_fish(self):
        if not shutil.which("fish"):
            self.skipTest("fish is not installed")
        with tempfile.TemporaryDirectory() as folder:
            script = pathlib.Path(folder) / "gnomon.fish"
            script.write_text(printed("fish"))

            def complete(line):
                code = f"source {script}; complete -C '{line}'"
                found = subprocess.run(["fish", "--no-config", "-c", code], capture_output=True, text=True,
                                       env={"HOME": folder, "PATH": "/usr/bin:/bin"})
                self.assertEqual(found.stderr, "")
                return {entry.split("\t")[0] for entry in found.stdout.split("\n")}

            self.check(complete)

    def test_zsh_reads_its_file(self):
        if not shutil.which("zsh"):
            self.skipTest("zsh is not installed")
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "_gnomon").write_text(printed("zsh"))
            code = f"fpath=({folder} $fpath); autoload -Uz compinit; compinit -u -d {folder}/dump; print $_comps[gnomon]"
            done = subprocess.run(["zsh", "-fc", code], capture_output=True, text=True)
            self.assertEqual((done.stdout.strip(), done.stderr), ("_gnomon", ""))
            checked = subprocess.run(["zsh", "-nf", f"{folder}/_gnomon"], capture_output=True, text=True)
            self.assertEqual(checked.stderr, "")
            # What it hands to _arguments and _describe, with these two put in place of zsh's.
            for line, offered, _ in self.CASES[:3]:
                words = line.split(" ")
                code = (f"_arguments() {{ print -l -- $@ }}; _describe() {{ print -l -- $commands }}; "
                        f"words=({' '.join(words[:-1])} '{words[-1]}'); CURRENT={len(words)}; source {folder}/_gnomon")
                found = subprocess.run(["zsh", "-fc", code], capture_output=True, text=True)
                self.assertEqual(found.stderr, "")
                for word in offered:
                    self.assertIn(f"\n{word}:", "\n" + found.stdout)


if __name__ == "__main__":
    unittest.main()

"""A `gnomon view` under Xvfb, driven by xdotool, and what a test asks of its files."""
import csv
import os
import pathlib
import re
import subprocess
import tempfile
import threading
import time

from x_client import XClient


PATIENCE = 240  # seconds for anything to happen: sanitizers on software OpenGL are slow
SUPPRESSIONS = pathlib.Path(__file__).resolve().parent.parent / "sanitizers" / "lsan.supp"


class Display:
    """An X server of one's own, without a window manager."""

    def __init__(self, dots_per_inch=None):
        read, write = os.pipe()
        self.server = subprocess.Popen(
            ["Xvfb", "-displayfd", str(write), "-screen", "0", "4200x3200x24", "-nolisten", "tcp", "-noreset"],
            pass_fds=[write], stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as answer:
            self.name = ":" + answer.readline().strip()
        self.environment = dict(os.environ, DISPLAY=self.name)
        self.state = tempfile.TemporaryDirectory(prefix="gnomon_state_")
        self.environment["XDG_STATE_HOME"] = self.state.name  # of what runs without a Session
        self.environment["LSAN_OPTIONS"] = f"suppressions={SUPPRESSIONS}:print_suppressions=0"
        if dots_per_inch:
            with XClient(self.name) as client:
                client.set_resources(f"Xft.dpi:\t{dots_per_inch}\n")

    def do(self, *words):
        return subprocess.run(["xdotool", *map(str, words)], env=self.environment, check=True, capture_output=True,
                              text=True).stdout

    def close(self):
        self.server.terminate()
        self.server.wait()
        self.state.cleanup()


class Session:
    """One `gnomon view`. What it says on stderr is what it shows as messages."""

    def __init__(self, display, program, folder, *arguments, samples=1, target=0, state=None):
        """`samples` and `target` as in --samples and --target-ms: by these each frame is drawn in full, and done.
        `state` is where it keeps what it keeps, else a folder of its own."""
        self.display = display
        self.folder = pathlib.Path(folder)
        self.lines = []
        self.heard = threading.Condition()
        self.started = time.monotonic()
        words = [program, "view", *arguments, "--samples", samples, "--target-ms", target]
        state = state or tempfile.mkdtemp(dir=display.state.name)
        places = {"XDG_STATE_HOME": str(state), "XDG_PICTURES_DIR": str(folder)}
        self.process = subprocess.Popen(list(map(str, words)), cwd=folder, stderr=subprocess.PIPE, text=True,
                                        env=dict(display.environment, **places))
        threading.Thread(target=self._listen, daemon=True).start()
        self.window = self._find_window()
        display.do("mousemove", 400, 400)

    def _listen(self):
        for line in self.process.stderr:
            with self.heard:
                self.lines.append(line.rstrip())
                self.heard.notify_all()

    def _find_window(self):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end and self.process.poll() is None:
            found = subprocess.run(["xdotool", "search", "--onlyvisible", "--pid", str(self.process.pid)],
                                   env=self.display.environment, capture_output=True, text=True).stdout.split()
            if found:
                return found[0]
            time.sleep(0.05)
        raise AssertionError(f"no window: {self.lines}")

    def expect(self, pattern, since=0):
        """The match of the first line from number `since` on that holds `pattern`."""
        end = time.monotonic() + PATIENCE
        with self.heard:
            while True:
                for line in self.lines[since:]:
                    found = re.search(pattern, line)
                    if found:
                        return found
                if self.process.poll() is not None or time.monotonic() > end:
                    raise AssertionError(f"no line with {pattern!r} in {self.lines}")
                self.heard.wait(0.2)

    def press(self, *keys):
        self.display.do("key", "--delay", 20, *keys)

    def shot(self, key="F12"):
        """Presses `key`; its file tells that all that was pressed before has been seen, too."""
        since = len(self.lines)
        self.press(key)
        return self.folder / self.expect(r"saved (\S+\.png)", since).group(1)

    def drag(self, button, dx, dy, *held):
        self.display.do("mousemove", 400, 500)
        for key in held:
            self.display.do("keydown", key)
        self.display.do("mousedown", button)
        for step in range(1, 6):
            self.display.do("mousemove", 400 + dx * step // 5, 500 + dy * step // 5)
        self.display.do("mouseup", button)
        for key in held:
            self.display.do("keyup", key)

    def leave(self):
        self.press("Escape")
        try:
            code = self.process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            self.process.kill()
            raise
        assert code == 0, f"exit {code}: {self.lines}"

    def title(self):
        return self.display.do("getwindowname", self.window).strip()

    def complaints(self):
        return [line for line in self.lines if not re.match(r"gnomon: (saved|built|path:|\S+: the model is back)", line)]


def keys_of_help(program):
    """The keys that `gnomon view --help-all` lists, as xdotool calls them."""
    text = subprocess.run([program, "view", "--help-all"], check=True, capture_output=True, text=True).stdout
    names = re.findall(r"^  (\S+) {2,}", text[text.index("Keys:"):], re.MULTILINE)
    translated = {"]": "bracketright", "[": "bracketleft", ".": "period", ",": "comma", "Space": "space",
                  "Esc": "Escape", "Enter": "Return", "Backspace": "BackSpace"}
    keys = []
    for name in names:
        modifier, _, key = name.rpartition("+")
        key = translated.get(key, key.lower() if len(key) == 1 else key)
        keys.append(f"shift+{key}" if modifier else key)
    assert len(keys) > 40, keys
    return keys


def rows_of(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def size_of(png):
    header = png.read_bytes()[:24]
    return int.from_bytes(header[16:20], "big"), int.from_bytes(header[20:24], "big")

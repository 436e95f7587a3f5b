"""Drives `gnomon view` under Xvfb with xdotool: every key of its help, the mouse, sizes, recording, playing, messages.

usage: window_test.py GNOMON [--keep FOLDER] [--minutes N MODEL] [--starts N MODEL]

--keep leaves the pictures of the session in FOLDER, to be looked at. --minutes walks MODEL for so long instead, and
checks that memory is flat after the first minute and that the caps hold. --starts opens MODEL so often instead, and
prints how long after the program's start its first picture is there.
"""
import argparse
import filecmp
import itertools
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time

from measure_checks import check_colors, check_measures, check_recent_views
from rest_checks import check_picture, check_rest, check_rest_after_motion, check_target
from server_checks import check_server
from session import PATIENCE, Display, Session, keys_of_help, rows_of, size_of
from x_client import XClient


def make_model(program, folder, triangles="100k", kind="statue"):
    mesh = pathlib.Path(folder) / f"{kind}.ply"
    subprocess.run([program, "make", kind, "--triangles", triangles, "--seed", "1", "-o", mesh], check=True,
                   capture_output=True)
    model = mesh.with_suffix(".gnm")
    subprocess.run([program, "build", mesh, "-o", model], check=True, capture_output=True)
    return mesh, model


def check_without_display(program, folder, model):
    environment = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}

    def run(*arguments):
        return subprocess.run([program, "view", *arguments], cwd=folder, env=environment, capture_output=True, text=True)

    alone = run(model)
    assert alone.returncode == 1, alone
    assert len(alone.stderr.splitlines()) == 1 and "gnomon render" in alone.stderr, alone.stderr
    for wrong in (["--z-partitions", "0"], ["--backend", "egl"], ["--frames", "3"], ["--target-ms", "-1"]):
        assert run(model, *wrong).returncode == 2, wrong


def check_every_key(display, program, folder, model):
    session = Session(display, program, folder, model, "--csv", "keys.csv")
    first = session.shot()
    for key in keys_of_help(program):
        if key in ("Escape", "r", "p"):
            continue  # below
        session.press(key)
        session.shot()
        assert session.process.poll() is None, f"{key}: {session.lines}"
        if key == "o":
            session.press(key)  # by parallel lines there are no faces and no warp
    session.press("F1", "Home")
    session.shot("shift+F12")
    session.leave()
    assert session.complaints() == [], session.complaints()
    rows = rows_of(session.folder / "keys.csv")
    print(f"  first picture {float(rows[0]['since_start_ms']) / 1000:.2f} s after the start")
    for column, minimum in {"scheme": 4, "warp": 2, "z_partitions": 2, "face_partitions": 2, "shadow_texels": 2,
                          "error_pixels": 2, "cull_casters": 2, "stabilize": 2, "filter": 2}.items():
        seen = {row[column] for row in rows}
        assert len(seen) >= minimum, f"{column}: {seen}"
    return first


def changed(a, b):
    return not filecmp.cmp(a, b, shallow=False)


def check_mouse(display, program, folder, model):
    session = Session(display, program, folder, model)
    time.sleep(1)
    for gesture, act in enumerate((lambda: session.drag(1, 150, 40), lambda: session.drag(1, 150, 40, "alt"),
                lambda: session.drag(1, 80, 30, "shift"), lambda: session.drag(1, 200, -60, "ctrl"),
                lambda: (session.press("shift+j"), session.drag(1, 0, -200, "ctrl", "shift")),
                lambda: session.drag(2, 80, 30), lambda: session.drag(3, 100, -30),
                lambda: display.do("click", 4), lambda: display.do("click", "--repeat", 2, "--delay", 60, 1),
                lambda: (display.do("keydown", "ctrl"), display.do("click", 4), display.do("keyup", "ctrl"),
                         session.press("w", "w")))):
        # The model is in view again and under the pointer, whatever the last gesture did.
        session.press("Home")
        display.do("mousemove", 400, 400)
        time.sleep(0.7)
        before = session.shot()
        for _ in range(4):  # a busy machine may see two clicks as single ones
            act()
            shown = session.shot()
            if changed(before, shown):
                break
        assert changed(before, shown), gesture
    # The panel's light pad: what is dragged there is the light, not the camera.
    session.press("Tab")
    session.shot()
    session.press("Tab")
    session.leave()
    assert session.complaints() == [], session.complaints()


def check_going_away(display, program, folder, model):
    """A key that is down when the focus or the window goes does not stay down; a minimised window waits."""
    session = Session(display, program, folder, model, "--csv", "away.csv")
    window = int(session.window)
    with XClient(display.name) as client:
        for go, come in ((lambda: client.focus(0), lambda: None),
                         (lambda: client.minimise(window), lambda: client.restore(window))):
            still = session.shot()
            display.do("keydown", "w")
            time.sleep(0.5)
            go()
            display.do("keyup", "w")
            time.sleep(1)
            come()
            display.do("windowsize", "--sync", session.window, 700, 700)
            display.do("windowsize", "--sync", session.window, 800, 800)
            client.focus(window)
            pictures = [session.shot()]
            assert changed(still, pictures[0])
            for _ in range(8):  # what was set going takes some frames to come to rest
                time.sleep(0.5)
                pictures.append(session.shot())
                if not changed(*pictures[-2:]):
                    break
            assert not changed(*pictures[-2:])
    session.leave()
    assert session.complaints() == [], session.complaints()


def check_lost_display(program, folder, model):
    """Xlib ends a program whose server is gone: no unfinished file stays."""
    display = Display()
    session = Session(display, program, folder, model, "--csv", "lost.csv")
    session.shot()
    assert list(session.folder.glob("lost.csv.*.partial"))
    display.server.kill()
    assert session.process.wait(PATIENCE) != 0
    display.close()
    left = list(session.folder.glob("lost.csv*"))
    assert left == [], left


def check_sizes(display, program, folder, model):
    session = Session(display, program, folder, model)
    for width, height in ((1, 1), (4000, 3000), (1, 700), (300, 200), (800, 800)):
        display.do("windowsize", "--sync", session.window, width, height)
        display.do("mousemove", min(400, width // 2), min(400, height // 2))
        end = time.monotonic() + PATIENCE
        while size_of(session.shot()) != (width, height):
            assert time.monotonic() < end, (width, height)
        session.shot("shift+F12")
    session.leave()
    assert session.complaints() == [], session.complaints()


def check_paths(display, program, folder, model):
    """A path recorded by hand, played in the window at a fixed step and by the bench: the same pictures."""
    session = Session(display, program, folder, model)
    session.shot()
    session.press("r")
    for key in ("w", "d", "e"):
        display.do("keydown", key)
        time.sleep(0.6)
        display.do("keyup", key)
    since = len(session.lines)
    session.press("r")
    path = session.folder / session.expect(r"saved (\S+\.json)", since).group(1)
    session.press("p")
    session.expect("path: played to its end", since)
    session.leave()
    assert session.complaints() == [], session.complaints()
    keyframes = json.loads(path.read_text())["keyframes"]
    assert len(keyframes) > 3 and keyframes[0]["eye"] != keyframes[-1]["eye"]

    for name, options in (("plain", []), ("faces", ["--face-partitions", "on", "--z-partitions", "2"])):
        common = [model, "--path", path, "--frames", "7", "--size", "500x400", "--backend", "software", *options]
        played = subprocess.run([program, "view", *map(str, common), "--images", f"window_{name}"], cwd=folder,
                                env=display.environment, capture_output=True, text=True, timeout=PATIENCE)
        assert played.returncode == 0 and "path: played to its end" in played.stderr, played  # it ends by itself
        subprocess.run([program, "bench", *common, "--images", f"bench_{name}", "--all-images"], cwd=folder, check=True,
                       capture_output=True)
        for frame in range(7):
            ours = session.folder / f"window_{name}" / f"frame{frame:04}.png"
            bench = session.folder / f"bench_{name}" / f"run0_frame{frame:04}.png"
            assert not changed(ours, bench), ours


def check_files(display, program, folder, mesh, model):
    """A mesh is built into a cache and shown; what is damaged or vanishes is told in the window."""
    session = Session(display, program, folder, mesh)
    session.expect(r"built \S+\.ply\.gnm")
    session.shot()
    session.leave()
    session = Session(display, program, folder, mesh)  # now from the cache
    session.shot()
    session.leave()
    assert session.complaints() == [] and not any("built" in line for line in session.lines), session.lines

    copy = session.folder / "copy.gnm"
    shutil.copy(model, copy)
    session = Session(display, program, folder, copy)
    session.shot()
    copy.unlink()
    session.expect("has vanished")
    session.press("w")
    session.shot()
    session.press("F9")
    session.expect("copy.gnm: .*(cannot be opened|No such file)")
    session.shot("shift+F12")
    shutil.copy(model, copy)
    session.expect("has changed|is back")
    session.press("F9")
    session.shot()
    session.leave()

    # A model and a mesh that are dropped on the window are opened; what is neither is told.
    session = Session(display, program, folder, model)
    first = session.shot()
    _, other = make_model(program, folder, "30k", "planes")
    dropped = make_model(program, folder, "20k", "plant")[0]
    with XClient(display.name) as client:
        client.drop(int(session.window), other, PATIENCE)
        second = session.shot()
        assert changed(first, second) and session.title().endswith("planes.gnm"), session.title()
        client.drop(int(session.window), dropped, PATIENCE)
        session.expect(r"built \S+plant\.ply\.gnm")
        third = session.shot()
        assert changed(second, third) and session.title().endswith("plant.ply.gnm"), session.title()
        assert session.complaints() == [], session.complaints()
        client.drop(int(session.window), first, PATIENCE)
        session.expect(f"{first.name}: .*PLY")
        assert not changed(third, session.shot())
    session.leave()

    # Without a person, a window ends where its path cannot be played.
    path = session.folder / "still.json"
    path.write_text(json.dumps({"keyframes": [{"time": 0, "eye": [0, 0, 5], "target": [0, 0, 0], "up": [0, 1, 0], "fov_y": 60}]}))
    (session.folder / "cut.ply").write_text("ply\nformat ascii 1.0\nelement vertex 5\n")
    (session.folder / "cut.gnm").write_bytes(copy.read_bytes()[:1000])
    (session.folder / "no_folder").write_text("")
    for wrong, images in (("cut.ply", "played"), ("cut.gnm", "played"), ("http://127.0.0.1:1/m.gnm", "played"),
                          (str(copy), "no_folder")):  # fmt: skip
        ended = subprocess.run([program, "view", wrong, "--path", path, "--frames", "2", "--images", images], cwd=folder,
                               env=display.environment, capture_output=True, text=True, timeout=PATIENCE)
        assert ended.returncode == 1 and "was not played to its end" in ended.stderr.splitlines()[-1], ended
        assert len(ended.stderr.splitlines()) == 2, ended

    # A window that is closed during a build ends at once and leaves nothing.
    large = session.folder / "large.obj"
    large.write_text("".join(f"v {i} {i * i % 97} 0\n" for i in range(300000)) +
                     "".join(f"f {i} {i + 1} {i + 2}\n" for i in range(1, 299999)))
    session = Session(display, program, folder, large)
    session.leave()
    assert [path.name for path in session.folder.glob("large*")] == ["large.obj"], session.lines

    broken = session.folder / "broken.ply"
    broken.write_text("ply\nformat ascii 1.0\nelement vertex 5\n")
    session = Session(display, program, folder, broken)
    session.expect("broken.ply")
    session.press("h", "Tab", "w", "space", "F12", "r", "p", "v")
    time.sleep(0.5)
    session.leave()


def check_scaled_screen(program, folder, model):
    display = Display(dots_per_inch=192)
    try:
        session = Session(display, program, folder, model)
        session.press("Tab")
        session.shot()
        picture = session.shot("shift+F12")
        session.leave()
        assert session.complaints() == [], session.complaints()
        shutil.copy(picture, session.folder / "scaled_screen.png")
    finally:
        display.close()


def resident_mib(process):
    status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+)", status).group(1)) / 1024


def sample(process, samples, over):
    """Adds (seconds, resident MiB) every five seconds, seen from outside."""
    start = time.monotonic()
    while not over.wait(5) and process.poll() is None:
        samples.append((time.monotonic() - start, resident_mib(process)))


def print_starts(display, program, folder, model, count):
    model.read_bytes()  # so that the disk is warm
    times = []
    for _ in range(count):
        session = Session(display, program, folder, model, "--csv", "start.csv")
        time.sleep(1)
        session.leave()
        times.append(float(rows_of(session.folder / "start.csv")[0]["since_start_ms"]))
    print(f"  first picture after {', '.join(f'{ms:.0f}' for ms in sorted(times))} ms")


def within(first, last, samples):
    """What (seconds, value) samples hold from minute `first` to minute `last`."""
    return [value for seconds, value in samples if first <= seconds / 60 < last]


def walk_about(display, session, seconds):
    """Flies, looks, jumps and steps through the schemes by seeded keys."""
    generator = random.Random(1)
    start = time.monotonic()
    for step in itertools.count():
        if time.monotonic() - start > seconds:
            return
        key = generator.choice(["w", "w", "w", "a", "d", "q", "e", "s"])
        display.do("keydown", key)
        session.drag(1, generator.randint(-80, 80), generator.randint(-30, 30))
        time.sleep(generator.uniform(0.2, 1))
        display.do("keyup", key)
        if step % 15 == 14:
            session.press(generator.choice(["1", "3", "Home", "space", "n", "x", "bracketright", "bracketleft"]))


def check_long_walk(display, program, folder, model, minutes):
    """Memory must be flat after the first minute, and the caps must hold."""
    page_cap, gpu_cap, rest = 128, 128, 300  # MiB; the last is what CONTRACT.md grants to libraries and pictures
    session = Session(display, program, folder, model, "--csv", "walk.csv", "--memory", f"{page_cap}M", "--gpu-memory",
                      f"{gpu_cap}M")  # fmt: skip
    samples = []
    over = threading.Event()
    sampler = threading.Thread(target=sample, args=(session.process, samples, over))
    sampler.start()
    walk_about(display, session, 60 * minutes)
    over.set()
    sampler.join()
    session.leave()
    rows = rows_of(session.folder / "walk.csv")
    pages = [(float(row["time_s"]), int(row["resident_bytes"]) / 2**20) for row in rows]
    device = max(int(row["gpu_bytes"] or 0) for row in rows) / 2**20
    print(f"  first picture {float(rows[0]['since_start_ms']) / 1000:.2f} s after the start, {len(rows)} frames")
    print("  minute  MiB resident: least  most  pages: most")
    for minute in range(int(samples[-1][0] // 60) + 1):
        sizes, cached = (within(minute, minute + 1, series) for series in (samples, pages))
        print(f"  {minute + 1:6}  {min(sizes):19.0f}  {max(sizes):4.0f}  {max(cached, default=0):11.0f}")
    print(f"  pages at most {max(mib for _, mib in pages):.0f} of {page_cap} MiB, drawing {device:.0f} of {gpu_cap} MiB")
    assert max(mib for _, mib in pages) <= page_cap and device <= gpu_cap
    assert max(mib for _, mib in samples) <= page_cap + gpu_cap + rest
    # The pages grow to their cap at the pace of the walk; all else must have come to its size.
    early = max(within(0, 1, samples)) - max(within(0, 1, pages))
    late = max(within(1, minutes, samples)) - max(within(1, minutes, pages))
    print(f"  besides pages {early:.0f} MiB in the first minute, {late:.0f} MiB after it")
    assert late <= early * 1.1 + 20
    assert session.complaints() == [], session.complaints()


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--keep", type=pathlib.Path)
    parser.add_argument("--minutes", nargs=2, metavar=("N", "MODEL"))
    parser.add_argument("--starts", nargs=2, metavar=("N", "MODEL"))
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    folder = tempfile.mkdtemp(prefix="gnomon_window_")
    display = Display()
    try:
        if options.minutes:
            model = pathlib.Path(options.minutes[1]).resolve()
            return check_long_walk(display, program, folder, model, float(options.minutes[0]))
        if options.starts:
            model = pathlib.Path(options.starts[1]).resolve()
            return print_starts(display, program, folder, model, int(options.starts[0]))
        mesh, model = make_model(program, folder)
        for name, check in {
            "without a display": lambda: check_without_display(program, folder, model),
            "every key of the help": lambda: check_every_key(display, program, folder, model),
            "the mouse": lambda: check_mouse(display, program, folder, model),
            "a view at rest": lambda: check_rest(display, program, folder, model),
            "a view at rest after motion": lambda: check_rest_after_motion(display, program, folder, model),
            "a picture in motion": lambda: check_picture(display, program, folder, model),
            "a time target": lambda: check_target(display, program, folder, model),
            "measures": lambda: check_measures(display, program, pathlib.Path(folder)),
            "recent views": lambda: check_recent_views(display, program, folder, model),
            "colours by value": lambda: check_colors(display, program, folder, model),
            "losing the display": lambda: check_lost_display(program, folder, model),
            "losing focus, minimised": lambda: check_going_away(display, program, folder, model),
            "sizes from 1x1 to 4000x3000": lambda: check_sizes(display, program, folder, model),
            "paths": lambda: check_paths(display, program, folder, model),
            "files": lambda: check_files(display, program, folder, mesh, model),
            "a server": lambda: check_server(display, program, folder, model),
            "a screen of twice the dots": lambda: check_scaled_screen(program, folder, model),
        }.items():
            print(f"window: {name}", flush=True)
            check()
    finally:
        display.close()
        if options.keep:
            shutil.copytree(folder, options.keep, dirs_exist_ok=True)
        shutil.rmtree(folder)
    print("window: all passed")


if __name__ == "__main__":
    sys.exit(main())

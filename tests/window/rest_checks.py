"""What a window draws while something moves and once nothing does: refinement at rest, and the time target."""
import filecmp
import pathlib
import subprocess
import sys
import time

from session import Session, rows_of, size_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "torture"))
from instances import pixels  # noqa: E402


def check_rest(display, program, folder, model):
    """A standing picture becomes what `render` makes of as many frames; the mouse over it stops nothing, a key does."""
    session = Session(display, program, folder, model, "--shadows", "exact", samples=12)
    session.shot()
    display.do("mousemove", 300, 420)
    smooth = session.shot()
    window = session.shot("shift+F12")
    # Between the lines of text a window has just the picture, whatever short cuts its OpenGL takes.
    assert pixels(window)[3][200:600] == pixels(smooth)[3][200:600]
    session.press("g")
    session.shot("shift+F12")
    session.press("g", "w")
    assert not filecmp.cmp(smooth, session.shot(), shallow=False)
    session.press("Home")
    time.sleep(1)
    again = session.shot()
    session.leave()
    assert session.complaints() == [], session.complaints()
    rendered = session.folder / "rendered.png"
    common = ("render", model, "-o", rendered, "--size", "800x800", "--shadows", "exact")
    for samples, is_same in (("12", True), ("1", False)):
        subprocess.run([program, *map(str, common), "--samples", samples], cwd=folder, check=True, capture_output=True)
        assert filecmp.cmp(rendered, smooth, shallow=False) == is_same, samples
        assert filecmp.cmp(rendered, again, shallow=False) == is_same, samples


def standing(session):
    """Picture and camera once neither changes any more: a picture that is asked for while something glides is taken at
    once."""
    before = None
    while True:
        since = len(session.lines)
        session.press("i")
        camera = session.folder / session.expect(r"saved (\S+\.json)", since).group(1)
        picture = session.shot()
        if before and all(filecmp.cmp(a, b, shallow=False) for a, b in zip(before, (picture, camera))):
            return picture, camera
        before = (picture, camera)
        time.sleep(0.3)


def check_rest_after_motion(display, program, folder, model):
    """Where a window comes to rest, what it shows depends on nothing that it has shown before: `render` makes the same."""
    for shadows in (("--shadows", "maps"), ("--shadows", "maps", "--warp", "log", "--z-partitions", "1"), ("--shadows", "auto", "--z-partitions", "auto")):
        session = Session(display, program, folder, model, *shadows, samples=2, target=3)  # what is given up is back, too
        for key, seconds in (("w", 0.7), ("a", 0.2), ("s", 0.5)):
            display.do("keydown", key)
            time.sleep(seconds)
            display.do("keyup", key)
        for _ in range(3):
            session.drag(1, 150, 30)
        stood, camera = standing(session)
        session.leave()
        assert session.complaints() == [], session.complaints()
        rendered = session.folder / "rendered.png"
        words = ("render", model, "--camera", camera, "-o", rendered, "--size", "800x800", "--samples", "2", *shadows)
        subprocess.run([program, *map(str, words)], cwd=folder, check=True, capture_output=True)
        assert filecmp.cmp(rendered, stood, shallow=False), shadows


def check_picture(display, program, folder, model):
    """A picture shows the view at which its key was pressed, in full, though the camera moves right after or already."""
    session = Session(display, program, folder, model, samples=4, target=3)
    time.sleep(1)
    full = session.shot()
    since = len(session.lines)
    display.do("key", "F12", "keydown", "w")
    picture = session.folder / session.expect(r"saved (\S+\.png)", since).group(1)
    assert picture.parent.name == "Gnomon" and filecmp.cmp(full, picture, shallow=False)
    for _ in range(3):
        since = len(session.lines)
        session.press("F12")
        picture = session.folder / session.expect(r"saved (\S+\.png)", since).group(1)
        assert size_of(picture) == (800, 800) and not filecmp.cmp(full, picture, shallow=False)
    display.do("keyup", "w")
    session.leave()
    assert session.complaints() == [], session.complaints()


def check_target(display, program, folder, model):
    """A target that no machine holds: motion is drawn with less, all of it is back where it stands."""
    session = Session(display, program, folder, model, "--csv", "target.csv", target=3)
    full = session.shot()
    display.do("keydown", "w")
    time.sleep(2)
    session.press("shift+F12")
    display.do("keyup", "w")
    session.expect(r"saved \S+window\S+\.png")
    session.press("Home")
    time.sleep(1.5)
    assert filecmp.cmp(full, session.shot(), shallow=False)
    session.leave()
    assert session.complaints() == [], session.complaints()
    rows = rows_of(session.folder / "target.csv")
    drawn = [int(row["image_width_drawn"]) for row in rows]
    assert {row["width"] for row in rows} == {"800"} and min(drawn) == 400 and drawn[-1] == 800, drawn
    coarse = {row["error_pixels"] for row in rows if row["image_width_drawn"] == "400"}
    assert float(rows[-1]["error_pixels"]) == 1 and "1" not in coarse, coarse

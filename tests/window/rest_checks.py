"""What a window draws while something moves and once nothing does: refinement at rest, and the time target."""
import filecmp
import pathlib
import subprocess
import sys
import time

from session import Session, rows_of

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "torture"))
from instances import pixels  # noqa: E402


def differing(one, other):
    """The share of pixels in which two pictures differ."""
    rows = list(zip(pixels(one)[3], pixels(other)[3]))
    return sum(a[x : x + 3] != b[x : x + 3] for a, b in rows for x in range(0, len(a), 3)) / (len(rows) * len(rows[0][0]) / 3)


def check_rest(display, program, folder, model):
    """A standing picture becomes what `render` makes of as many frames; the mouse over it stops nothing, a key does."""
    session = Session(display, program, folder, model, "--shadows", "exact", samples=12)
    session.shot()
    display.do("mousemove", 300, 420)
    smooth = session.shot()
    session.shot("shift+F12")
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
    # What a frame remembers of those before it (depth range, choice of shadows) may move edges of shadows by a texel.
    assert differing(full, session.shot()) <= 0.01
    session.leave()
    assert session.complaints() == [], session.complaints()
    rows = rows_of(session.folder / "target.csv")
    drawn = [int(row["image_width_drawn"]) for row in rows]
    assert {row["width"] for row in rows} == {"800"} and min(drawn) == 400 and drawn[-1] == 800, drawn
    coarse = {row["error_pixels"] for row in rows if row["image_width_drawn"] == "400"}
    assert float(rows[-1]["error_pixels"]) == 1 and "1" not in coarse, coarse

"""What a person measures with the mouse, and the views that a key goes back to."""
import csv
import json
import pathlib
import re
import subprocess
import time

from session import Session

ORIGIN = (500000.1, 5200000.7, 431.3)  # as UTM coordinates are
SIZE = (12.5, 7.3, 3.1)
SIDES = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def make_box(program, folder):
    """A box whose corner `i` has bit 0 of `i` for x, bit 1 for y, bit 2 for z."""
    corners = [[ORIGIN[axis] + SIZE[axis] * (i >> axis & 1) for axis in range(3)] for i in range(8)]
    mesh = folder / "box.ply"
    mesh.write_text("ply\nformat ascii 1.0\nelement vertex 8\n" + "".join(f"property double {axis}\n" for axis in "xyz") +
                    "element face 6\nproperty list uchar int vertex_indices\nend_header\n" +
                    "".join(" ".join(map(repr, corner)) + "\n" for corner in corners) +
                    "".join(" ".join(map(str, (4, *side))) + "\n" for side in SIDES))
    model = folder / "sites" / "box.gnm"
    model.parent.mkdir()
    subprocess.run([program, "build", mesh, "-o", model, "--up", "z"], check=True, capture_output=True)
    return corners, model


def click(display, x, y, *held):
    display.do("mousemove", x, y)
    for key in held:
        display.do("keydown", key)
    time.sleep(0.4)  # two quick clicks would be a double one
    display.do("click", 1)
    for key in held:
        display.do("keyup", key)


def check_measures(display, program, folder):
    """A box is measured from above, corner by corner and on its top, exactly; then saved, over nothing."""
    corners, model = make_box(program, folder)
    session = Session(display, program, folder, model, "--view", "top", "--projection", "orthographic")
    session.shot()
    plain = session.shot("shift+F12")
    session.press("u")
    for x, y in ((80, 580), (720, 580), (720, 220)):
        click(display, x, y, "shift")
    click(display, 20, 20)  # beside the box
    click(display, 400, 400)
    session.press("BackSpace", "Return")
    click(display, 300, 390)
    click(display, 500, 420)
    session.press("shift+u")  # in the same frame as the click, maybe
    saved = session.expect(r"saved (\S+)\.json and \S+\.csv").group(1)
    assert saved == str(model.parent / "box_measures1"), saved
    since = len(session.lines)
    session.press("shift+u")
    session.expect(r"box_measures2\.json", since)
    assert session.shot("shift+F12").read_bytes() != plain.read_bytes()
    session.leave()
    assert session.complaints() == [], session.complaints()
    document = json.loads((model.parent / "box_measures1.json").read_text())
    step = document["grid_step"]
    vertices, top = document["measures"]
    for point, corner in zip(vertices["points"], (corners[4], corners[5], corners[7]), strict=True):
        for found, expected in zip(point["position"], corner):
            assert abs(found - expected) <= step / 2 + 1e-9, (point, corner)
    for leg, expected in zip(vertices["legs"], SIZE[:2], strict=True):
        assert abs(leg - expected) <= step, vertices
    assert abs(vertices["angles_degrees"][0] - 90) < 1e-4 and abs(vertices["area"] - SIZE[0] * SIZE[1] / 2) < 20 * step
    assert [point["position"][2] for point in top["points"]] == [vertices["points"][0]["position"][2]] * 2
    assert top["height"] == 0 and 2 < top["straight"] < 5, top
    with open(model.parent / "box_measures1.csv", newline="") as file:
        assert [row["measure"] for row in csv.DictReader(file)] == ["1", "1", "1", "2", "2"]


def camera(session):
    since = len(session.lines)
    session.shot()  # all has come to rest
    time.sleep(0.5)
    session.press("i")
    return json.loads((session.folder / session.expect(r"saved (\S+camera\S+)", since).group(1)).read_text())


def check_recent_views(display, program, folder, model):
    """Left and Right go through the views at which the camera stood, back and forth, in the next window too."""
    state = pathlib.Path(folder) / "state"
    session = Session(display, program, folder, model, state=state)
    views = [camera(session)]
    for key in ("1", "3", "5"):
        session.press(key)
        time.sleep(1)
        views.append(camera(session))
    for key, expected in (("Left", 2), ("Left", 1), ("Left", 0), ("Left", 0), ("Right", 1), ("Right", 2)):
        session.press(key)
        time.sleep(1)
        found = camera(session)
        for which in ("eye", "target"):
            far = max(abs(a - b) for a, b in zip(found[which], views[expected][which]))
            assert far < 1e-3 * max(map(abs, views[0]["eye"])), (key, expected, found, views)
    session.leave()
    assert session.complaints() == [], session.complaints()
    kept, = (state / "gnomon" / "views").glob("*.json")
    assert json.loads(kept.read_text())["model"] == str(pathlib.Path(model).resolve()), kept.read_text()

    again = Session(display, program, folder, model, state=state)
    time.sleep(2)  # at home, as the first view was
    again.press("Left")
    time.sleep(1)
    found = camera(again)
    assert any(max(abs(a - b) for a, b in zip(found["eye"], view["eye"])) < 1e-3 * max(map(abs, view["eye"]))
               for view in views[1:]), (found, views)
    again.leave()
    assert again.complaints() == [], again.complaints()

    for broken in ("no JSON", '{"model": "a", "views": [{"eye": 1}]}'):
        kept.write_text(broken)
        session = Session(display, program, folder, model, state=state)
        session.expect(re.escape(kept.name))
        time.sleep(1)
        session.leave()
        json.loads(kept.read_text())
    state.joinpath("blocked").write_text("a file")
    session = Session(display, program, folder, model, state=state / "blocked")
    time.sleep(1)
    session.leave()
    session.expect("cannot save recent views")


def settled_shot(session):
    """A shot that the next one is equal to: what comes from the disk while the window starts has come."""
    before = session.shot()
    for _ in range(20):
        time.sleep(0.5)
        after = session.shot()
        if after.read_bytes() == before.read_bytes():
            return after
        before = after
    raise AssertionError("no two shots in a row are equal")


def check_colors(display, program, folder, model):
    """Y goes through the values that colour the surface; the window's picture is that of `render`."""
    session = Session(display, program, folder, model, "--backend", "software", "--color-by", "error")
    shots = {}
    for value in ("error", "none", "height", "slope"):
        shots[value] = settled_shot(session)
        session.press("y")
    session.press("shift+y")
    assert settled_shot(session).read_bytes() == shots["slope"].read_bytes()
    session.leave()
    assert session.complaints() == [], session.complaints()
    rendered = session.folder / "colored.png"
    for value in ("error", "height", "slope"):
        subprocess.run([program, "render", model, "-o", rendered, "--color-by", value], check=True, capture_output=True)
        assert rendered.read_bytes() == shots[value].read_bytes(), value

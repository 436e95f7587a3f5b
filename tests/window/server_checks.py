"""The window on a model that a server has."""
import pathlib
import sys
import time
import unittest.mock

from session import PATIENCE, Session

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "hierarchy/source"))
from range_server import RangeServer  # noqa: E402


def expect_picture(session, expected):
    """Frames do not wait for pages: the picture is `expected` in the end."""
    end = time.monotonic() + PATIENCE
    while session.shot().read_bytes() != expected:
        assert time.monotonic() < end, (len(expected), session.shot().stat().st_size, session.lines[:3])
        time.sleep(0.5)


def check_server(display, program, folder, model):
    """Failing while pages come, the server leaves a picture of their parents; killed and restarted, the one from disk."""
    session = Session(display, program, folder, model, "--error-pixels", "0.2")
    session.shot()
    time.sleep(2)  # frames wait for no page of a disk, either
    expected = session.shot().read_bytes()
    session.leave()

    def at_server(server, cache):
        local = {"XDG_CACHE_HOME": str(cache), "NO_PROXY": "127.0.0.1", "no_proxy": "127.0.0.1"}
        with unittest.mock.patch.dict(display.environment, local):
            return Session(display, program, folder, server.address(pathlib.Path(model).name), "--error-pixels", "0.2")

    with RangeServer(pathlib.Path(model).parent) as server:
        session = at_server(server, pathlib.Path(folder) / "cache of the healthy")
        expect_picture(session, expected)
        session.press("u")
        display.do("mousemove", 400, 400, "click", 1)
        session.press("shift+u")
        saved = session.expect(r"saved (\S+\.json) and (\S+\.csv)")
        assert all((session.folder / name).read_text() for name in saved.groups()), saved
        session.leave()
        healthy = server.requests
    assert session.complaints() == [] and healthy > 10, (session.complaints(), healthy)

    cache = pathlib.Path(folder) / "cache"
    with RangeServer(pathlib.Path(model).parent) as server:
        server.faults.status = lambda number: 503 if number > healthy * 4 // 5 else None  # all but the finest pages come
        session = at_server(server, cache)
        session.expect("pages could not be read, coarser pages are drawn until a new try succeeds")
    port = server.server_port
    coarse = session.shot("shift+F12").read_bytes()
    assert len(coarse) > 10000, "something is drawn"
    with RangeServer(pathlib.Path(model).parent, port) as server:
        expect_picture(session, expected)
        assert server.requests > 0
    told = [line for line in session.complaints() if "new try" not in line]
    assert told == [] and len(session.complaints()) < 4, session.complaints()
    session.leave()
    assert any(cache.rglob("*-*")), "what was read is kept"

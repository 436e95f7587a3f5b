"""Opens a model in the window under Xvfb and saves the window with its panel as a PNG.

usage: shoot_window.py GNOMON MODEL.gnm OUT.png OPTION...
"""
import pathlib
import shutil
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "window"))
import session

program, model, picture, *options = sys.argv[1:]
with tempfile.TemporaryDirectory() as folder:
    display = session.Display()
    window = session.Session(display, program, folder, model, *options, samples=16)
    window.press("Tab")
    time.sleep(20)  # until the picture at rest has all its samples
    shutil.copy(window.shot("shift+F12"), picture)
    window.leave()
    display.close()

"""Saves the first figure of a report as a PNG.

usage: shoot_report.py REPORT/index.html OUT.png
"""
import base64
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "browser"))
import webdriver

with webdriver.Browser(width=900) as browser:
    browser.open(pathlib.Path(sys.argv[1]).resolve().as_uri())
    found = browser.call("POST", "/element", {"using": "css selector", "value": "#error-time svg"})
    picture = browser.call("GET", f"/element/{found[webdriver.ELEMENT]}/screenshot")
    pathlib.Path(sys.argv[2]).write_bytes(base64.b64decode(picture))

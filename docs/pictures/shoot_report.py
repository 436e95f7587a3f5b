"""Saves the first chart of a report as a PNG.

usage: shoot_report.py REPORT/index.html OUT.png
"""
import base64
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "browser"))
import webdriver

CHART = """const chart = document.querySelector('#error-time');
const copy = Object.assign(document.createElement('canvas'), { width: chart.width, height: chart.height });
const context = copy.getContext('2d');
context.fillStyle = 'white';
context.fillRect(0, 0, copy.width, copy.height);
context.drawImage(chart, 0, 0);
return copy.toDataURL();"""

with webdriver.Browser(width=900) as browser:
    browser.open(pathlib.Path(sys.argv[1]).resolve().as_uri())
    pathlib.Path(sys.argv[2]).write_bytes(base64.b64decode(browser.run(CHART).split(",")[1]))

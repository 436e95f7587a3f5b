"""Opens a report in headless Chromium and tries every control.

usage: report_page_test.py PAGE.html [SCREENSHOT.png]
"""
import base64
import json
import pathlib
import sys
import time
import unittest

import webdriver

PAGE = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "report.html").resolve()
SCREENSHOT = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
SET = "const e = document.querySelector(arguments[0]); e.value = arguments[1]; e.dispatchEvent(new Event(arguments[2]));"
MARKS = "return document.querySelectorAll(arguments[0]).length"
OVERFLOW = """const wide = [];
for (const node of document.querySelectorAll('body *'))
  if (node.getBoundingClientRect().right > document.documentElement.clientWidth + 1) wide.push(node.outerHTML.slice(0, 80));
return [document.documentElement.scrollWidth - document.documentElement.clientWidth, wide];"""
OVERLAPS = """const found = [];
for (const figure of document.querySelectorAll('.plot')) {
  for (const axis of ['x', 'y']) {
    const boxes = [...figure.querySelectorAll('.tick.' + axis)].map((tick) => [tick.textContent, tick.getBoundingClientRect()]);
    boxes.forEach(([text, a], i) => boxes.slice(i + 1).forEach(([other, b]) => {
      if (a.left < b.right && b.left < a.right && a.top + 2 < b.bottom && b.top + 2 < a.bottom) found.push([figure.id, text, other]);
    }));
  }
}
return found;"""
TABLE = """const table = document.querySelector('#table');
const texts = (row) => [...row.cells].map((cell) => cell.textContent);
return [texts(table.tHead.rows[0]), [...table.tBodies[0].rows].map((row) => ({ cells: texts(row), front: row.className === 'front' }))];"""
CLICK_POINT = """const points = [...document.querySelectorAll('#error-time .point')];
points.find((point) => point.dataset.run === arguments[0]).dispatchEvent(new MouseEvent('click', { bubbles: true }));"""


class ReportPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.browser = webdriver.Browser()
        cls.browser.open(PAGE.as_uri())
        cls.data = json.loads(cls.browser.run("return document.getElementById('data').textContent"))

    @classmethod
    def tearDownClass(cls):
        if SCREENSHOT:
            SCREENSHOT.write_bytes(base64.b64decode(cls.browser.screenshot()))
        cls.browser.__exit__()

    def tearDown(self):
        self.assertEqual([], self.browser.console())

    def text(self, selector):
        return self.browser.run("return document.querySelector(arguments[0]).textContent", selector)

    def figures(self):
        return self.browser.run("return [...document.querySelectorAll('.plot')].map((figure) => figure.id)")

    def resize(self, width):
        self.browser.call("POST", "/goog/cdp/execute", {"cmd": "Emulation.setDeviceMetricsOverride", "params": {
            "width": width, "height": 1000, "deviceScaleFactor": 1, "mobile": width < 500}})
        self.browser.open(PAGE.as_uri())

    def test_it_is_drawn_and_asks_nobody(self):
        self.assertEqual("yes", self.browser.run("return document.documentElement.dataset.ready"))
        for name in ["error-time", "stages", "path"]:
            self.assertIn(name, self.figures())
        for name in self.figures():
            self.assertGreater(self.browser.run(MARKS, f"#{name} svg *"), 10, name)
        asked = [url for url in self.browser.requests() if not url.startswith(("file:", "data:"))]
        self.assertEqual([], asked)

    def test_nothing_is_wider_than_the_page_and_no_ticks_overlap(self):
        try:
            for width in (1280, 390):
                self.resize(width)
                kinds = self.browser.run("return [...document.querySelector('#error-kind').options].map((o) => o.value)")
                for kind in kinds:
                    self.browser.run(SET, "#error-kind", kind, "change")
                    self.assertEqual([0, []], self.browser.run(OVERFLOW), f"{width} px, {kind}")
                    self.assertEqual([], self.browser.run(OVERLAPS), f"{width} px, {kind}")
        finally:
            self.resize(1280)

    def test_each_figure_can_be_downloaded(self):
        for name in self.figures():
            links = self.browser.run("return [...document.querySelectorAll(arguments[0])].map((a) => [a.download, decodeURIComponent(a.href)])", f"#{name} .downloads a")
            self.assertEqual([f"{name}.svg", f"{name}.csv"], [file for file, _ in links])
            self.assertIn("<svg", links[0][1])
            self.assertGreater(len(links[1][1].splitlines()), 1, name)

    def test_figures_have_error_bars(self):
        noisy = [r for r in self.data["runs"] if r["noise"] is not None]
        if noisy:
            for name in ("error-time", "stages"):
                self.assertGreaterEqual(self.browser.run(MARKS, f"#{name} .error-bar"), len(noisy), name)

    def test_zero_has_a_place_on_a_logarithmic_axis(self):
        kind = "wrong_pixels_all"
        if not any(r["errors"].get(kind) == 0 for r in self.data["runs"]):
            self.skipTest("no run of this page is without an error")
        self.browser.run("document.querySelector('#log-error').checked = true")
        self.browser.run(SET, "#error-kind", kind, "change")
        shown = self.browser.run("return [...document.querySelectorAll('#error-time .point')].map((p) => p.dataset.run)")
        self.assertEqual({r["name"] for r in self.data["runs"] if kind in r["errors"]}, set(shown))
        labels = self.browser.run("return [...document.querySelectorAll('#error-time .tick.y')].map((t) => t.textContent)")
        self.assertEqual(1, labels.count("0"))

    def test_layouts_of_cells_are_compared_with_maps(self):
        exact = [r for r in self.data["runs"] if "cells" in r["settings"]]
        if len(exact) < 2:
            return self.assertTrue(self.browser.run("return document.querySelector('#cells') === null"))
        self.assertGreaterEqual(self.browser.run(MARKS, "#cells svg rect"), len(exact))

    def test_every_error_can_be_chosen(self):
        kinds = self.browser.run("return [...document.querySelector('#error-kind').options].map((o) => o.value)")
        self.assertTrue(kinds)
        for kind in kinds:
            self.browser.run(SET, "#error-kind", kind, "change")
            known = [r for r in self.data["runs"] if kind in r["errors"]]
            self.assertEqual(len(known), self.browser.run(MARKS, "#error-time .point"), kind)
            self.assertEqual(len(self.data["fronts"][kind]), self.browser.run(MARKS, "#table tr.front"))
        self.browser.run(SET, "#error-kind", self.data["leading_error"], "change")

    def test_a_limit_shows_the_run_that_the_program_recommends(self):
        for name, steps, scale in (("budget", "budget_steps", 1), ("bound", "bound_steps", 100)):
            for limit, run in self.data[steps]:
                self.browser.run(SET, f"#{name}", repr(limit * scale), "input")
                self.assertTrue(self.text(f"#{name}-answer").startswith(self.data["runs"][run]["options"]), (name, limit))
        if self.data["budget_steps"]:
            self.browser.run(SET, "#budget", "0", "input")
            self.assertEqual("no run", self.text("#budget-answer"))

    def test_the_table_sorts(self):
        first = lambda: self.browser.run("return document.querySelector('#table tbody td').textContent")
        self.browser.click("#table th")
        ascending = first()
        self.browser.click("#table th")
        self.assertNotEqual(ascending, first())

    def test_columns_vary_and_the_rest_is_said_once(self):
        head, rows = self.browser.run(TABLE)
        for i, title in enumerate(head):
            if title not in ("#", "settings", "median ms") and len(rows) > 1:
                self.assertGreater(len({row["cells"][i] for row in rows}), 1, title)
        same = self.text("#same")
        settings = {key for run in self.data["runs"] for key in run["settings"]}
        for key in settings:
            values = {run["settings"].get(key) for run in self.data["runs"]}
            self.assertEqual(len(values) == 1, f"{key} " in same, (key, same))

    def test_the_page_opens_with_the_same_view_at_up_to_three_prices(self):
        kind = self.data["leading_error"]
        pictured = {p["run"] for p in self.data["pictures"] if p["kind"] == "picture"}
        runs = [r for r in self.data["runs"] if r["name"] in pictured and kind in r["errors"]]
        fastest = min(runs, key=lambda r: r["p50"], default=None)
        best = min(runs, key=lambda r: (r["errors"][kind], r["p50"]), default=None)
        if fastest is best:
            return self.assertTrue(self.browser.run("return document.querySelector('#prices') === null"))
        shown = self.browser.run("return [...document.querySelectorAll('#prices img')].map((i) => [i.alt, i.naturalWidth >= 0])")
        self.assertIn(len(shown), (2, 3))
        self.assertEqual([fastest["name"], best["name"]], [shown[0][0], shown[-1][0]])
        self.assertEqual("two" if len(shown) == 2 else "three", self.text("#prices-count"))

    def test_pictures_slide(self):
        if not self.data["pictures"]:
            self.skipTest("this page has no pictures")
        self.browser.run(SET, "#slider", "20", "input")
        self.assertIn("80%", self.browser.run("return document.querySelector('#left-image').style.clipPath"))

    def test_a_click_on_a_point_shows_its_pictures(self):
        pictured = {(p["run"], p["kind"]) for p in self.data["pictures"]}
        runs = [i for i, r in enumerate(self.data["runs"]) if {(r["name"], "picture"), (r["name"], "reference")} <= pictured]
        if not runs:
            self.skipTest("this page has no references")
        name = self.data["runs"][runs[-1]]["name"]
        self.browser.run(CLICK_POINT, name)
        chosen = lambda side: self.browser.run("return document.querySelector(arguments[0]).selectedOptions[0].text", f"#{side}-picture")
        # The page handles an event in the next frame of the browser, which can come after the answer of this script.
        late = time.monotonic() + 30
        while chosen("left") != f"{name}: picture" and time.monotonic() < late:
            time.sleep(0.05)
        self.assertEqual(f"{name}: picture", chosen("left"))
        self.assertEqual(f"{name}: reference", chosen("right"))

    def test_it_says_what_to_type_and_numbers_its_runs(self):
        head, rows = self.browser.run(TABLE)
        self.assertEqual(sorted(str(i + 1) for i in range(len(self.data["runs"]))), sorted(row["cells"][0] for row in rows))
        recommended = self.data["recommended"]
        self.assertIn(recommended["reason"], self.text("#recommended-why"))
        if "command" in recommended:
            self.assertEqual(recommended["command"], self.text("#command"))
        explained = self.browser.run("return [...document.querySelectorAll('#terms dt')].map((term) => term.textContent)")
        for title in head:
            if title not in ("95% ms", "99% ms", "shadow triangles"):  # with median and image triangles
                self.assertIn(title, explained, "a column without an explanation")

    def test_no_run_measures_more_than_it_promises(self):
        for run in self.data["runs"]:
            errors = run["errors"]
            if "measured_aliasing" in errors and run["bound_kept"]:
                self.assertLessEqual(errors["measured_aliasing"], errors["promised_aliasing"] * 1.001, run["name"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])

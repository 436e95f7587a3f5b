"""Measures of a box whose size is known, near the origin and at UTM coordinates: exact to the step of the grid."""
import csv
import io
import itertools
import json
import math
import unittest

from program import ProgramTest, run

SIZE = (12.5, 7.3, 3.1)
PLACES = {"near": (0.0, 0.0, 0.0), "utm": (500000.1, 5.2e6 + 0.7, 431.3)}
SIDES = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
VIEW = ("--projection", "orthographic", "--up", "z", "--size", "400x400")


def corner(place, which):
    """Of the box: bits of `which` are x, y, z."""
    return [PLACES[place][axis] + (SIZE[axis] if which >> axis & 1 else 0) for axis in range(3)]


def box(place):
    lines = ["ply", "format ascii 1.0", "element vertex 8", *(f"property double {axis}" for axis in "xyz"),
             "element face 6", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(repr(c) for c in corner(place, which)) for which in range(8)]
    lines += [" ".join(map(str, (4, *side))) for side in SIDES]
    return "\n".join(lines) + "\n"


class Measuring(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.models = {}
        for place in PLACES:
            mesh = cls.place / f"{place}.ply"
            mesh.write_text(box(place))
            cls.models[place] = mesh.with_suffix(".gnm")
            built = run("build", mesh, "-o", cls.models[place], "--up", "z")
            assert built.returncode == 0, built.stderr

    def measured(self, place, *words):
        return json.loads(self.expect(0, "", "measure", self.models[place], "--json", *words).stdout)

    def test_lengths_heights_angles_and_areas_by_coordinates(self):
        for place in PLACES:
            path = [corner(place, which) for which in (0, 1, 3, 7)]
            found = self.measured(place, *itertools.chain(*(("--point", ",".join(map(repr, p))) for p in path)))
            step, measure = found["grid_step"], found["measures"][0]
            for point, expected in zip(measure["points"], path):
                for is_, should in zip(point["position"], expected):
                    self.assertLessEqual(abs(is_ - should), step / 2 + 1e-9)
            for is_, should in zip(measure["legs"], SIZE):
                self.assertLessEqual(abs(is_ - should), step)
            self.assertLessEqual(abs(measure["straight"] - math.hypot(*SIZE)), 2 * step)
            self.assertLessEqual(abs(measure["height"] - SIZE[2]), step)
            self.assertLessEqual(abs(measure["level"] - math.hypot(*SIZE[:2])), 2 * step)
            for angle in measure["angles_degrees"]:
                self.assertLess(abs(angle - 90), math.degrees(4 * step / min(SIZE)))
            floor = self.measured(place, *itertools.chain(
                *(("--point", ",".join(map(repr, corner(place, which)))) for which in (0, 1, 3, 2))))["measures"][0]
            self.assertLessEqual(abs(floor["area"] - SIZE[0] * SIZE[1]), step * (SIZE[0] + SIZE[1]))
            self.assertEqual(floor["area"], floor["plan_area"])

    def test_points_of_pixels_lie_on_what_is_drawn(self):
        for place in PLACES:
            view = (*VIEW, "--view", "top")
            found = self.measured(place, *view, "--pixel", "200,200", "--pixel", "150,210")
            step = found["grid_step"]
            for point in found["measures"][0]["points"]:
                self.assertLessEqual(abs(point["position"][2] - corner(place, 7)[2]), step / 2 + 1e-9)
                self.assertLessEqual(point["within"], 2 * step)
            self.assertEqual(found["measures"][0]["height"], 0)
            # From above the top fills the picture's width but for a margin; its corners are the nearest vertices.
            found = self.measured(place, *view, "--vertices", "--pixel", "40,290", "--pixel", "360,290", "--pixel", "360,110")
            for point, which in zip(found["measures"][0]["points"], (4, 5, 7)):
                for is_, should in zip(point["position"], corner(place, which)):
                    self.assertLessEqual(abs(is_ - should), step / 2 + 1e-9, (place, point, which))
            self.assertLessEqual(abs(found["measures"][0]["legs"][0] - SIZE[0]), step)
            self.assertLessEqual(abs(found["measures"][0]["legs"][1] - SIZE[1]), step)

    def test_caps_of_sections_are_measured_too(self):
        middle = [PLACES["utm"][axis] + SIZE[axis] / 2 for axis in range(3)]
        plane = ",".join(map(repr, (*middle, 0.0, 0.0, 1.0)))
        found = self.measured("utm", *VIEW, "--view", "top", "--section", plane, "--pixel", "200,200")
        self.assertLessEqual(
            abs(found["measures"][0]["points"][0]["position"][2] - middle[2]), found["grid_step"] / 2 + 1e-9)
        perspective = self.measured(
            "utm", "--up", "z", "--view", "iso", "--section", plane, "--pixel", "400,400")
        self.assertLessEqual(
            abs(perspective["measures"][0]["points"][0]["position"][2] - middle[2]), found["grid_step"] / 2 + 1e-9)

    def test_text_and_csv(self):
        points = ("--point", "0,0,0", "--point", "3,4,0", "--point", "3,4,5")
        text = self.expect(0, "", "measure", self.models["near"], *points).stdout
        self.assertIn("along 10.000000 m", text)
        self.assertIn("angle 90.0000 degrees at point 2", text)
        rows = list(csv.DictReader(io.StringIO(
            self.expect(0, "", "measure", self.models["near"], "--csv", *points).stdout)))
        self.assertEqual([float(row["along"] or 0) for row in rows], [0, 5, 10])
        self.assertEqual(float(rows[2]["height"]), 5)

    def test_what_cannot_be_measured(self):
        model = self.models["near"]
        self.expect(2, "--point X,Y,Z or --pixel X,Y", "measure", model)
        self.expect(2, "--point X,Y,Z or --pixel X,Y", "measure", model, "--point", "0,0,0", "--pixel", "1,1")
        self.expect(2, "--vertices needs --pixel", "measure", model, "--point", "0,0,0", "--vertices")
        self.expect(2, "column and row", "measure", model, "--pixel", "5")
        self.expect(2, "from 0 to 799", "measure", model, "--pixel", "5,800")
        self.expect(2, "expected x,y,z", "measure", model, "--point", "5,8")
        self.expect(1, "no surface is visible", "measure", model, "--pixel", "1,1")
        self.expect(1, "too far from the model", "measure", model, "--point", "1e9,0,0")


if __name__ == "__main__":
    unittest.main()

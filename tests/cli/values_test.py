"""Pictures coloured by what vertices and clusters carry."""
import math
import unittest

from program import ProgramTest, run


def hills(side=60):
    """A ground of waves whose field `copy` is its height, and `rest` something else."""
    rows = [(x / 4, y / 4, 2 * math.sin(x / 9) * math.cos(y / 7)) for y in range(side) for x in range(side)]
    vertices = "".join(f"{x!r} {y!r} {z!r} {z!r} {x * y!r}\n" for x, y, z in rows)
    corners = [y * side + x for y in range(side - 1) for x in range(side - 1)]
    faces = "".join(f"4 {a} {a + 1} {a + side + 1} {a + side}\n" for a in corners)
    properties = "".join(f"property float {name}\n" for name in ("x", "y", "z", "copy", "rest"))
    return (f"ply\nformat ascii 1.0\nelement vertex {len(rows)}\n{properties}element face {len(corners)}\n"
            f"property list uchar int vertex_indices\nend_header\n{vertices}{faces}")


class ColoringByValues(ProgramTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.mesh, cls.model = cls.place / "hills.ply", cls.place / "hills.gnm"
        cls.mesh.write_text(hills())
        built = run("build", cls.mesh, "-o", cls.model, "--up", "z", "--fields", "rest,copy")
        assert built.returncode == 0, built.stderr

    def render(self, name, *words):
        picture = self.place / name
        self.expect(0, "", "render", self.model, "-o", picture, "--size", "200x160", *words)
        return picture

    def test_a_field_that_is_the_height_looks_like_it(self):
        """Seen from above all round, at detail that is the source's; the legends' titles are of the same length."""
        for view in ("top", "iso"):
            words = ("--view", view, "--error-pixels", "0.001", "--color-range=-2,2", "--shadows", "off")
            height = self.render("height.png", "--color-by", "height", *words)
            self.render("copy.png", "--color-by", "copy", *words, "--reference", height, "--reference-threshold", "0.02")
            self.expect(1, "differ", "render", self.model, "-o", self.place / "rest.png", "--size", "200x160", *words[:4],
                        "--shadows", "off", "--color-by", "rest", "--reference", height)

    def test_errors_and_stored_colours(self):
        self.render("error.png", "--color-by", "error")
        self.expect(1, "the model stores no vertex colours", "render", self.model, "-o", self.place / "a.png", "--color-by",
                    "vertex")
        self.expect(0, "", "render", self.sundial, "-o", self.place / "stored.png", "--color-by", "vertex")

    def test_what_is_not_there_is_said(self):
        picture = self.place / "wrong.png"
        self.expect(1, "vertex, height, slope, error, rest, copy, found 'heigth'", "render", self.model, "-o", picture,
                    "--color-by", "heigth")
        self.expect(2, "only the software backend", "render", self.model, "-o", picture, "--color-by", "copy", "--backend",
                    "osmesa")
        self.expect(2, "--color-range needs", "render", self.model, "-o", picture, "--color-by", "vertex", "--color-range",
                    "0,1")
        self.expect(2, "without an overlay", "render", self.model, "-o", picture, "--color-by", "copy", "--overlay", "lod")
        self.expect(2, "expected viridis, cividis or grey", "render", self.model, "-o", picture, "--color-by", "copy",
                    "--colormap", "jet")
        self.assertFalse(picture.exists())


if __name__ == "__main__":
    unittest.main()

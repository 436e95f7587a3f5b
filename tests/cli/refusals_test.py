"""What contradicts itself or cannot be right is refused before any work: exit 2 and one line."""
import unittest

from program import DATA, Workplace, run

PATH = DATA / "paths/sundial_orbit.json"
SMALL = ("--size", "32x32", "--shadow-texels", "128x128", "--frames", "1", "--warmup", "0")


class Refusals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = Workplace()
        cls.sundial = cls.place / "sundial.gnm"

    @classmethod
    def tearDownClass(cls):
        cls.place.close()

    def expect(self, code, said, *words, **options):
        result = run(*words, **options)
        self.assertEqual(result.returncode, code, f"{words}: {result.stderr}")
        self.assertIn(said, result.stderr)
        if code:
            self.assertEqual(result.stderr.count("\n"), 1, f"{words}: {result.stderr}")
            self.assertTrue(result.stderr.startswith("gnomon: "), result.stderr)
        return result

    def bench(self, code, said, *words):
        return self.expect(code, said, "bench", self.sundial, "--path", PATH, *SMALL, *words)

    def test_a_list_has_items_and_none_is_empty(self):
        for option in ("--warp", "--error-pixels", "--shadow-maps", "--z-partitions", "--shadow-texels"):
            for empty in ("", ",", "1,", ",1", "1,,2"):
                self.bench(2, option, option, empty)


if __name__ == "__main__":
    unittest.main()

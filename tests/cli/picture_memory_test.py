"""The peak resident size of pictures stays under --memory: they are drawn in bands, to the same bytes."""
import pathlib
import unittest

from program import GNOMON, ProgramTest, measured

# Sanitizers keep what is freed, and shadow all that is used.
IS_SANITIZED = any(name in pathlib.Path(GNOMON).read_bytes() for name in (b"__asan_init", b"__tsan_init"))


@unittest.skipIf(IS_SANITIZED, "sanitizers need memory of their own")
class PictureMemory(ProgramTest):
    def peak(self, *words):
        """Of a run that succeeds, in bytes."""
        drawn = measured(GNOMON, "render", self.sundial, *words)
        self.assertEqual((drawn.code, drawn.err), (0, ""))
        return drawn.peak

    def test_a_large_picture_stays_under_the_cap(self):
        narrow, wide = self.place / "narrow.png", self.place / "wide.png"
        for words in (("--size", "1500x1100", "--samples", "2"), ("--size", "1500x1100", "--samples", "1", "--shadows", "maps")):
            self.assertLessEqual(self.peak(*words, "-o", narrow, "--memory", "112M"), 112 << 20)
            self.peak(*words, "-o", wide)
            self.assertEqual(narrow.read_bytes(), wide.read_bytes())

    def test_a_picture_that_does_not_fit_says_what_it_needs(self):
        drawn = ("render", self.sundial, "-o", self.place / "no.png", "--size", "9000x9000", "--memory", "160M")
        self.expect(1, "--memory", *drawn)
        self.expect(1, "at least", *drawn)


if __name__ == "__main__":
    unittest.main()

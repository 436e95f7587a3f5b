"""The layer lint must go red for each kind of breach, and stay green for what is allowed."""
import pathlib
import tempfile
import unittest

import check_layers

TABLE = """core: | glm
shadow: core | glm
preprocess/read: core | zstd.h
preprocess/chunk: core preprocess/read
"""
# Every permission of the table has an include.
USED = {
    "src/core/a.h": "#include <glm/vec3.hpp>\n",
    "src/shadow/a.h": '#include "core/a.h"\n#include <glm/vec3.hpp>\n',
    "preprocess/read/p.cpp": '#include "core/a.h"\n#include <zstd.h>\n',
    "preprocess/chunk/p.cpp": '#include "core/a.h"\n#include "preprocess/read/c.h"\n',
}


class CheckLayers(unittest.TestCase):
    def breaches(self, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in {"src/layers.txt": TABLE, **USED, **files}.items():
                path = root / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text)
            return list(check_layers.breaches(root))

    def test_allowed_includes_are_clean(self):
        self.assertEqual([], self.breaches({
            "src/shadow/a.cpp": '#include "shadow/a.h"\n#include "core/a.h"\n#include <glm/glm.hpp>\n#include <vector>\n',
            "preprocess/read/b.cpp": '#include "preprocess/read/c.h"\n#include <zstd.h>\n#include <sys/stat.h>\n',
            "preprocess/chunk/e.cpp": '#include "preprocess/read/c.h"\n#include "preprocess/chunk/f.h"\n'}))

    def test_each_breach_is_found(self):
        for name, text in {
            "src/core/b.h": '#include "shadow/a.h"\n',
            "src/core/c.h": "#include <tbb/task_group.h>\n",
            "src/shadow/d.cpp": "#include <zstd.h>\n",
            "src/shadow/e.cpp": '#include "neighbour.h"\n',
            "src/attic/f.cpp": "",
            "preprocess/read/g.cpp": '#include "shadow/a.h"\n',
            "preprocess/read/h.cpp": '#include "preprocess/chunk/i.h"\n',
            "preprocess/chunk/j.cpp": "#include <zstd.h>\n",
            "preprocess/attic/k.cpp": "",
            "preprocess/l.cpp": "",
        }.items():
            with self.subTest(name):
                self.assertEqual(1, len(self.breaches({name: text})))

    def test_each_unused_permission_is_found(self):
        for name, text in {
            "src/core/a.h": "",
            "src/shadow/a.h": "#include <glm/vec3.hpp>\n",
            "preprocess/read/p.cpp": '#include "core/a.h"\n',
            "preprocess/chunk/p.cpp": '#include "core/a.h"\n',
        }.items():
            with self.subTest(name):
                (found,) = self.breaches({name: text})
                self.assertIn("remove the permission", found)

    def test_rows_name_only_rows_above_them(self):
        for table, named in {
            "core: shadow | glm\nshadow: core | glm\npreprocess/read: core | zstd.h\npreprocess/chunk: core preprocess/read\n":
                "core names shadow",  # a cycle
            "core: | glm\nshadow: preprocess/read\npreprocess/read: core | zstd.h\n": "shadow names preprocess/read",
            "core: | glm\nshadow: cores\n": "shadow names cores",  # unknown
        }.items():
            with self.subTest(named):
                self.assertTrue(any(named in found for found in self.breaches({"src/layers.txt": table})))


if __name__ == "__main__":
    unittest.main()

"""Where the layers lie, which stand directly above which, and what tests them: read from src/layers.txt and the folders."""
import pathlib
import re

TEST_PROGRAM = re.compile(r'\bgnomon_tests\(\s*(\w+)')
LIBRARY = re.compile(r'\bgnomon_layer\(\s*(\w+)')


def read_rows(root):
    """layer -> the layers it may include"""
    rows = {}
    for line in (root / "src/layers.txt").read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            name, rest = line.split(":", 1)
            rows[name.strip()] = set(rest.partition("|")[0].split())
    return rows


def row_of(rows, name):
    """The row that `name` names, with or without the folder before it: `simplify` is `preprocess/simplify`."""
    return next((row for row in rows if name in (row, row.rpartition("/")[2])), name)


def folder_of(root, layer):
    """The folder of a layer: a row `preprocess/x` is one below the root, any other one of src/."""
    for place in (root / "src" / layer, root / layer):
        if place.is_dir():
            return place
    raise SystemExit(f"mutate.py: no folder src/{layer} or {layer}")


def directly_above(rows, layer):
    """Who includes `layer` other than by way of a layer in between, in the table's order."""
    users = [name for name, below in rows.items() if layer in below and name != "app"]
    return [name for name in users if not any(between in rows[name] for between in users)]


def sources(root, layer):
    return sorted(p for p in folder_of(root, layer).rglob("*") if p.suffix in {".cpp", ".h"})


def test_programs(root, layer):
    """The test programs that the folder of a layer's tests declares."""
    folder = root / "tests" / layer.removeprefix("preprocess/")
    lists = [folder / "CMakeLists.txt", *sorted(folder.glob("*.cmake"))]
    return [f"{name}_tests" for path in lists if path.exists() for name in TEST_PROGRAM.findall(path.read_text())]


def library(root, layer):
    """The name of the layer's static library."""
    found = LIBRARY.search((folder_of(root, layer) / "CMakeLists.txt").read_text())
    return f"gnomon_{found.group(1)}"

"""The house rules that a script can check: no include cycles, folders and files of a size that can be read, a small
src/app, short functions in scripts and shaders, and how much of the code tests look at.

usage: house.py [ROOT]             fails when a rule that holds is broken
       house.py --report [ROOT]    prints every rule's breaches and the figures, and fails never
"""
import argparse
import ast
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.MULTILINE)
COMMENT, STRING, OPTION = re.compile(r"//.*"), re.compile(r'"(?:[^"\\\n]|\\.)*"'), re.compile(r"--[a-z]")
STREAM = re.compile(r"\b(?:stdout|stderr|std::c(?:out|err|log)\b|(?:f|v|vf)?printf\(|f?puts\()")
CODE = {".h", ".cpp", ".inc"}
SHADERS = {".glsl", ".vert", ".frag", ".comp", ".geom"}
READ_BY_PEOPLE = CODE | SHADERS | {".py", ".cmake", ".js", ".css", ".html", ".sh", ""}
UNTESTED = "tests/lint/untested.txt"
MOST_FILES, MOST_LINES, MOST_FUNCTION_LINES, MOST_APP_LINES, LEAST_RATIO = 35, 400, 60, 2500, 0.7


def tracked(root, *tops):
    """All files below the folders `tops`, but for what a build or Python leaves there."""
    for top in tops:
        for path in sorted((root / top).rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                yield path


def line_count(path):
    return path.read_text().count("\n")


def code_lines(root, *tops):
    return sum(line_count(p) for p in tracked(root, *tops) if p.suffix in {".h", ".cpp"})


def unit_of(path):
    """A header and its source are one unit: a path without its ending."""
    return str(path.with_suffix(""))


def includes(root):
    """(file, included file) of this project's own sources, as paths below src/ or from preprocess/ on"""
    for path in tracked(root, "src", "preprocess"):
        if path.suffix not in CODE:
            continue
        own = path.relative_to(root / "src") if path.is_relative_to(root / "src") else path.relative_to(root)
        for header in INCLUDE.findall(path.read_text()):
            if (root / "src" / header).exists() or (root / header).exists():
                yield own, pathlib.PurePath(header)


def graph(edges):
    """node -> the nodes that it needs, without itself"""
    found = {}
    for a, b in edges:
        found.setdefault(a, set())
        if a != b:
            found[a].add(b)
    return found


def reachable(needs, start):
    seen, open_nodes = set(), [start]
    while open_nodes:
        for node in needs.get(open_nodes.pop(), ()):
            if node not in seen:
                seen.add(node)
                open_nodes.append(node)
    return seen


def cycles(needs):
    """Sets of nodes that all need each other, each once."""
    reach = {node: reachable(needs, node) for node in needs}
    found = {frozenset(b for b in reach[a] if a in reach.get(b, ())) for a in needs if a in reach[a]}
    return sorted(", ".join(sorted(group)) for group in found)


def room_of(path):
    """A layer of src/ with all that lies below it, or a folder of preprocess/."""
    return "/".join(path.parent.parts[:2 if path.parts[0] in ("preprocess", "src") else 1])


def folder_cycles(root):
    needs = graph((room_of(a), room_of(b)) for a, b in includes(root))
    return [f"folders include each other: {group}" for group in cycles(needs)]


def unit_cycles(root):
    needs = graph((unit_of(a), unit_of(b)) for a, b in includes(root))
    return [f"units include each other: {group}" for group in cycles(needs)]


def full_folders(root):
    counts = {}
    for path in tracked(root, "src", "preprocess"):
        counts[path.parent] = counts.get(path.parent, 0) + 1
    return [f"{folder.relative_to(root)}: {count} files, at most {MOST_FILES}"
            for folder, count in sorted(counts.items()) if count > MOST_FILES]


def long_files(root):
    places = ("src", "preprocess", "shaders", "tests", "bench", "scripts", "cmake", "examples", "python")
    return [f"{path.relative_to(root)}: {line_count(path)} lines, at most {MOST_LINES}"
            for path in tracked(root, *places) if path.suffix in READ_BY_PEOPLE and line_count(path) > MOST_LINES]


def code_below_app(root):
    """(file, its text without comments) of what knows neither the command line nor the standard streams"""
    for path in tracked(root, "src", "preprocess"):
        if path.suffix in CODE and room_of(path.relative_to(root)) != "src/app":
            yield path.relative_to(root), COMMENT.sub("", path.read_text())


def options_below_app(root):
    for path, text in code_below_app(root):
        if path.parts[:2] != ("src", "settings"):
            yield from (f"{path}: names an option: {text}" for text in STRING.findall(text) if OPTION.search(text))


def streams_below_app(root):
    """A failed check tells of it itself; everybody else hands up what there is to say."""
    for path, text in code_below_app(root):
        if path.stem != "check":
            yield from (f"{path}: writes to {found}" for found in STREAM.findall(text))


def large_app(root):
    lines = code_lines(root, "src/app")
    return [] if lines < MOST_APP_LINES else [f"src/app: {lines} lines of C++, under {MOST_APP_LINES}"]


def python_functions(text):
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            yield node.name, node.end_lineno - node.lineno + 1


def braced_functions(text):
    """Functions of a shader or of a shell script, whose last line is a brace in the first column."""
    start = re.compile(r'^(?:[\w ]+?\b)?(\w+)\([^;{}]*\)\s*\{$', re.MULTILINE)
    for found in start.finditer(text):
        end = re.compile(r'^\}', re.MULTILINE).search(text, found.end())
        if end:
            yield found.group(1), text.count("\n", found.start(), end.start()) + 1


def long_functions(root):
    """What clang-tidy does not read: Python, shell and shaders."""
    for path in tracked(root, "src", "shaders", "tests", "bench", "scripts", "python", "examples"):
        if path.suffix == ".py":
            functions = python_functions(path.read_text())
        elif path.suffix in SHADERS | {".sh", ".js", ""} and path.name != "CMakeLists.txt":
            functions = braced_functions(path.read_text())
        else:
            continue
        for name, lines in functions:
            if lines > MOST_FUNCTION_LINES:
                yield f"{path.relative_to(root)}: {name}: {lines} lines, at most {MOST_FUNCTION_LINES}"


def included_by_tests(root):
    return {header for path in tracked(root, "tests") if path.suffix in CODE for header in INCLUDE.findall(path.read_text())}


def untested_reasons(root):
    """header -> why no test includes it, from the lines "HEADER: reason" of tests/lint/untested.txt"""
    path = root / UNTESTED
    lines = path.read_text().splitlines() if path.exists() else []
    return dict(line.split(": ", 1) for line in lines if line and not line.startswith("#"))


def untested_units(root):
    """Headers of src and preprocess that no C++ of tests/ includes and no reason is given for, and reasons for others."""
    tested, reasons = included_by_tests(root), untested_reasons(root)
    untested = set()
    for path in tracked(root, "src", "preprocess"):
        if path.suffix == ".h":
            name = path.relative_to(root / "src") if path.is_relative_to(root / "src") else path.relative_to(root)
            if str(name) not in tested:
                untested.add(str(path.relative_to(root)))
    yield from (f"{header}: no test includes it" for header in sorted(untested - reasons.keys()))
    yield from (f"{UNTESTED}: {header}: it is no header that no test includes" for header in sorted(reasons.keys() - untested))


def few_tests(root):
    ratio = test_ratio(root)
    return [] if ratio >= LEAST_RATIO else [f"tests: {ratio:.2f} lines for each of src and preprocess, at least {LEAST_RATIO}"]


def test_ratio(root):
    return code_lines(root, "tests") / max(1, code_lines(root, "src", "preprocess"))


RULES = {"folder cycles": folder_cycles, "unit cycles": unit_cycles, "full folders": full_folders, "long files": long_files,
         "large app": large_app, "long functions": long_functions, "few tests": few_tests, "untested units": untested_units,
         "options below app": options_below_app, "streams below app": streams_below_app}
# The rules that hold, and must go on to.
HELD = ("folder cycles", "unit cycles", "full folders", "long files", "large app", "long functions", "options below app",
        "streams below app", "few tests", "untested units")


def report(root):
    for name, rule in RULES.items():
        found = list(rule(root))
        print(f"{name} ({'held' if name in HELD else 'not yet held'}): {len(found)}")
        print("".join(f"    {breach}\n" for breach in found), end="")
    print(f"untested with a reason: {len(untested_reasons(root))} ({UNTESTED})")
    print(f"C++ lines: tests {code_lines(root, 'tests')}, src {code_lines(root, 'src')}, "
          f"preprocess {code_lines(root, 'preprocess')}; tests to source {test_ratio(root):.2f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=".")
    parser.add_argument("--report", action="store_true")
    options = parser.parse_args()
    root = pathlib.Path(options.root).resolve()
    if options.report:
        report(root)
        return 0
    found = [breach for name in HELD for breach in RULES[name](root)]
    print("\n".join(found) or "house: clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

"""Checks the rules for all source files: no include cycles, functions of at most 80 lines in scripts and shaders, and
option names and standard streams only in src/app.

usage: house.py [ROOT]             prints each breach of a rule, and fails if there is one
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
MAX_FUNCTION_LINES = 80


def tracked(root, *tops):
    """All files below the folders `tops`, but for what a build or Python leaves there."""
    for top in tops:
        for path in sorted((root / top).rglob("*")):
            if path.is_file() and "__pycache__" not in path.parts:
                yield path


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
            if lines > MAX_FUNCTION_LINES:
                yield f"{path.relative_to(root)}: {name}: {lines} lines, at most {MAX_FUNCTION_LINES}"


RULES = {"folder cycles": folder_cycles, "unit cycles": unit_cycles, "long functions": long_functions,
         "options below app": options_below_app, "streams below app": streams_below_app}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", nargs="?", default=".")
    root = pathlib.Path(parser.parse_args().root).resolve()
    found = [breach for rule in RULES.values() for breach in rule(root)]
    print("\n".join(found) or "house: clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

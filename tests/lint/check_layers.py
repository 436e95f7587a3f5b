"""Fails if a source file includes a layer or a library that its row in src/layers.txt does not permit, if no file uses a
permission, or if a folder has no row.

usage: check_layers.py [ROOT]
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]', re.MULTILINE)
# What the system itself gives: POSIX and Linux headers, by their first part. Headers of the standard library have no dot.
SYSTEM = {"sys", "linux", "fcntl.h", "malloc.h", "unistd.h", "dirent.h", "dlfcn.h", "poll.h", "pthread.h", "sched.h", "spawn.h"}


def read_layers(text):
    """layer -> (layers it may include, libraries it may include)"""
    layers = {}
    for line in text.splitlines():
        if line.strip() and not line.startswith("#"):
            name, rest = line.split(":", 1)
            ours, _, theirs = rest.partition("|")
            layers[name.strip()] = (set(ours.split()), set(theirs.split()))
    return layers


def folders(root):
    """layer -> its folder; `preprocess/x` lies beside src/"""
    found = {p.name: p for p in (root / "src").iterdir() if p.is_dir()}
    found.update((f"preprocess/{p.name}", p) for p in (root / "preprocess").iterdir() if p.is_dir())
    return found


def layer_of(header):
    """The layer that an include names: `preprocess/x` where the path says so, else the path's first part."""
    parts = header.split("/")
    return "/".join(parts[: 2 if parts[0] == "preprocess" else 1])


def misplaced(layers):
    """A row names only rows above it, so no two layers can need each other."""
    above = {"shaders"}
    for layer, (ours, _) in layers.items():
        for other in sorted(ours - above):
            yield f"src/layers.txt: {layer} names {other}, which is no row above it"
        above.add(layer)


def is_standard(header):
    return "." not in header and "/" not in header


def breaches(root):
    layers = read_layers((root / "src" / "layers.txt").read_text())
    places = folders(root)
    yield from misplaced(layers)
    for path in sorted(p for p in (root / "preprocess").iterdir() if not p.is_dir()):
        yield f"{path.relative_to(root)}: in no layer"
    for name in sorted(set(places) - set(layers)):
        yield f"{places[name].relative_to(root)}: not in src/layers.txt"
    for layer, (ours, theirs) in layers.items():
        if layer not in places:
            continue
        used = {layer}
        for path in sorted(places[layer].rglob("*")):
            if path.suffix not in {".h", ".cpp", ".inc"}:
                continue
            for bracket, header in INCLUDE.findall(path.read_text()):
                if bracket == '"':
                    target = layer_of(header)
                    fine = "/" in header and target in ours | {layer}
                else:
                    target = header.split("/")[0]
                    fine = is_standard(header) or target in SYSTEM or target in theirs
                used.add(target)
                if not fine:
                    yield f"{path.relative_to(root)}: {layer} may not include {header}"
        for target in sorted((ours | theirs) - used):
            yield f"src/layers.txt: {layer} may include {target}, but no file of {layer} includes it; remove the permission"


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".").resolve()
    found = list(breaches(root))
    print("\n".join(found) or "layers: clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

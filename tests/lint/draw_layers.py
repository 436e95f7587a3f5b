"""Draws the layers of src/layers.txt as an SVG: what a layer may include lies below it.

usage: draw_layers.py OUT.svg            writes the picture
       draw_layers.py --check OUT.svg    fails if the picture is not the one of the table as it is
"""
import pathlib
import sys

from check_layers import read_layers

BOX_WIDTH, BOX_HEIGHT, GAP_X, GAP_Y, MARGIN = 118, 30, 16, 52, 20
STYLE = ("text{font:13px sans-serif;text-anchor:middle;fill:#222}rect{fill:#eef3f8;stroke:#5b7a99}"
         "rect.offline{fill:#f7f0e4;stroke:#a08a5b}line{stroke:#9aa7b4;stroke-width:1}")


def below(layers):
    """layer -> the layers right below it: those it may include and reaches through no other"""
    reach = {}
    for name, (ours, _) in layers.items():  # a row names only rows above it
        reach[name] = set(ours).union(*(reach[other] for other in ours))
    return {name: {one for one in ours if not any(one in reach[other] for other in ours if other != one)}
            for name, (ours, _) in layers.items()}


def floors(layers):
    """Lists of layers, the lowest first: each lies one above the highest that it may include."""
    height = {}
    for name, (ours, _) in layers.items():
        height[name] = 1 + max((height[other] for other in ours), default=-1)
    return [[name for name in layers if height[name] == floor] for floor in range(max(height.values()) + 1)]


def ordered(rows, under):
    """Each floor from left to right by the mean place of what lies below, so that lines cross seldom."""
    place = {}
    for row in rows:
        mean = {name: sum(place[one] for one in under[name]) / len(under[name]) if under[name] else 0 for name in row}
        row.sort(key=lambda name: mean[name])  # stable: ties stay in the order of the table
        for i, name in enumerate(row):
            place[name] = (i + 0.5) / len(row)
    return rows


def picture(layers, offline):
    under = below(layers)
    rows = ordered(floors(layers), under)
    width = 2 * MARGIN + max(len(row) for row in rows) * (BOX_WIDTH + GAP_X) - GAP_X
    height = 2 * MARGIN + len(rows) * (BOX_HEIGHT + GAP_Y) - GAP_Y
    corner = {}
    for floor, row in enumerate(rows):
        left = (width - len(row) * (BOX_WIDTH + GAP_X) + GAP_X) / 2
        for i, name in enumerate(row):
            corner[name] = (left + i * (BOX_WIDTH + GAP_X), height - MARGIN - BOX_HEIGHT - floor * (BOX_HEIGHT + GAP_Y))
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" width="{width:g}">',
           f"<style>{STYLE}</style>", '<rect width="100%" height="100%" style="fill:#fff;stroke:none"/>']
    for name in layers:
        x, y = corner[name]
        for other in sorted(under[name]):
            to_x, to_y = corner[other]
            out.append(f'<line x1="{x + BOX_WIDTH / 2:g}" y1="{y + BOX_HEIGHT:g}" '
                       f'x2="{to_x + BOX_WIDTH / 2:g}" y2="{to_y:g}"/>')
    for name in layers:
        x, y = corner[name]
        kind = ' class="offline"' if name in offline else ""
        out.append(f'<rect{kind} x="{x:g}" y="{y:g}" width="{BOX_WIDTH}" height="{BOX_HEIGHT}" rx="4"/>')
        out.append(f'<text x="{x + BOX_WIDTH / 2:g}" y="{y + 20:g}">{name.split("/")[-1]}</text>')
    return "\n".join(out + ["</svg>", ""])


def main():
    if len(sys.argv) != (3 if sys.argv[1:2] == ["--check"] else 2) or sys.argv[1] in ("-h", "--help"):
        print(__doc__)
        return 2
    check = sys.argv[1] == "--check"
    root = pathlib.Path(__file__).resolve().parents[2]
    table = read_layers((root / "src" / "layers.txt").read_text())
    layers = {name: (ours & set(table), theirs) for name, (ours, theirs) in table.items()}  # `shaders` is no layer
    offline = {name for name in layers if not (root / "src" / name).is_dir()}
    made = picture(layers, offline)
    path = pathlib.Path(sys.argv[-1])
    if not check:
        path.write_text(made)
        return 0
    if path.is_file() and path.read_text() == made:
        return 0
    print(f"{path}: not the picture of src/layers.txt; make it anew: python3 tests/lint/draw_layers.py {path}")
    return 1


if __name__ == "__main__":
    sys.exit(main())

"""Draws the tables beside it (figures.json and its CSVs) as SVG and PNG; needs matplotlib.

usage: python3 theory_figures.py [DIR]     DIR is the folder of figures.json, the script's own if not given
"""
import csv
import json
import math
import pathlib
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

plt.rcParams.update({
    "svg.hashsalt": "gnomon",  # the same bytes at every run
    "font.size": 10, "axes.grid": True, "grid.alpha": 0.25, "axes.spines.top": False, "axes.spines.right": False,
})
COLOURS = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#555555", "#000000"]


def numbers(path):
    with open(path, newline="") as file:
        rows = list(csv.reader(file))[1:]
    return [[float(cell) if cell else math.nan for cell in row] for row in rows]


def draw_lines(figure, rows):
    image, axes = plt.subplots(figsize=(7.5, 5))
    x = [row[0] for row in rows]
    many = len(rows) > 60
    for i, label in enumerate(figure["columns"][1:], start=1):
        points = [(a, row[i]) for a, row in zip(x, rows) if not math.isnan(row[i])]
        if not points:
            continue
        dashed = ":" if i > len(COLOURS) else "--" if i > len(COLOURS) // 2 else "-"
        axes.plot(*zip(*points), dashed, marker=None if many else "o", markersize=3,
                  color=COLOURS[(i - 1) % len(COLOURS)], label=label)
    axes.set_xlabel(figure["x"])
    axes.set_ylabel(figure["y"])
    axes.set_xscale("log" if figure["log_x"] else "linear")
    axes.set_yscale("log" if figure["log_y"] else "linear")
    if len(figure["columns"]) <= len(COLOURS) + 1:
        axes.legend(frameon=False, fontsize=8)
    else:
        image.set_figwidth(9.5)
        axes.legend(frameon=False, fontsize=8, loc="upper left", bbox_to_anchor=(1.01, 1))
    return image


def panel_axes(count):
    columns = count if count <= 4 else (count + 1) // 2
    rows = (count + columns - 1) // columns
    image, axes = plt.subplots(rows, columns, figsize=(3.4 * columns + 0.6, 3.5 * rows + 0.6), squeeze=False)
    return image, [axis for line in axes for axis in line]


def draw_curves(figure, rows):
    image, axes = panel_axes(len(figure["panels"]))
    for panel, (axis, title) in enumerate(zip(axes, figure["panels"])):
        curves = {}
        for row in rows:
            if row[0] == panel:
                curves.setdefault(row[1], []).append(row[2:])
        for points in curves.values():
            axis.plot(*zip(*points), color=COLOURS[0], linewidth=0.6)
        axis.set_title(title, fontsize=9)
        axis.set_aspect("equal" if panel < 4 else "auto")
        axis.grid(False)
    return image


def draw_maps(figure, rows):
    image, axes = panel_axes(len(figure["panels"]))
    for panel, (axis, title) in enumerate(zip(axes, figure["panels"])):
        points = [row[1:] for row in rows if row[0] == panel]
        x, y, value = zip(*points)
        drawn = axis.tricontourf(x, y, value, levels=24, cmap="viridis")
        for contour in getattr(drawn, "collections", [drawn]):
            contour.set_edgecolor("face")
        image.colorbar(drawn, ax=axis, shrink=0.8, label=figure["columns"][3])
        axis.set_title(title, fontsize=9)
        axis.set_aspect("equal")
        axis.set_xlabel("behind  -  overhead  -  in front")
        axis.grid(False)
    return image


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__)
    folder = folder if folder.is_dir() else folder.parent
    draw = {"lines": draw_lines, "curves": draw_curves, "maps": draw_maps}
    for figure in json.loads((folder / "figures.json").read_text()):
        image = draw[figure["kind"]](figure, numbers(folder / (figure["name"] + ".csv")))
        image.suptitle(figure["title"], fontsize=12)
        image.tight_layout(rect=(0, 0.11, 1, 0.98))
        width = int(image.get_figwidth() * 14)
        image.text(0.5, 0.015, textwrap.fill(figure["caption"], width), ha="center", va="bottom", fontsize=8)
        for kind, metadata in (("svg", {"Date": None}), ("png", {})):
            image.savefig(folder / f"{figure['name']}.{kind}", dpi=110, metadata=metadata)
        plt.close(image)


if __name__ == "__main__":
    main()

"""Plots what every scheme of shadow maps costs for one view: texels over pixels, against the number of maps.

    python3 storage_factors.py [PICTURE.svg]
"""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import gnomon

# %% A view from near the ground, the light high and to the side
rows = gnomon.schemes(0.1, 100.0, fov_y=60, aspect=1.5, light=(0.4, 1.0, 0.3))

# %% The least factor of each scheme and warp at each number of maps
curves = {}
for row in rows:
    points = curves.setdefault((row["scheme"], row["warp"]), {})
    points[row["maps"]] = min(row["storage_factor"], points.get(row["maps"], float("inf")))

# %% One line each
for (scheme, warp), points in sorted(curves.items()):
    plt.plot(list(points), list(points.values()), marker="o", markersize=3, label=f"{scheme}, {warp}")
plt.xlabel("shadow maps")
plt.ylabel("texels over pixels")
plt.yscale("log")
plt.legend(fontsize="x-small", ncols=2)
plt.savefig(sys.argv[1] if len(sys.argv) > 1 else "storage_factors.svg")

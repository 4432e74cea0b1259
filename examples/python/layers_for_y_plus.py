#!/usr/bin/python3
"""Layers adapted to y+: first heights by the friction of a flat plate, part by part along an aerofoil.

One first height gives a y+ that falls along the wall with the friction. Here each part of the chord has its own.

    layers_for_y_plus.py [--quick] [PICTURE.png]
"""
import sys
from pathlib import Path

import matplotlib
import numpy as np

import winslow

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection

QUICK = "--quick" in sys.argv
PICTURE = next((a for a in sys.argv[1:] if a.endswith(".png")), "layers_for_y_plus.png")
ASSETS = Path(__file__).resolve().parents[2] / "assets"
REYNOLDS, WANTED, COUNT = 2e5, 1.0, 8 if QUICK else 20


def y_plus_of_height_one(x):
    """y+ of a node at the distance 1 from a turbulent flat plate (friction .0592 Re_x^-1/5), at the distance x from
    its leading edge; the chord and the speed are 1."""
    friction = 0.0592 * (REYNOLDS * np.maximum(x, 0.01)) ** -0.2
    return np.sqrt(friction / 2) * REYNOLDS


def y_plus(layered):
    """x and y+ of the first nodes over the wall: the heights are those of the elements in the mesh."""
    edges, quads, points = layered.faces["airfoil"]["line"], layered.cells["quad"], layered.points
    of_edge = {frozenset(edge): None for edge in edges.tolist()}
    for quad in quads.tolist():
        for k in range(4):
            edge = frozenset((quad[k], quad[(k + 1) % 4]))
            if edge in of_edge:
                of_edge[edge] = (quad[k], quad[(k + 1) % 4], quad[(k + 2) % 4], quad[(k + 3) % 4])
    corners = points[np.array(list(of_edge.values()))]
    a, b, c, d = corners.transpose(1, 0, 2)
    along = (b - a) / np.linalg.norm(b - a, axis=1)[:, None]
    over = (c + d) / 2 - (a + b) / 2
    heights = abs(along[:, 0] * over[:, 1] - along[:, 1] * over[:, 0])
    x = (a + b)[:, 0] / 2
    return x, heights * y_plus_of_height_one(x)


mesh = winslow.read(ASSETS / ("coarse/naca0012.su2" if QUICK else "naca0012.su2"))
options = {"count": COUNT, "ratio": 1.15}

# One height for all: that of the trailing edge.
single = winslow.layers(mesh, "airfoil", first=WANTED / y_plus_of_height_one(1.0), **options).mesh

# A height for each part: y+ = 1 at its middle. A part has the edges with both ends in it: cuts are at nodes.
nodes = np.unique(mesh.points[mesh.markers["airfoil"], 0].round(9))
cuts = [-1.0, *(nodes[abs(nodes - x).argmin()] for x in (0.02, 0.06, 0.15, 0.35, 0.65)), 2.0]
walls = []
for left, right in zip(cuts[:-1], cuts[1:]):
    middle = np.clip((max(left, 0) + min(right, 1)) / 2, 0.01, 1)
    walls.append({"markers": "airfoil", "xmin": left - 1e-6, "xmax": right + 1e-6,
                  "first": WANTED / y_plus_of_height_one(middle), **options})
adapted = winslow.layers(mesh, walls=walls).mesh

figure, (plot, picture) = plt.subplots(2, 1, figsize=(8, 8), constrained_layout=True)
spread = {}
for name, layered, style in (("one first height", single, "C0."), ("a height for each part", adapted, "C3.")):
    x, values = y_plus(layered)
    spread[name] = values.max() / values.min()
    print(f"{name}: y+ from {values.min():.2f} to {values.max():.2f}, {layered.node_count} nodes, "
          f"{winslow.quality(layered).inverted} inverted")
    plot.plot(x, values, style, label=name)
assert spread["a height for each part"] < spread["one first height"]
plot.axhline(WANTED, color="k", lw=0.8, label="wanted")
plot.set(xlabel="x along the chord", ylabel="y+ of the first node", ylim=(0, None), title=f"Re = {REYNOLDS:.0e}")
plot.legend(fontsize=8)
for kind in ("triangle", "quad"):
    picture.add_collection(PolyCollection(adapted.points[adapted.cells[kind]], facecolors="none", linewidths=0.3,
                                          edgecolors="C3" if kind == "quad" else "0.4"))
picture.set(xlim=(-0.004, 0.012), ylim=(-0.005, 0.005), aspect="equal", xlabel="x", ylabel="y",
            title="Adapted layers at the leading edge")
figure.savefig(PICTURE, dpi=110)

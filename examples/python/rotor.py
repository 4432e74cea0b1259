#!/usr/bin/python3
"""A rotor turns ten times: the outer circle of the mesh slides, and each turn ends with the mesh of the start.

    rotor.py [--quick] [PICTURE.png]
"""
import sys
import time
from pathlib import Path

import matplotlib
import numpy as np

import winslow

matplotlib.use("Agg")
import matplotlib.pyplot as plt

QUICK = "--quick" in sys.argv
PICTURE = next((a for a in sys.argv[1:] if a.endswith(".png")), "rotor.png")
ASSETS = Path(__file__).resolve().parents[2] / "assets"
TURNS, ANGLE = 10, 30 if QUICK else 10  # degrees a step

mesh = winslow.read(ASSETS / ("coarse/naca0012.su2" if QUICK else "naca0012.su2"))
# The nodes of the far field may go round on their circle, so that the mesh is never wound up.
deformer = winslow.Deformer(mesh, "airfoil", slide="farfield")

begin, distances, shots, solves = time.perf_counter(), [], {}, []
for step in range(1, TURNS * 360 // ANGLE + 1):
    deformer.set_motion(rotate=-step * ANGLE, pivot=(0.25, 0))
    result = deformer.step(1e-6)  # raises an exception if no valid mesh is found
    solves.append(result.linear_solves)
    if step * ANGLE % 360 == 0:
        # The far field has gone round by whole turns, or stayed: the mesh is the one of the start.
        distances.append(abs(deformer.points - mesh.points).max() / np.ptp(mesh.points[mesh.markers["airfoil"], 0]))
    if step * ANGLE in (60, 120, 240, 360, 3600):
        shots[step * ANGLE] = deformer.points
seconds = (time.perf_counter() - begin) / len(solves)
print(f"{mesh.node_count} nodes, {len(solves)} steps, {np.mean(solves):.1f} linear solves and {seconds:.3f} s a step")
print("farthest node from the start, in chords, after each turn:", " ".join(f"{d:.1e}" for d in distances))
assert max(distances) < 1e-3

figure, axes = plt.subplots(2, 3, figsize=(11, 7.5), constrained_layout=True)
for axis, (angle, points) in zip(axes.flat, shots.items()):
    axis.triplot(*points.T, mesh.cells["triangle"], lw=0.35, color="0.45")
    axis.set(xlim=(-0.9, 1.4), ylim=(-1.15, 1.15), aspect="equal", title=f"{angle}°", xticks=[-0.5, 0, 0.5, 1],
             yticks=[-1, -0.5, 0, 0.5, 1])
axes[1, 2].semilogy(range(1, TURNS + 1), np.maximum(distances, 1e-17), "k.-")
axes[1, 2].set(xlabel="turn", ylim=(1e-8, 1), title="Farthest node from\nthe start, in chords")
axes[1, 2].grid(alpha=0.3)
figure.savefig(PICTURE, dpi=110)

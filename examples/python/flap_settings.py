#!/usr/bin/python3
"""A batch of 200 flap settings: which have a good mesh? Writes a table and a map of the quality.

    flap_settings.py [--quick] [PICTURE.png]      the table: PICTURE.csv
"""
import csv
import sys
from pathlib import Path

import matplotlib
import numpy as np

import winslow

matplotlib.use("Agg")
import matplotlib.pyplot as plt

QUICK = "--quick" in sys.argv
PICTURE = Path(next((a for a in sys.argv[1:] if a.endswith(".png")), "flap_settings.png"))
ASSETS = Path(__file__).resolve().parents[2] / "assets"
ANGLES = np.linspace(-25, 13, 4 if QUICK else 20)
SHIFTS = np.linspace(-0.02, 0.07, 3 if QUICK else 10)

mesh = winslow.read(ASSETS / ("coarse/three_element.su2" if QUICK else "three_element.su2"))
main, flap = mesh.markers["main"], mesh.markers["flap"]


def row(step):
    """What the table says of one setting."""
    body, values = step.bodies[0], {}
    if step.mesh is not None:
        points = step.mesh.points
        gap = np.sqrt(((points[main][:, None] - points[flap][None])**2).sum(axis=2)).min()
        quality = winslow.quality(step.mesh, worst=0)
        values = {"gap": round(float(gap), 6), "worst_jacobian": round(quality.min("normalized_jacobian"), 4),
                  "mean_jacobian": round(quality.mean("normalized_jacobian"), 4), "inverted": quality.inverted}
    return {"angle": round(float(body["rotate"]), 3), "shift": round(float(body["translate"][0]), 5),
            "status": step.status, **values}


# Each motion begins from the mesh of its nearest neighbour. Meshes are measured as they come, and not kept.
rows = []
winslow.sweep(mesh, "flap", rotate=ANGLES, translate=[(shift, 0) for shift in SHIFTS], pivot=(0.86, -0.02), jobs=2,
              keep=False, on_step=lambda step: rows.append(row(step)))
rows.sort(key=lambda r: (r["shift"], r["angle"]))
names = ["angle", "shift", "status", "gap", "worst_jacobian", "mean_jacobian", "inverted"]
with open(PICTURE.with_suffix(".csv"), "w", newline="", encoding="utf-8") as file:
    table = csv.DictWriter(file, names, restval="")
    table.writeheader()
    table.writerows(rows)
done = [r for r in rows if r["status"] == "done"]
print(f"{len(rows)} settings, {len(done)} meshes without an inverted element, in {PICTURE.with_suffix('.csv')}")
assert len(rows) == len(ANGLES) * len(SHIFTS) and len(done) > 0.6 * len(rows)

figure, axes = plt.subplots(2, 1, figsize=(8, 8), constrained_layout=True, height_ratios=[1, 1.2])
worst = np.array([r.get("worst_jacobian", np.nan) for r in rows], dtype=float).reshape(len(SHIFTS), len(ANGLES))
colours = axes[0].pcolormesh(ANGLES, SHIFTS, worst, shading="nearest", cmap="viridis", vmin=0)
figure.colorbar(colours, ax=axes[0], label="worst normalized Jacobian")
axes[0].set(xlabel="angle of the flap (degrees)", ylabel="shift (chords)",
            title="Worst element of each mesh (white: no mesh)")
best = max(done, key=lambda r: (r["angle"] < -10, r["worst_jacobian"]))
moved = winslow.move(mesh, "flap", rotate=best["angle"], translate=(best["shift"], 0), pivot=(0.86, -0.02)).mesh
axes[1].triplot(*moved.points.T, mesh.cells["triangle"], lw=0.3, color="0.4")
axes[1].set(xlim=(0.75, 1.2), ylim=(-0.25, 0.1), aspect="equal", xlabel="x", ylabel="y",
            title=f"The best mesh beyond -10°: {best['angle']:.0f}°, shift {best['shift']:.3f}")
figure.savefig(PICTURE, dpi=110)

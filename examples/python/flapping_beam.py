#!/usr/bin/python3
"""A beam flaps in a channel: two-way coupling with repeated steps, without a flow solver.

The beam is the ellipse behind the cylinder of quads.su2, clamped at its upstream end: Euler and Bernoulli, by finite
differences along its axis. The flow is a sketch: the gaps above and below, measured on the mesh, give the pressures of
Bernoulli's equation. Each time step is repeated until beam and mesh agree; the deformer goes back to its checkpoint.

    flapping_beam.py [--quick] [PICTURE.png]
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
PICTURE = next((a for a in sys.argv[1:] if a.endswith(".png")), "flapping_beam.png")
ASSETS = Path(__file__).resolve().parents[2] / "assets"
STEPS, DT, SPEED = (60 if QUICK else 120), 0.1, 1.0

mesh = winslow.read(ASSETS / ("coarse/quads.su2" if QUICK else "quads.su2"))
deformer = winslow.Deformer(mesh, "ellipse")
start = mesh.points[deformer.nodes]

# The axis of the ellipse: along it s from 0 (clamped) to 1, and across it.
centre = start.mean(axis=0)
along = np.linalg.eigh(np.cov((start - centre).T))[1][:, 1]
along *= np.sign(along[0])
across, reach = np.array([-along[1], along[0]]), (start - centre) @ along
length = np.ptp(reach)
s = (reach - reach.min()) / length

# The beam: mass w'' + damping w' + stiffness d4w/ds4 = load, clamped at s = 0, free at s = 1.
N = 21
ds = 1 / (N - 1)
grid = np.linspace(0, 1, N)
D2 = (np.eye(N + 1, N + 3, 0) - 2 * np.eye(N + 1, N + 3, 1) + np.eye(N + 1, N + 3, 2)) / ds**2  # with two ghosts
moments = D2[:N].copy()
moments[-1] = 0  # no moment at the free end
fold = np.zeros((N + 3, N))  # w and its ghosts from w: w(-ds) = w(ds) at the clamp
fold[0, 1], fold[1:N + 1] = 1, np.eye(N)
bending = np.zeros((N, N))
curvature = moments @ fold
bending[1:-1] = (curvature[:-2] - 2 * curvature[1:-1] + curvature[2:]) / ds**2
bending[-1] = 2 * (curvature[-2] - curvature[-1]) / ds**2  # no shear at the free end
mass, damping, stiffness = 1.0, 0.25, 0.4


def loads(points, time):
    """Force across the beam for each point of the grid, from the gaps on the mesh and a gust."""
    wall = points[deformer.nodes]
    upper, lower = wall[(wall - centre) @ across > 0], wall[(wall - centre) @ across < 0]
    x = (centre + (grid[:, None] - 0.5) * length * along)[:, 0]
    top = np.interp(x, *upper[np.argsort(upper[:, 0])].T)
    bottom = np.interp(x, *lower[np.argsort(lower[:, 0])].T)
    above, below = 1.5 - top, bottom + 1.5
    faster = 0.05 * SPEED**2 * ((1.5 / above)**2 - (1.5 / below)**2)
    return faster + 0.3 * np.sin(1.7 * time)


def advance(w, v, load):
    """One implicit step of the beam (trapezoidal rule); row 0 is clamped."""
    A = np.diag(np.full(N, mass + damping * DT / 2)) + stiffness * DT**2 / 4 * bending
    rhs = (mass - damping * DT / 2) * v - DT * stiffness * bending @ (w + DT / 4 * v) + DT * load
    A[0], rhs[0] = np.eye(N)[0], 0
    new = np.linalg.solve(A, rhs)
    return w + DT / 2 * (v + new), new


def places(w):
    """Where the nodes of the ellipse are: each moves across the axis with the beam."""
    return start + np.interp(s, grid, w)[:, None] * across


w, v, tips, repeats, shots, solves = np.zeros(N), np.zeros(N), [], [], [], []
for step in range(STEPS):
    checkpoint, guess = deformer.checkpoint(), deformer.points
    for repeat in range(1, 21):
        trial = advance(w, v, loads(guess, (step + 0.5) * DT))
        deformer.restore(checkpoint)
        deformer.set_boundary(places(trial[0]))
        result = deformer.step(1e-6)
        change = abs(deformer.points - guess).max()
        guess = deformer.points
        if change < 1e-7:
            break
    w, v = trial
    tips.append(w[-1])
    repeats.append(repeat)
    solves.append(result.linear_solves)
    shots.append(guess)
print(f"{mesh.node_count} nodes, {STEPS} steps, {np.mean(repeats):.1f} repeats and {np.mean(solves):.1f} linear solves "
      f"each; tip from {min(tips):.3f} to {max(tips):.3f}")
assert winslow.quality(deformer.mesh).inverted == 0 and max(repeats) < 20 and np.ptp(tips) > 0.02

figure = plt.figure(figsize=(10, 8.5), constrained_layout=True)
axes = figure.subplot_mosaic([["high", "low"], ["tip", "tip"]], height_ratios=[2, 1.2])
for name, step in (("high", int(np.argmax(tips))), ("low", int(np.argmin(tips)))):
    quads = PolyCollection(shots[step][mesh.cells["quad"]], facecolors="white", edgecolors="0.4", linewidths=0.4)
    axes[name].add_collection(quads)
    axes[name].set(xlim=(-2.05, 2.05), ylim=(-1.55, 1.55), aspect="equal", xlabel="x", ylabel="y",
                   title=f"Tip {name}est, t = {(step + 1) * DT:.2f}")
axes["tip"].plot(DT * np.arange(1, STEPS + 1), tips, "C3")
axes["tip"].set(xlabel="time", ylabel="deflection of the tip", title="Beam")
axes["tip"].grid(alpha=0.3)
figure.savefig(PICTURE, dpi=110)

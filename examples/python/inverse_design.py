#!/usr/bin/python3
"""Inverse design: finds the aerofoil that has a wanted pressure, by gradients through the mesh.

A panel method says the pressure of the wanted aerofoil, NACA 0018. Starting from NACA 0012, scipy changes eight
bumps of the thickness. The flow is the stream function by finite elements on the mesh. The gradient is by the
adjoint: dJ/dX by all nodes of the mesh, and the transposed product of the mesh takes it to the surface.

    inverse_design.py [--quick] [PICTURE.png]
"""
import inspect
import sys
import time
from pathlib import Path

import matplotlib
import numpy as np
from scipy.optimize import minimize
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import LinearOperator, cg, splu

import winslow

matplotlib.use("Agg")
import matplotlib.pyplot as plt

QUICK = "--quick" in sys.argv
PICTURE = next((a for a in sys.argv[1:] if a.endswith(".png")), "inverse_design.png")
ASSETS = Path(__file__).resolve().parents[2] / "assets"


def half_thickness(x, t=0.12):
    """Of a NACA aerofoil with a closed trailing edge."""
    x = np.clip(x, 0, 1)
    return 5 * t * (0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4)


def panel_speeds(z):
    """Speeds at the middles of source panels between the points z = x + iy of a closed body, anticlockwise."""
    ends = np.roll(z, -1)
    middles, turn = (z + ends) / 2, (ends - z) / abs(ends - z)
    with np.errstate(divide="ignore"):
        induced = np.log((middles[:, None] - z) / (middles[:, None] - ends)) / (2 * np.pi * turn)  # u - iv
    induced *= turn[:, None]  # along the panel, and the other way round across it
    np.fill_diagonal(induced, 0.5j)  # outside, which is on the right
    sources = np.linalg.solve(induced.imag, -turn.imag)
    return middles, abs(turn.real + induced.real @ sources)


def fine_mesh():
    """NACA 0012 with each triangle cut into four: 19k nodes."""
    mesh = winslow.read(ASSETS / ("coarse/naca0012.su2" if QUICK else "naca0012.su2"))
    cells, n = mesh.cells["triangle"], mesh.node_count
    edges, middle = np.unique(np.sort(cells[:, [[0, 1], [1, 2], [2, 0]]]).reshape(-1, 2), axis=0, return_inverse=True)
    (a, b, c), (ab, bc, ca) = cells.T, n + middle.reshape(-1, 3).T
    points = np.vstack([mesh.points, mesh.points[edges].mean(axis=1)])
    halves = {tuple(edge): n + k for k, edge in enumerate(edges.tolist())}
    faces = {name: np.array([pair for i, j in f["line"].tolist() for m in [halves[min(i, j), max(i, j)]]
                             for pair in ((i, m), (m, j))]) for name, f in mesh.faces.items()}
    wall = np.unique(faces["airfoil"])
    points[wall, 1] = np.sign(points[wall, 1]) * half_thickness(points[wall, 0])
    triangles = np.vstack([np.transpose(t) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return winslow.untangle(winslow.Mesh(points, {"triangle": triangles}, faces))


mesh = fine_mesh()
deformer = winslow.Deformer(mesh, "airfoil")
triangles = mesh.cells["triangle"]
outer, wall = mesh.markers["farfield"], mesh.markers["airfoil"]
start = mesh.points[wall]
free = np.setdiff1d(np.arange(mesh.node_count), np.union1d(outer, wall))
# The triangles with an edge on the wall, and the wanted speed there.
at_wall = np.flatnonzero(np.isin(triangles, wall).sum(axis=1) == 2)
order = np.argsort(np.arctan2(start[:, 1] + 1e-12, start[:, 0] - 0.5))
loop = start[order] * [1, 1.5]  # NACA 0018
middles, speeds = panel_speeds(loop[:, 0] + 1j * loop[:, 1])
upper = middles.imag > 0


def wall_x(x):
    """Where the middles of the edges on the wall are, along the chord."""
    on_wall = np.isin(triangles[at_wall], wall)
    return (x[triangles[at_wall], 0] * on_wall).sum(axis=1) / 2


wanted = np.interp(wall_x(mesh.points), middles[upper].real[::-1], speeds[upper][::-1])
factors = []
used = (wall_x(mesh.points) > 0.02) & (wall_x(mesh.points) < 0.97)


def solve(matrix, rhs):
    """By conjugate gradients, with the factors of the first matrix as a preconditioner."""
    if not factors:
        factors.append(splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0,
                            options={"SymmetricMode": True}))
    tolerance = "rtol" if "rtol" in inspect.signature(cg).parameters else "tol"  # by the version of scipy
    out, failed = cg(matrix, rhs, M=LinearOperator(matrix.shape, factors[0].solve), **{tolerance: 1e-10})
    assert not failed
    return out


def objective(x):
    """J, the mean square of the fault of the squared speed at the wall, and dJ/dX."""
    (p, q, r), nodes = x[triangles].transpose(1, 0, 2), len(x)
    area = 0.5 * ((q - p)[:, 0] * (r - p)[:, 1] - (q - p)[:, 1] * (r - p)[:, 0])
    across = np.stack([q - r, r - p, p - q], axis=1) / (2 * area)[:, None, None]
    grad = np.stack([across[..., 1], -across[..., 0]], axis=2)  # of the three shape functions
    values = area[:, None, None] * (grad @ grad.transpose(0, 2, 1))
    rows, columns = np.repeat(triangles, 3, axis=1).ravel(), np.tile(triangles, 3).ravel()
    matrix = coo_matrix((values.ravel(), (rows, columns)), (nodes, nodes)).tocsr()
    psi = np.zeros(nodes)
    psi[outer] = x[outer, 1]
    psi[free] = solve(matrix[free][:, free], -(matrix[free] @ psi))
    slope = (psi[triangles][:, None] @ grad)[:, 0]
    fault = np.where(used, (slope[at_wall]**2).sum(axis=1) - wanted**2, 0) / used.sum()
    J = 0.5 * used.sum() * fault @ fault
    # The adjoint: K lambda = -dJ/dpsi, then dJ/dX = explicit part + d(lambda K psi)/dX.
    by_psi, lam = np.zeros(nodes), np.zeros(nodes)
    near = (grad[at_wall] @ slope[at_wall][:, :, None])[..., 0]
    np.add.at(by_psi, triangles[at_wall], 2 * fault[:, None] * near)
    lam[free] = solve(matrix[free][:, free], -by_psi[free])
    adjoint = (lam[triangles][:, None] @ grad)[:, 0]
    by_node = area[:, None, None] * ((adjoint * slope).sum(axis=1)[:, None, None] * grad
                                     - (grad @ adjoint[:, :, None]) * slope[:, None]
                                     - (grad @ slope[:, :, None]) * adjoint[:, None])
    by_node[at_wall] -= 2 * fault[:, None, None] * near[..., None] * slope[at_wall][:, None]
    dJ_dX = np.stack([np.bincount(triangles.ravel(), by_node[..., k].ravel(), nodes) for k in (0, 1)], axis=1)
    # The outer value of psi is y, which does not move.
    return J, dJ_dX, np.sqrt((slope[at_wall]**2).sum(axis=1))


# Thickness is added by bumps (R. M. Hicks and P. A. Henne, J. Aircraft 15(7), 1978), the first like a NACA thickness.
peaks = np.linspace(0.1, 0.85, 7)
x0 = np.clip(start[:, 0], 1e-12, 1)
bumps = np.array([half_thickness(x0, 1)] + [np.sin(np.pi * x0**(np.log(0.5) / np.log(p)))**3 for p in peaks])
bumps[:, x0 >= 1 - 1e-9] = 0
shapes = 0.02 * bumps * np.sign(start[:, 1])
history, worst = [], []


def by_shape(a):
    """J and its derivative by the bumps."""
    deformer.set_boundary(start + np.stack([0 * x0, a @ shapes], axis=1))
    result = deformer.step(1e-6)  # raises an exception if no valid mesh has this boundary
    J, dJ_dX, _ = objective(result.mesh.points)
    on_wall = deformer.sensitivity().transpose(dJ_dX)[wall]
    history.append(J)
    return J, shapes @ on_wall[:, 1]


if __name__ == "__main__":
    begin, zero = time.perf_counter(), np.zeros(len(shapes))
    _, gradient = by_shape(zero)
    step = 1e-5 * np.eye(len(shapes))[3]
    difference = (by_shape(step)[0] - by_shape(-step)[0]) / 2e-5
    print(f"gradient by the adjoint {gradient[3]:.8g}, by differences {difference:.8g}")
    history.clear()
    first = objective(mesh.points)[2]
    begin = time.perf_counter()
    found = minimize(by_shape, zero, jac=True, method="L-BFGS-B",
                     bounds=[(-0.5, 5)] + [(-0.5, 0.5)] * (len(shapes) - 1),
                     options={"maxfun": 8 if QUICK else 50, "maxiter": 50, "ftol": 0, "gtol": 0})
    print(f"{mesh.node_count} nodes, {len(history)} shapes in {time.perf_counter() - begin:.1f} s; "
          f"J from {history[0]:.3g} to {min(history):.3g}")
    deformer.set_boundary(start + np.stack([0 * x0, found.x @ shapes], axis=1))
    last = deformer.step().mesh
    assert abs(gradient[3] / difference - 1) < 1e-4 and min(history) < (0.3 if QUICK else 0.15) * history[0]

    figure, (shape, pressure, drop) = plt.subplots(3, 1, figsize=(8, 11), constrained_layout=True)
    shape.triplot(*last.points.T, triangles, lw=0.2, color="0.6")
    loops = {"NACA 0012, the start": start[order], "found": last.points[wall][order], "NACA 0018, wanted": loop}
    for (name, xy), style in zip(loops.items(), ("C0-", "C3-", "k--")):
        shape.plot(*np.vstack([xy, xy[:1]]).T, style, lw=1.2, label=name)
    shape.set(xlim=(-0.1, 1.1), ylim=(-0.25, 0.25), aspect="equal", title="Mesh and aerofoils", xlabel="x", ylabel="y")
    x, sort = wall_x(mesh.points), np.argsort(wall_x(mesh.points))
    for speed, style, name in ((first, "C0.", "start"), (objective(last.points)[2], "C3.", "found")):
        pressure.plot(x[sort], 1 - speed[sort]**2, style, ms=3, label=name)
    pressure.plot(middles[upper].real, 1 - speeds[upper]**2, "k-", lw=0.8, label="wanted, by panels")
    pressure.set(xlabel="x", ylabel="pressure coefficient", ylim=(1.1, -0.8), title="Pressure at the wall")
    drop.semilogy(range(1, len(history) + 1), history, "k.-")
    drop.set(xlabel="shape", ylabel="J", title="Objective")
    for axes in (shape, pressure):
        axes.legend(loc="lower right", fontsize=8)
    figure.savefig(PICTURE, dpi=110)

#!/usr/bin/python3
"""A grid of pyvista is moved and goes back, with its arrays.

pyvista is no package of Debian 12. Where it cannot be imported, a stand-in with the same arrays in the layout of VTK
takes its place, read from the same file by winslow: everything below the reading is the same.

    from_pyvista.py [--quick] [PICTURE.png]
"""
import sys
import tempfile
from pathlib import Path
from types import SimpleNamespace

import matplotlib
import numpy as np

import winslow

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection

QUICK = "--quick" in sys.argv
PICTURE = next((a for a in sys.argv[1:] if a.endswith(".png")), "from_pyvista.png")
ASSETS = Path(__file__).resolve().parents[2] / "assets"


def read_grid(path):
    """The grid of a VTK file: by pyvista, or by a stand-in."""
    try:
        import pyvista
    except ImportError:
        pass
    else:
        return pyvista.read(path)
    mesh = winslow.read(path)
    blocks = [(9, mesh.cells["quad"], 0)] + [(3, faces["line"], k + 1) for k, faces in enumerate(mesh.faces.values())]
    return SimpleNamespace(
        points=np.column_stack([mesh.points, np.zeros(mesh.node_count)]),
        cells=np.concatenate([np.column_stack([np.full(len(c), c.shape[1]), c]).ravel() for _, c, _ in blocks]),
        celltypes=np.concatenate([np.full(len(c), kind, np.uint8) for kind, c, _ in blocks]),
        point_data={}, cell_data={"marker": np.concatenate([np.full(len(c), tag) for _, c, tag in blocks])},
        field_data={f"marker:{name}": np.array([k + 1]) for k, name in enumerate(mesh.faces)})


# A grid as some other program has left it: quadrilaterals, edges with the array "marker", and a field.
folder = tempfile.TemporaryDirectory()
path = Path(folder.name) / "grid.vtk"
winslow.convert(ASSETS / ("coarse/quads.su2" if QUICK else "quads.su2"), path)
grid = read_grid(path)
grid.point_data["temperature"] = np.exp(-np.linalg.norm(grid.points, axis=1))

# Functions take the grid as it is.
result = winslow.move(grid, "ellipse", rotate=60, translate=(0.1, 0.3))
back = result.mesh.to_pyvista() if not isinstance(grid, SimpleNamespace) else None
mesh = winslow.from_pyvista(grid)
print(mesh)
print(result)
assert set(mesh.markers) == {"outer", "circle", "ellipse"} and result.complete
assert np.array_equal(mesh.points, np.asarray(grid.points)[:, :mesh.dimension])
if back is not None:
    assert np.array_equal(back.point_data["temperature"], grid.point_data["temperature"])

figure, axes = plt.subplots(1, 2, figsize=(11, 4.6), constrained_layout=True)
panels = ((axes[0], mesh.points, "The grid"), (axes[1], result.mesh.points, "The ellipse turned by 60°"))
for axis, points, title in panels:
    cells = PolyCollection(points[mesh.cells["quad"]][..., :2], cmap="inferno", edgecolors="white", linewidths=0.3,
                           array=np.asarray(grid.point_data["temperature"])[mesh.cells["quad"]].mean(axis=1))
    axis.add_collection(cells)
    axis.set(xlim=(-2.05, 2.05), ylim=(-1.55, 1.55), aspect="equal", title=title, xlabel="x", ylabel="y")
figure.colorbar(cells, ax=axes, shrink=0.74, label="temperature, an array of the grid")
figure.savefig(PICTURE, dpi=110)

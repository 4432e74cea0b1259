"""Volume meshes read and judged without the program: nodes, markers, and where the Jacobian of an element is not
positive."""
import contextlib
from collections import namedtuple
from functools import lru_cache

import meshio
import numpy as np

# points: #nodes by 3. cells: (number of nodes -> (numbers of the elements, their nodes)). markers:
# name -> set of faces, each the set of its nodes.
Volume = namedtuple("Volume", "points cells markers")

CORNERS = {10: 4, 14: 5, 13: 6, 12: 8}
NODES = {"tetra": 4, "pyramid": 5, "wedge": 6, "hexahedron": 8}


def read_volume(path):
    return read_su2(path) if path.suffix == ".su2" else read_msh(path)


def by_size(rows):
    """Lists of nodes of the same length together, with their places in the whole list."""
    groups = {}
    for k, row in enumerate(rows):
        groups.setdefault(len(row), ([], []))
        groups[len(row)][0].append(k)
        groups[len(row)][1].append(row)
    return {n: (np.array(places), np.array(nodes)) for n, (places, nodes) in groups.items()}


def read_su2(path):
    lines = iter(path.read_text().splitlines())
    points, cells, markers = None, None, {}
    for line in lines:
        key, _, value = line.partition("=")
        if key == "NPOIN":
            points = np.array([next(lines).split()[:3] for _ in range(int(value.split()[0]))], float)
        elif key == "NELEM":
            rows = (list(map(int, next(lines).split())) for _ in range(int(value)))
            cells = by_size([row[1:1 + CORNERS[row[0]]] for row in rows])
        elif key == "MARKER_TAG":
            count = int(next(lines).split("=")[1])
            markers[value.strip()] = {frozenset(map(int, next(lines).split()[1:])) for _ in range(count)}
    return Volume(points, cells, markers)


def read_msh(path):
    with contextlib.redirect_stdout(None):  # it prints empty lines
        mesh = meshio.read(path)
    names = {tag: name for name, (tag, dimension) in mesh.field_data.items() if dimension == 2}
    rows, markers = [], {name: set() for name in names.values()}
    for block, physical in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
        if block.type in NODES:
            rows += block.data.tolist()
        elif block.type in ("triangle", "quad"):
            for face, tag in zip(block.data.tolist(), physical):
                markers[names[tag]].add(frozenset(face))
    return Volume(mesh.points, by_size(rows), markers)


def marker_nodes(volume, names):
    return sorted({node for name in names for face in volume.markers[name] for node in face})


def same_elements(one, other):
    return one.cells.keys() == other.cells.keys() and all(
        np.array_equal(a, b) for n in one.cells for a, b in zip(one.cells[n], other.cells[n]))


def shape_gradients(corners, r, s, t):
    """Of the shape functions of an element with so many nodes, at a point: #nodes by 3. Orders of nodes as in
    VTK; a pyramid's are those of a hexahedron whose upper face is a point."""
    if corners == 4:
        return np.array([(-1, -1, -1), (1, 0, 0), (0, 1, 0), (0, 0, 1)], float)
    if corners == 6:
        plane = np.array([(1 - r - s, -1, -1), (r, 1, 0), (s, 0, 1)])
        value, along = plane[:, :1], plane[:, 1:]
        return np.vstack([np.hstack([along * (1 - t), -value]), np.hstack([along * t, value])])
    signs = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
    factor = np.where(signs == 1, (r, s, t), (1 - r, 1 - s, 1 - t))
    slope = np.where(signs == 1, 1.0, -1.0)
    gradients = np.stack([slope[:, k] * np.prod(np.delete(factor, k, 1), 1) for k in range(3)], 1)
    if corners == 8:
        return gradients
    return np.vstack([gradients[:4], gradients[4:].sum(0)])


@lru_cache
def sample_gradients(corners, steps=5):
    """At a grid of points all over the element, its corners among them, but for the apex of a pyramid, where the
    Jacobian is zero in any."""
    at = np.linspace(0, 1, steps)
    places = [(r, s, t) for r in at for s in at for t in at]
    if corners == 4:
        places = places[:1]
    if corners == 5:
        places = [p for p in places if p[2] < 1]
    if corners == 6:
        places = [p for p in places if p[0] + p[1] <= 1]
    return np.array([shape_gradients(corners, *p) for p in places])


def smallest_jacobians(points, nodes):
    """#elements: the smallest Jacobian of each at the sampled points, and the largest."""
    gradients = sample_gradients(nodes.shape[1])
    jacobian = np.linalg.det(np.einsum("enx,pnr->epxr", points[nodes], gradients))
    return jacobian.min(1), jacobian.max(1)


def count_inverted(given, points):
    """Elements whose Jacobian is not everywhere of the sign that it has in the mesh as given, but for those whose
    nodes all lie on the boundary and which no smoothing can help."""
    boundary = np.zeros(len(points), bool)
    boundary[marker_nodes(given, given.markers)] = True
    inverted = 0
    for _, nodes in given.cells.values():
        low, high = smallest_jacobians(given.points, nodes)
        sign = np.where(low + high > 0, 1, -1)
        low, high = smallest_jacobians(points, nodes)
        bad = np.where(sign > 0, low, -high) <= 0
        inverted += int(np.count_nonzero(bad & ~boundary[nodes].all(1)))
    return inverted


def rotated(points, degrees, axis, pivot):
    """Rodrigues' formula."""
    axis = np.asarray(axis) / np.linalg.norm(axis)
    v, a = points - pivot, np.radians(degrees)
    return pivot + v * np.cos(a) + np.cross(axis, v) * np.sin(a) + np.outer(v @ axis, axis) * (1 - np.cos(a))

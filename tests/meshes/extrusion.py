"""Volume meshes from a plane mesh, cell by cell: prisms and hexahedra with bodies left out, and pyramids and
tetrahedra where cells are split about their centres."""
import itertools
from collections import namedtuple

import numpy as np

# points: #nodes by 3. cells: lists of nodes: prisms are two triangles and hexahedra two
# quadrilaterals, counter-clockwise seen from above, of which the second lies over the first; the last node of a
# pyramid or tetrahedron lies over the others. markers: name -> faces.
VolumeMesh = namedtuple("VolumeMesh", "points cells markers")

SU2_CELL = {4: 10, 5: 14, 6: 13, 8: 12}
SU2_FACE = {3: 5, 4: 9}
FACES = {6: [(0, 1, 2), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)],
         8: [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}


def read_base(path):
    """Points, and (region, nodes) of the triangles and quadrilaterals, of an MSH 2.2 file whose physical
    surfaces are the regions 1, 2, ..."""
    lines = iter(path.read_text().splitlines())
    ids, points, cells = {}, [], []
    for line in lines:
        if line == "$Nodes":
            for k in range(int(next(lines))):
                tag, x, y, _ = next(lines).split()
                ids[int(tag)] = k
                points.append((float(x), float(y)))
        elif line == "$Elements":
            for _ in range(int(next(lines))):
                kind, tags, region, *rest = map(int, next(lines).split()[1:])
                if kind in (2, 3):
                    cells.append((region, [ids[i] for i in rest[tags - 1:]]))
    return np.array(points), [(region, counter_clockwise(points, nodes)) for region, nodes in cells]


def counter_clockwise(points, nodes):
    x, y = np.array([points[n] for n in nodes]).T
    area = np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))
    return nodes if area > 0 else nodes[::-1]


def levels(height, spans, step):
    """Heights of the layers: at most about `step` apart, among them all ends of the spans, and three layers or
    more between two of these."""
    ends = sorted({0.0, height, *(float(z) for span in spans for z in span)})
    z = [0.0]
    for low, high in itertools.pairwise(ends):
        z += list(np.linspace(low, high, max(3, round((high - low) / step)) + 1)[1:])
    return np.array(z)


def extruded(base, height, spans, step):
    """The plane mesh in a file, extruded from z = 0 to `height`; over region k + 2 the cells within spans[k]
    are left out: the body `body{k + 1}`."""
    plane, cells = read_base(base)
    z = levels(height, spans, step)
    n = len(plane)
    kept, removed = [], []
    for layer, (low, high) in enumerate(itertools.pairwise(z)):
        middle = (low + high) / 2
        for region, nodes in cells:
            cell = [i + layer * n for i in nodes] + [i + (layer + 1) * n for i in nodes]
            body = region - 2
            inside = body >= 0 and spans[body][0] < middle < spans[body][1]
            (removed if inside else kept).append((body, cell))
    points = np.column_stack([np.tile(plane, (len(z), 1)), np.repeat(z, n)])
    return without_unused(points, [c for _, c in kept], markers_of(kept, removed, points, height))


def markers_of(kept, removed, points, height):
    bodies = {frozenset(face): body for body, cell in removed for face in faces_of(cell)}
    found = {}
    for _, cell in kept:
        for face in faces_of(cell):
            found.setdefault(frozenset(face), []).append(face)
    markers = {}
    for key, faces in found.items():
        if len(faces) == 1:
            z = points[list(key), 2]
            name = (f"body{bodies[key] + 1}" if key in bodies else "floor" if np.all(z == 0)
                    else "ceiling" if np.all(z == height) else "side")
            markers.setdefault(name, []).append(faces[0])
    return markers


def faces_of(cell):
    return [[cell[k] for k in face] for face in FACES[len(cell)]]


def without_unused(points, cells, markers):
    used = np.zeros(len(points), bool)
    for cell in cells:
        used[cell] = True
    new = np.cumsum(used) - 1
    number = lambda lists: [[int(new[i]) for i in one] for one in lists]
    return VolumeMesh(points[used], number(cells), {name: number(f) for name, f in markers.items()})


def split_about_centres(mesh, rng):
    """Splits the cells within a random ball about their centres, into a pyramid or a tetrahedron for each
    face."""
    points = list(mesh.points)
    centres = np.array([mesh.points[c].mean(0) for c in mesh.cells])
    middle = centres[rng.integers(len(centres))]
    distance = np.linalg.norm(centres - middle, axis=1)
    chosen = distance <= np.quantile(distance, rng.uniform(0.02, 0.15))
    cells = []
    for cell, split in zip(mesh.cells, chosen):
        if not split:
            cells.append(cell)
            continue
        points.append(mesh.points[cell].mean(0))
        cells += [outward_to(points, face, len(points) - 1) for face in faces_of(cell)]
    return VolumeMesh(np.array(points), cells, mesh.markers)


def outward_to(points, face, apex):
    """A pyramid or tetrahedron over a face, whose nodes are then counter-clockwise seen from the apex."""
    a, b, c = (points[i] for i in face[:3])
    up = np.dot(np.cross(b - a, c - a), points[apex] - a) > 0
    return [*(face if up else face[::-1]), apex]


def in_su2(cell):
    """The first triangle of a prism of SU2 is counter-clockwise seen from outside."""
    return [cell[k] for k in (0, 2, 1, 3, 5, 4)] if len(cell) == 6 else cell


def write_su2(path, mesh):
    lines = ["NDIME= 3", f"NELEM= {len(mesh.cells)}"]
    lines += [f"{SU2_CELL[len(c)]} {' '.join(map(str, in_su2(c)))} {k}" for k, c in enumerate(mesh.cells)]
    lines.append(f"NPOIN= {len(mesh.points)}")
    lines += [f"{x:.17g} {y:.17g} {z:.17g} {k}" for k, (x, y, z) in enumerate(mesh.points)]
    lines.append(f"NMARK= {len(mesh.markers)}")
    for name, faces in mesh.markers.items():
        lines += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(faces)}"]
        lines += [f"{SU2_FACE[len(f)]} {' '.join(map(str, f))}" for f in faces]
    path.write_text("\n".join(lines) + "\n")

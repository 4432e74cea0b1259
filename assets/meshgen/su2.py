"""Reads and writes SU2 mesh files."""
from collections import namedtuple

import numpy as np

KIND = {3: 5, 4: 9}
VOLUME_KIND = {4: 10, 6: 13}  # by the number of corners: tetrahedra, prisms

# points: #nodes by 3; cells: tuples of nodes; markers: name -> tuples of nodes
VolumeMesh = namedtuple("VolumeMesh", "points cells markers")


def write_su2(path, xyz, elements, marks):
    out = ["NDIME= 2", f"NELEM= {len(elements)}"]
    out += [f"{KIND[len(e)]} {' '.join(map(str, e))} {k}" for k, e in enumerate(elements)]
    out.append(f"NPOIN= {len(xyz)}")
    out += [f"{x:.17g} {y:.17g} {k}" for k, (x, y) in enumerate(xyz)]
    out.append(f"NMARK= {len(marks)}")
    for name, edges in marks.items():
        out += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(edges)}"]
        out += [f"3 {a} {b}" for a, b in edges]
    path.write_text("\n".join(out) + "\n")


def read_volume(text):
    """The mesh in the text of a file as Gmsh writes it: elements end in their numbers."""
    lines = iter(text.splitlines())
    points, cells, markers = [], [], {}
    for line in lines:
        key, _, value = (part.strip() for part in line.partition("="))
        if key == "NELEM":
            cells = [tuple(map(int, next(lines).split()[1:-1])) for _ in range(int(value))]
        elif key == "NPOIN":
            points = [list(map(float, next(lines).split()[:3])) for _ in range(int(value.split()[0]))]
        elif key == "MARKER_TAG":
            count = int(next(lines).partition("=")[2])
            markers[value] = [tuple(map(int, next(lines).split()[1:4])) for _ in range(count)]
    return VolumeMesh(np.array(points), cells, markers)


def volume_text(mesh):
    """A mesh of tetrahedra and prisms, with triangles as markers, as the text of an SU2 file."""
    out = ["NDIME= 3", f"NELEM= {len(mesh.cells)}"]
    out += [f"{VOLUME_KIND[len(c)]} {' '.join(map(str, c))} {k}" for k, c in enumerate(mesh.cells)]
    out.append(f"NPOIN= {len(mesh.points)}")
    out += [f"{x:.17g} {y:.17g} {z:.17g} {k}" for k, (x, y, z) in enumerate(mesh.points)]
    out.append(f"NMARK= {len(mesh.markers)}")
    for name, faces in mesh.markers.items():
        out += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(faces)}"]
        out += [f"5 {' '.join(map(str, f))}" for f in faces]
    return "\n".join(out) + "\n"

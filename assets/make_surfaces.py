#!/usr/bin/env python3
"""Makes the surface meshes that docs/surfaces.md measures: python3 make_surfaces.py FOLDER [NAME ...]
(needs numpy and gmsh 4.8)

NAME is sphere, cylinder, torus, bumpy, saddle, part, quads or scan; without a name all are made, in a
minute. Each is FOLDER/NAME.obj, the same from the same gmsh; coarse/bumpy and coarse/part, which are in
the repository, are compressed.
"""
import gzip
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

CORNERS = {2: 3, 3: 4}  # of Gmsh's element types


def surface(shape, size, quads=False):
    """Nodes (n by 3) and elements of the surfaces of a shape in Gmsh's language, in elements of that
    size."""
    geo = f"""SetFactory("OpenCASCADE");
Mesh.MeshSizeMin = {size}; Mesh.MeshSizeMax = {size}; Mesh.RecombineAll = {int(quads)};
Mesh.SaveAll = 1; Mesh.RandomFactor = 1e-9;
{shape}
"""
    with tempfile.TemporaryDirectory() as folder:
        source, result = Path(folder, "a.geo"), Path(folder, "a.msh")
        source.write_text(geo, encoding="ascii")
        subprocess.run(["gmsh", "-v", "1", "-2", "-format", "msh22", "-o", result, source], check=True)
        lines = result.read_text(encoding="ascii").splitlines()
    first = lines.index("$Nodes") + 2
    rows = [line.split() for line in lines[first:lines.index("$EndNodes")]]
    number = {row[0]: i for i, row in enumerate(rows)}
    nodes = np.array([[float(value) for value in row[1:]] for row in rows])
    first = lines.index("$Elements") + 2
    elements = []
    for line in lines[first:lines.index("$EndElements")]:
        row = line.split()
        corners = CORNERS.get(int(row[1]))
        if corners:
            elements.append([number[tag] for tag in row[-corners:]])
    used = sorted({i for element in elements for i in element})
    place = {old: new for new, old in enumerate(used)}
    return nodes[used], [[place[i] for i in element] for element in elements]


BALL = "Sphere(1) = {0, 0, 0, 1};"


def bumps(nodes):
    """The unit sphere with bumps."""
    x, y, z = nodes.T
    return nodes * (1 + 0.12 * np.sin(4 * x + 1) * np.cos(3 * y) * np.cos(3 * z + 0.5))[:, None]


def bumpy(size):
    nodes, elements = surface(BALL, size)
    return bumps(nodes), elements


def saddle(size):
    nodes, elements = surface("Rectangle(1) = {-1, -1, 0, 2, 2};", size)
    nodes[:, 2] = 0.5 * (nodes[:, 0] ** 2 - nodes[:, 1] ** 2)
    return nodes, elements


# A plate with a hole, a slot and a boss; sharp edges all around.
PART = """Box(1) = {-2, -1.5, 0, 4, 3, 0.8};
Cylinder(2) = {-0.6, 0, 0.8, 0, 0, 0.9, 0.7};
BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Cylinder(4) = {-0.6, 0, -1, 0, 0, 4, 0.35};
Box(5) = {1, -0.4, -1, 2, 0.8, 3};
BooleanDifference(6) = { Volume{3}; Delete; }{ Volume{4, 5}; Delete; };"""


def scan(size):
    """What a scanner makes of the sphere with bumps: nodes anywhere on it, and noise."""
    nodes, elements = surface(BALL, size)
    random = np.random.default_rng(1)
    nodes += 0.25 * size * random.uniform(-1, 1, nodes.shape)
    nodes /= np.linalg.norm(nodes, axis=1)[:, None]
    nodes = bumps(nodes)
    return nodes * (1 + 0.01 * size * random.uniform(-1, 1, len(nodes)))[:, None], elements


MESHES = {
    "sphere": lambda: surface(BALL, 0.12),
    "cylinder": lambda: surface("Cylinder(1) = {0, 0, 0, 0, 0, 3, 1};", 0.15),
    "torus": lambda: surface("Torus(1) = {0, 0, 0, 2, 0.7};", 0.15),
    "bumpy": lambda: bumpy(0.08),
    "saddle": lambda: saddle(0.08),
    "part": lambda: surface(PART, 0.15),
    "quads": lambda: surface(BALL, 0.15, quads=True),
    "scan": lambda: scan(0.0173),
}
COARSE = {
    "coarse/bumpy": lambda: bumpy(0.15),
    "coarse/part": lambda: surface(PART, 0.28),
}


def obj_of(nodes, elements):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in nodes.tolist()]
    lines += ["f " + " ".join(str(i + 1) for i in element) for element in elements]
    return "\n".join(lines) + "\n"


def main():
    folder = Path(sys.argv[1])
    for name in sys.argv[2:] or MESHES:
        nodes, elements = (MESHES | COARSE)[name]()
        text = obj_of(nodes, elements).encode("ascii")
        if name in COARSE:
            (folder / f"{name}.obj.gz").write_bytes(gzip.compress(text, 9, mtime=0))
        else:
            (folder / f"{name}.obj").write_bytes(text)
        print(name, len(nodes), "nodes,", len(elements), "elements")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Makes the bundled meshes: python3 make_meshes.py [NAME ...]   (needs numpy and gmsh 4.8)

NAME is naca0012, three_element, circle or quads, with the prefix coarse/ for the small versions;
without a name all are made. Each .geo is written first and is all that gmsh reads; the .su2 beside
it is what gmsh made of it. The same gmsh gives the same files again.
"""
import sys
from pathlib import Path

import numpy as np
from meshgen import shapes
from meshgen.geo import SizeField, body_in_circle, run_gmsh, wall_loop
from meshgen.quads import box_with_holes, insert_layers
from meshgen.su2 import write_su2

HERE = Path(__file__).resolve().parent


def naca0012(wall, edge, growth):
    size = SizeField(wall, growth, [(0.0, 0.0, edge), (1.0, 0.0, edge)])
    header = ["NACA 0012, chord 1, closed trailing edge:",
              "y = +-0.6 (0.2969 sqrt(x) - 0.1260 x - 0.3516 x^2 + 0.2843 x^3 - 0.1036 x^4),",
              "in a circle of 100 chords. Written by make_meshes.py."]
    return body_in_circle(header, {"airfoil": wall_loop(shapes.naca0012(), size)}, size, 100.0)


def three_element(scale, growth):
    sides = shapes.three_element()
    # Spacing at the leading and trailing edges: noses by their radius, gaps by their width (0.022).
    spacing = {"slat": (0.0016, 0.0026), "main": (0.0040, 0.0026), "flap": (0.0022, 0.0030)}
    sources = []
    for name, (side, _) in sides.items():
        for (x, y), h in zip((side[-1], side[0]), spacing[name]):
            sources.append((float(x), float(y), scale * h))
    size = SizeField(0.0065 * scale, growth, sources)
    walls = {name: wall_loop(pair, size) for name, pair in sides.items()}
    header = ["Slat, main element with cove, flap, in a circle of 100 chords: the formulas are in",
              "README.md and meshgen/shapes.py. Written by make_meshes.py."]
    return body_in_circle(header, walls, size, 100.0)


def circle(wall_points, radius=10.0):
    angle = 2 * np.pi * np.arange(wall_points) / wall_points
    growth = 2 * np.pi / wall_points
    size = SizeField(0.5 * growth, growth)
    header = [f"Circle of radius 0.5, {wall_points} wall points, in a circle of {radius:g}.",
              "Written by make_meshes.py."]
    wall = 0.5 * np.stack([np.cos(angle), np.sin(angle)], 1)
    return body_in_circle(header, {"circle": wall}, size, radius, (0.0, 0.0), wall_points)


def quads(size):
    holes = {"circle": ((-0.8, 0.1), (0.5, 0.5), 0.0), "ellipse": ((0.9, -0.2), (0.6, 0.35), 30.0)}
    header = ["Uniform quadrilaterals in a box of 4 by 3 with a circle of radius 0.5 and an",
              "ellipse of semi-axes 0.6 and 0.35 turned by 30 degrees.",
              "make_meshes.py inserts the layers."]
    return box_with_holes(header, 2.0, 1.5, holes, size)


# Case E: rings of quadrilaterals at every boundary, each this share of the boundary spacing thick.
LAYERS = {"quads": (4, 0.02), "coarse/quads": (2, 0.04)}

MESHES = {
    "naca0012": lambda: naca0012(0.022, 0.007, 0.12),
    "three_element": lambda: three_element(1.0, 0.09),
    "circle": lambda: circle(64),
    "quads": lambda: quads(0.08),
    "coarse/naca0012": lambda: naca0012(0.05, 0.016, 0.22),
    "coarse/three_element": lambda: three_element(2.0, 0.2),
    "coarse/circle": lambda: circle(24),
    "coarse/quads": lambda: quads(.18),
}


def make(name):
    geo = HERE / f"{name}.geo"
    geo.parent.mkdir(exist_ok=True)
    geo.write_text(MESHES[name]())
    xyz, elements, marks = run_gmsh(geo)
    if name in LAYERS:
        xyz, elements, marks = insert_layers(xyz, elements, marks, *LAYERS[name])
    write_su2(geo.with_suffix(".su2"), xyz, elements, marks)
    print(f"{name}: {len(xyz)} nodes, {len(elements)} elements, "
          + ", ".join(f"{m} {len(e)}" for m, e in marks.items()))


if __name__ == "__main__":
    for wanted in sys.argv[1:] or MESHES:
        if wanted not in MESHES:
            sys.exit(f"no mesh {wanted!r}; known: {', '.join(MESHES)}")
        make(wanted)

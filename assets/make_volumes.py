#!/usr/bin/env python3
"""Makes the volume meshes: python3 make_volumes.py [NAME ...]   (needs numpy and gmsh 4.8)

NAME is sphere, cube or wing, with the prefix coarse/ for the small versions; without a name all are
made, which takes minutes and a few GB for the wing. Each .geo is written first and is all that gmsh
reads. What gmsh makes of it stands beside it: coarse/NAME.su2.gz, and volumes/NAME.su2, which is too
large for the repository. The same gmsh gives the same files again.
"""
import gzip
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from meshgen import shapes
from meshgen.volumes import WingShape, cube_in_box, sphere_in_box, wing_in_box

HERE = Path(__file__).resolve().parent


def sphere(wall, growth):
    header = ["Sphere of radius 1 in a box of edge 10. Written by make_volumes.py."]
    return sphere_in_box(header, 1.0, 5.0, wall, growth)


def cube(wall, growth):
    header = ["Cube of edge 2 in a box of edge 10. Written by make_volumes.py."]
    return cube_in_box(header, 2.0, 5.0, wall, growth)


def thinned(curve, count):
    """So many points of a curve from its first to its last, at equal steps of its parameter."""
    return curve[np.round(np.linspace(0, len(curve) - 1, count)).astype(int)]


def wing(points, wall, edge, growth, apart=0.0):
    """points: of the spline of a side. apart: slat and flap are this much farther from the main
    element, so that coarse meshes have nodes in the gaps."""
    shape = WingShape(span=1.5, taper=0.5, sweep=25.0)
    # Flap and slat end short of the symmetry plane, so that they can turn about a swept hinge.
    stations = {"slat": (0.15, 1.5), "main": (0.0, 1.5), "flap": (0.15, 1.2)}
    shift = {"slat": (-apart, -apart / 2), "main": (0, 0), "flap": (apart, -apart)}
    elements = {name: ([thinned(side, points) + np.array(shift[name]) for side in sides],
                       stations[name]) for name, sides in shapes.three_element().items()}
    header = ["Wing of slat, main element and flap, half model: the section of three_element.geo,",
              "swept and tapered, see README.md. Written by make_volumes.py."]
    return wing_in_box(header, shape, elements, (-9.5, -10.0, 0.0), (11.5, 10.0, 10.0),
                       (wall, edge, growth))


MESHES = {
    "volumes/sphere": lambda: sphere(0.0537, 0.0804),
    "volumes/cube": lambda: cube(0.0796, 0.0896),
    "volumes/wing": lambda: wing(81, 0.0102, 0.004, 0.1245),
    "coarse/sphere": lambda: sphere(0.2, 0.2),
    "coarse/cube": lambda: cube(0.25, 0.2),
    "coarse/wing": lambda: wing(41, 0.085, 0.035, 0.5, 0.04),
}


def run_gmsh(geo):
    """What gmsh makes of a .geo file, as the bytes of an SU2 file."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "mesh.su2"
        command = ["gmsh", "-3", str(geo), "-format", "su2", "-o", str(out), "-v", "2"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0 or not out.exists():
            raise RuntimeError(f"gmsh failed on {geo}:\n{done.stdout}{done.stderr}")
        return out.read_bytes()


def make(name):
    geo = HERE / f"{name}.geo"
    geo.parent.mkdir(exist_ok=True)
    geo.write_text(MESHES[name]())
    mesh = run_gmsh(geo)
    if name.startswith("coarse/"):
        geo.with_suffix(".su2.gz").write_bytes(gzip.compress(mesh, mtime=0))
    else:
        geo.with_suffix(".su2").write_bytes(mesh)
    counts = {key: mesh.split(key + b"=")[1].split()[0].decode() for key in (b"NPOIN", b"NELEM")}
    print(f"{name}: {counts[b'NPOIN']} nodes, {counts[b'NELEM']} elements")


if __name__ == "__main__":
    for wanted in sys.argv[1:] or MESHES:
        if wanted not in MESHES:
            sys.exit(f"no mesh {wanted!r}; known: {', '.join(MESHES)}")
        make(wanted)

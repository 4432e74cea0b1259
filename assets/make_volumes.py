#!/usr/bin/env python3
"""Makes the volume meshes: python3 make_volumes.py [--folder DIR] [NAME ...]   (needs numpy and gmsh 4.8)

NAME is one of the table MESHES below: sphere, cube or wing with the prefix coarse/ for the small versions, these and
others with the prefix volumes/ for the large ones. Without a name the six that README.md describes first are made,
which takes minutes and a few GB for the wing. Each .geo is written first and is all that gmsh reads. What gmsh makes
of it stands beside it: coarse/NAME.su2.gz, and volumes/NAME.su2, which is too large for the repository. The same gmsh
gives the same files again. --folder: where coarse/ and volumes/ are, instead of the folder of this program.
"""
import argparse
import gzip
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from meshgen import shapes
from meshgen.prisms import layer_heights, with_prisms
from meshgen.su2 import read_volume, volume_text
from meshgen.volumes import WingShape, cube_in_box, ellipsoid_in_box, sphere_in_box, wing_in_box

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


def tight_box(size):
    header = ["Ellipsoid of semi-axes 1.2, .8 and .6 in a box of 8 by 6 by 6. Written by make_volumes.py."]
    return ellipsoid_in_box(header, (1.2, 0.8, 0.6), (4.0, 3.0, 3.0), size)


def around_layers(heights):
    """Tetrahedra around the layers at a sphere of radius 1."""
    radius = 1 + float(sum(heights))
    header = [f"Sphere of radius {radius:g}, layers included, in a box of edge 10. Written by make_volumes.py."]
    return sphere_in_box(header, radius, 5.0, 0.13, 0.18)


MESHES = {
    "volumes/sphere": lambda: sphere(0.0537, 0.0804),
    "volumes/cube": lambda: cube(0.0796, 0.0896),
    "volumes/wing": lambda: wing(81, 0.0102, 0.004, 0.1245),
    "coarse/sphere": lambda: sphere(0.2, 0.2),
    "coarse/cube": lambda: cube(0.25, 0.2),
    "coarse/wing": lambda: wing(41, 0.085, 0.035, 0.5, 0.04),
}
# Made only when they are named.
FURTHER = {
    "volumes/sphere_15k": lambda: sphere(0.0868, 0.13),
    "volumes/sphere_1m": lambda: sphere(0.0418, 0.0626),
    "volumes/tight_box": lambda: tight_box(0.215),
}
# Each element is divided into eight by Gmsh.
REFINED = {"volumes/sphere_1m"}
# Heights of layers of prisms at the sphere: first, ratio, layers.
LAYERS = {"volumes/layers_1e-3": layer_heights(1e-3, 1.3, 12),
          "volumes/layers_1e-4": layer_heights(1e-4, 1.4, 16),
          "volumes/layers_1e-5": layer_heights(1e-5, 1.5, 20)}
KNOWN = {**MESHES, **FURTHER, **{name: lambda h=heights: around_layers(h) for name, heights in LAYERS.items()}}


def run_gmsh(geo, refined, endings):
    """What gmsh makes of a .geo file, as the bytes of a file of each ending."""
    with tempfile.TemporaryDirectory() as folder:
        out = [Path(folder) / f"mesh{ending}" for ending in endings]
        steps = Path(folder) / "steps.geo"
        steps.write_text("\n".join([f'Merge "{geo.resolve()}";', "Mesh 3;", *(["RefineMesh;"] if refined else []),
                                    *(f'Save "{path}";' for path in out)]) + "\n")
        command = ["gmsh", str(steps), "-parse_and_exit", "-v", "2"]
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode != 0 or not all(path.exists() for path in out):
            raise RuntimeError(f"gmsh failed on {geo}:\n{done.stdout}{done.stderr}")
        return [path.read_bytes() for path in out]


def make(name, folder, keep_msh):
    geo = folder / f"{name}.geo"
    geo.parent.mkdir(parents=True, exist_ok=True)
    geo.write_text(KNOWN[name]())
    mesh, *msh = run_gmsh(geo, name in REFINED, [".su2", ".msh"] if keep_msh else [".su2"])
    if name in LAYERS:
        mesh = volume_text(with_prisms(read_volume(mesh.decode()), "sphere", LAYERS[name])).encode()
    for content in msh:
        geo.with_suffix(".msh").write_bytes(content)
    if name.startswith("coarse/"):
        geo.with_suffix(".su2.gz").write_bytes(gzip.compress(mesh, mtime=0))
    else:
        geo.with_suffix(".su2").write_bytes(mesh)
    counts = {key: mesh.split(key + b"=")[1].split()[0].decode() for key in (b"NPOIN", b"NELEM")}
    print(f"{name}: {counts[b'NPOIN']} nodes, {counts[b'NELEM']} elements")


def main():
    parser = argparse.ArgumentParser(description="Makes the volume meshes; needs numpy and gmsh 4.8.")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of these: {', '.join(KNOWN)}")
    parser.add_argument("--folder", type=Path, default=HERE, help="where coarse/ and volumes/ are written")
    parser.add_argument("--msh", action="store_true", help="write the mesh as Gmsh has it, too, with the entities "
                        "of the .geo: NAME.msh; not of meshes with layers, which Gmsh does not make")
    wanted = parser.parse_args()
    for name in wanted.names:
        if name not in KNOWN:
            sys.exit(f"no mesh {name!r}; known: {', '.join(KNOWN)}")
        if wanted.msh and name in LAYERS:
            sys.exit(f"{name}: Gmsh does not make the layers, so there is no .msh")
    for name in wanted.names or MESHES:
        make(name, wanted.folder, wanted.msh)


if __name__ == "__main__":
    main()

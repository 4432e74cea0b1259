#!/usr/bin/python3
"""Makes the pictures of volume meshes in README.md and the pages beside this: make_volume_pictures.py WINSLOW

Meshes are bundled or come from Gmsh, on the spot. Needs no display.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

PICTURES = Path(__file__).resolve().parent / "pictures" / "volumes"

SPHERE = """
SetFactory("OpenCASCADE");
Box(1) = {-5, -5, -5, 10, 10, 10}; Sphere(2) = {0, 0, 0, 1};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("fluid") = {3};
Physical Surface("sphere") = {7}; Physical Surface("farfield") = {1:6};
MeshSize{ PointsOf{ Surface{1:6}; } } = 1.4; MeshSize{ PointsOf{ Surface{7}; } } = 0.25;
"""

# A tapered, swept half wing on a plane of symmetry, y = 0.
WING = """
SetFactory("OpenCASCADE");
Box(1) = {-4, 0, -4, 10, 8, 8};
Point(100) = {0, -0.01, 0}; Point(101) = {0.3, -0.01, 0.07};
Point(102) = {1, -0.01, 0}; Point(103) = {0.3, -0.01, -0.04};
Spline(100) = {102, 101, 100}; Spline(101) = {100, 103, 102}; Curve Loop(100) = {100, 101};
Point(110) = {1.2, 3, 0}; Point(111) = {1.35, 3, 0.035};
Point(112) = {1.7, 3, 0}; Point(113) = {1.35, 3, -0.02};
Spline(110) = {112, 111, 110}; Spline(111) = {110, 113, 112}; Curve Loop(110) = {110, 111};
ThruSections(2) = {100, 110};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
wing() = Surface In BoundingBox{-0.1, -0.1, -0.2, 1.8, 3.1, 0.2};
symmetry() = Surface In BoundingBox{-4.1, -0.001, -4.1, 6.1, 0.001, 4.1};
far() = Boundary{ Volume{3}; }; far() -= wing(); far() -= symmetry();
Physical Volume("fluid") = {3};
Physical Surface("wing") = {wing()}; Physical Surface("symmetry") = {symmetry()};
Physical Surface("farfield") = {far()};
MeshSize{ PointsOf{ Surface{far()}; } } = 1; MeshSize{ PointsOf{ Surface{wing()}; } } = 0.12;
"""

# Hexahedra around a cylinder.
CYLINDER = """
SetFactory("OpenCASCADE");
Rectangle(1) = {-2, -2, 0, 4, 4}; Disk(2) = {0, 0, 0, 0.5};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
MeshSize {:} = 0.25; Recombine Surface{3};
e[] = Extrude {0, 0, 2} { Surface{3}; Layers{10}; Recombine; };
Physical Volume("fluid") = {e[1]};
Physical Surface("sides") = {e[2], e[3], e[4], e[5]}; Physical Surface("cylinder") = {e[6]};
Physical Surface("bottom") = {3}; Physical Surface("top") = {e[0]};
"""

# Name of the picture, geometry, options of the motion before it (none: the mesh as it is), of render.
FIGURES = [
    ("sphere", SPHERE, None, []),
    ("wing", WING, None, ["--centre", 0.7, 1.5, 0, "--half-width", 1.5]),
    ("cylinder", CYLINDER, None, ["--crinkle", "--cut", 0, 0, 1, 0.3, -1, 0.5]),
    ("isolated", SPHERE, ["--marker", "sphere", "--translate", 0.9, 0, 0, "--rotate", 60, "--axis", 0, 1, 0],
     ["--isolate", 0.2, "--centre", 0.9, 0, 0, "--half-width", 3]),
]


ASSETS = Path(__file__).resolve().parent.parent / "assets" / "coarse"

# Of bundled meshes, for README.md: name of the picture, mesh, motion, options of render, and whether
# the mesh whose boundary alone has moved stands beside it.
BUNDLED = [
    ("moved", "cube.su2.gz",
     ["--marker", "cube", "--rotate", 60, "--axis", 0, 1, 0, "--translate", 1, 0, 0.5],
     ["--centre", 0.6, 0, 0.2, "--half-width", 3], True),
    ("flap", "wing.su2.gz",
     ["--marker", "flap", "--rotate", -25, "--axis", 0.2555, 0.038, 1.5,
      "--pivot", 0.888, -0.076, 0],
     ["--up", "y", "--cut", 0, 0, 0.5, 0, 0, 1, "--azimuth", 35, "--elevation", 20,
      "--centre", 0.55, 0, 0.35, "--half-width", 0.75], False),
]
# Layers of bundled meshes, for layers-in-space.md: name of the picture, marker, options of layers and of render.
LAYERED = [
    ("layers_sphere", "sphere", ["--count", 12, "--first", 0.005, "--ratio", 1.2, "--growth", 1],
     ["--crinkle", "--cut", 0, 0, 0, 0, 1, 0, "--centre", 0, 0, 0, "--half-width", 2.2]),
    ("layers_cube", "cube", ["--count", 10, "--first", 0.01, "--ratio", 1.2],
     ["--cut", 0, 0, 0, 0, 1, 0, "--centre", 0, 0, 0, "--half-width", 1.6]),
]
INVERTED = 4  # exit status


def run(*command, expect=0):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    if done.returncode != expect:
        sys.exit(done.stdout + done.stderr)


def draw_bundled(winslow, folder):
    for name, mesh, motion, options, beside in BUNDLED:
        moved, tangled = folder / "moved.su2", folder / "tangled.su2"
        run(winslow, "move", ASSETS / mesh, "-o", moved, *motion, "--quiet")
        if beside:
            run(winslow, "move", ASSETS / mesh, "-o", tangled, *motion, "--no-smooth", "--allow-inverted",
                "--quiet", expect=INVERTED)
        before = ["--before", tangled] if beside else []
        run(winslow, "render", moved, "-o", PICTURES / f"{name}.png", "--size", 520, 390, *options, *before,
            "--quiet")


def draw_layers(winslow, folder):
    mesh = folder / "layers.su2"
    for name, marker, how, options in LAYERED:
        run(winslow, "layers", ASSETS / f"{marker}.su2.gz", "-o", mesh, "--marker", marker, *how, "--quiet")
        run(winslow, "render", mesh, "-o", PICTURES / f"{name}.png", "--size", 520, 390, *options, "--quiet")


def draw_stencils(winslow):
    """The links of the paper's figure 24."""
    links = ",".join(f"link{n}" for n in (4, 6, 8, 10, 22, 40, 80))
    run(winslow, "render", ASSETS / "stencils.su2", "-o", PICTURES / "stencils.png", "--size", 1400, 260,
        "--vcv", "0,1,2,3,4,5,6", "--vcv-kind", "equal", "--hide", links, "--color", "none", "--no-cut",
        "--azimuth", -90, "--elevation", 18, "--quiet")


def main():
    winslow = Path(sys.argv[1]).resolve()
    PICTURES.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        draw_bundled(winslow, Path(folder))
        draw_layers(winslow, Path(folder))
        draw_stencils(winslow)
        for name, geometry, motion, options in FIGURES:
            source, mesh = Path(folder) / "mesh.geo", Path(folder) / "mesh.su2"
            source.write_text(geometry)
            run("gmsh", "-3", "-v", "1", "-format", "su2", source, "-o", mesh)
            if motion:
                run(winslow, "move", mesh, "-o", mesh, *motion, "--quiet")
            run(winslow, "render", mesh, "-o", PICTURES / f"{name}.png", "--size", 520, 390, *options, "--quiet")


main()

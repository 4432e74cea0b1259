"""Volume meshes: what Gmsh writes is read, and what winslow writes is read by meshio with elements of the
same volume, of the same types, and seen from the right side."""
import collections
import sys

try:
    import meshio
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

from support import HERE, arguments, check, finish, run, same, workspace

args = arguments()
FROM_GMSH = ["su2", "msh22", "msh41", "vtk", "mesh"]
# Extension, arguments of the converter; what meshio reads.
WRITTEN = [("su2", []), ("msh", ["--msh", "2.2"]), ("msh", ["--msh", "4.1", "--binary"]), ("vtk", []),
           ("vtk", ["--binary"]), ("vtu", []), ("ugrid", []), ("b8.ugrid", []), ("lb8.ugrid", []), ("mesh", [])]
ONLY_OURS = ["out.cgns", "case/constant/polyMesh"]
# Tetrahedra that make up an element whose corners are numbered as CGNS does.
PARTS = {"tetra": [(0, 1, 2, 3)], "pyramid": [(0, 1, 2, 4), (0, 2, 3, 4)],
         "wedge": [(0, 1, 2, 3), (1, 2, 3, 4), (2, 5, 3, 4)],
         "hexahedron": [(0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6)]}
MIRRORED = ("su2",)  # numbered as VTK does; of VTK files meshio turns wedges itself


def summary(path):
    """Number of elements of each type, volume to six digits, number of elements inside out."""
    mesh = meshio.read(path)
    counts, volume, inverted = collections.Counter(), 0.0, 0
    for block in mesh.cells:
        if block.type not in PARTS:
            continue
        counts[block.type] += len(block.data)
        corners = block.data
        if block.type == "wedge" and path.suffix[1:] in MIRRORED:
            corners = corners[:, [0, 2, 1, 3, 5, 4]]
        sizes = numpy.zeros(len(corners))
        for part in PARTS[block.type]:
            a, b, c, d = (mesh.points[corners[:, k]] for k in part)
            sizes += numpy.einsum("ij,ij->i", numpy.cross(b - a, c - a), d - a) / 6
        volume += sizes.sum()
        inverted += int((sizes <= 0).sum())
    return dict(counts), round(volume, 6), inverted


def boundary_counts(path):
    mesh = meshio.read(path)
    return collections.Counter(t for block in mesh.cells if block.type in ("triangle", "quad")
                               for t in [block.type] * len(block.data))


def read_gmsh(folder, geo):
    for form in FROM_GMSH:
        if geo.stem == "blocks" and form == "mesh":
            continue  # Gmsh leaves the prisms out
        source = folder / f"{geo.stem}_{form}.{form.rstrip('1234') if form.startswith('msh') else form}"
        run(args.gmsh, "-3", geo, "-format", form, "-o", source, "-v", "2")
        out = folder / "read.vtu"
        messages = run(args.convert, source, out)
        check(f"{geo.stem} as {form}: no element is turned", "turned" not in messages, messages)
        yield form, source, summary(out)


def check_mesh(folder, geo):
    results = list(read_gmsh(folder, geo))
    expected = results[0][2]
    check(f"{geo.stem}: no element is inverted", expected[2] == 0, expected)
    for form, _, found in results:
        same(f"{geo.stem} as {form}", found, expected)
    source = dict((form, source) for form, source, _ in results)["msh41"]
    for extension, options in WRITTEN:
        out = folder / f"out.{extension}"
        run(args.convert, source, out, *options)
        same(f"{geo.stem} written as {extension} {options}", summary(out), expected)
        same(f"{geo.stem}: boundary in {extension} {options}", boundary_counts(out), boundary_counts(source))
    for name in ONLY_OURS:
        out, back = folder / name, folder / "back.vtu"
        if run_if_built(source, out):
            run(args.convert, out, back)
            same(f"{geo.stem} through {name}", summary(back), expected)


def run_if_built(source, out):
    """CGNS may not be part of the build."""
    try:
        run(args.convert, source, out)
        return True
    except RuntimeError as error:
        check(f"writing {out.name}", "without" in str(error), str(error))
        return False


with workspace() as name:
    import pathlib
    for geometry in ("volumes.geo", "blocks.geo"):
        check_mesh(pathlib.Path(name), HERE / geometry)
finish()

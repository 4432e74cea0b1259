"""meshio reads what winslow writes, and winslow reads what meshio writes, in every common format."""
import pathlib
import sys

try:
    import meshio
    import numpy
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

from support import HERE, arguments, check, finish, make_mesh, run, same, workspace

args = arguments()
MARKER_FORMATS = ["msh", "vtk", "vtu"]
PLAIN_FORMATS = ["obj", "off", "ply"]


def cells(mesh, kinds):
    """Corners of all cells of the kinds, block after block."""
    return [tuple(int(n) for n in cell) for block in mesh.cells if block.type in kinds
            for cell in block.data]


def elements(mesh):
    return cells(mesh, ("triangle", "quad"))


def tags(mesh, array):
    out = {}
    for block, values in zip(mesh.cells, mesh.cell_data[array]):
        if block.type == "line":
            for cell, tag in zip(block.data, values):
                out.setdefault(int(tag), []).append(tuple(int(n) for n in cell))
    return out


def plain(mesh):
    """Elements only: what formats for surfaces can hold."""
    return meshio.Mesh(mesh.points, [b for b in mesh.cells if b.type in ("triangle", "quad")])


def tagged(mesh):
    """Without the sets and other extras that not every writer of meshio can take."""
    return meshio.Mesh(mesh.points, mesh.cells,
                       cell_data={"gmsh:physical": mesh.cell_data["gmsh:physical"]})


def write_and_compare(folder, full, full_source):
    for extension in MARKER_FORMATS + PLAIN_FORMATS:
        for encoding in ("--ascii", "--binary"):
            label = f"{extension} {encoding} read by meshio"
            reference, source = full, full_source
            if extension == "off":  # meshio knows triangles only there
                source = folder / "triangles.msh"
                reference = meshio.read(source)
            out = folder / f"out.{extension}"
            run(args.convert, source, out, encoding, "--fresh")
            mesh = meshio.read(out)
            points = mesh.points[:, :2]
            same(f"{label}: points", points.tolist(), reference.points[:, :2].tolist())
            same(f"{label}: elements", sorted(elements(mesh)), sorted(elements(reference)))
            if extension in ("vtk", "vtu"):
                found = tags(mesh, "marker")
                found.pop(0, None)
                same(f"{label}: markers", found, tags(reference, "gmsh:physical"))
            if extension == "msh":
                same(f"{label}: markers", tags(mesh, "gmsh:physical"),
                     tags(reference, "gmsh:physical"))
                names = {k: v.tolist() for k, v in mesh.field_data.items() if v[1] == 1}
                expected = {k: v.tolist() for k, v in reference.field_data.items() if v[1] == 1}
                same(f"{label}: names", names, expected)


def read_and_compare(folder, reference):
    """Files written by meshio: what comes back through winslow must be the same mesh."""
    variants = [("msh", "gmsh22", {"binary": False}), ("msh", "gmsh22", {"binary": True}),
                ("msh", "gmsh", {"binary": False}), ("msh", "gmsh", {"binary": True}),
                ("vtk", "vtk", {"binary": False}), ("vtk", "vtk", {"binary": True}),
                ("vtk", "vtk42", {"binary": False}), ("vtk", "vtk42", {"binary": True}),
                ("vtu", "vtu", {"binary": False}), ("vtu", "vtu", {"binary": True}),
                ("vtu", "vtu", {"binary": True, "compression": None}),
                ("obj", "obj", {}), ("off", "off", {}),
                ("ply", "ply", {"binary": False}), ("ply", "ply", {"binary": True})]
    for extension, file_format, options in variants:
        label = f"{file_format} {options} written by meshio"
        source = folder / f"meshio.{extension}"
        mesh = reference
        if extension in ("vtk", "vtu"):
            mesh = tagged(reference)
        if extension in ("obj", "ply"):
            mesh = plain(reference)
        if extension == "off":
            mesh = plain(meshio.read(folder / "triangles.msh"))
        meshio.write(source, mesh, file_format=file_format, **options)
        run(args.convert, source, folder / "through.vtu")
        through = meshio.read(folder / "through.vtu")
        expected = mesh.points[:, :2]
        found = through.points[:, :2]
        # meshio writes these with few digits.
        exact = extension not in ("off", "obj") and (file_format, options.get("binary")) != ("vtu", False)
        close = found.shape == expected.shape and (
            numpy.array_equal(found, expected) if exact else numpy.allclose(found, expected,
                                                                            atol=1e-6))
        check(f"{label}: points", close)
        same(f"{label}: elements", sorted(elements(through)), sorted(elements(mesh)))
        if extension in ("msh", "vtk", "vtu"):
            # Files of VTK keep the array that they have.
            found = tags(through, "marker" if extension == "msh" else "gmsh:physical")
            found.pop(0, None)
            same(f"{label}: markers", found, tags(mesh, "gmsh:physical"))


def planes(folder, reference):
    """A mesh in x and z, as it is and seen from behind, through winslow in every format and back."""
    for label, place in (("x-z", lambda p: (p[0], -0.5, p[1])), ("x-z from behind", lambda p: (p[1], 2, p[0]))):
        turned = plain(reference)
        turned.points = numpy.array([place(p) for p in reference.points])
        source = folder / "turned.vtu"
        meshio.write(source, turned)
        for extension in MARKER_FORMATS + ["obj", "ply"]:
            out = folder / f"turned_out.{extension}"
            run(args.convert, source, out, "--ascii")
            found = meshio.read(out)
            check(f"{label} to {extension}: points", numpy.array_equal(found.points, turned.points))
            same(f"{label} to {extension}: elements", sorted(elements(found)), sorted(elements(turned)))


with workspace() as name:
    folder = pathlib.Path(name)
    source = folder / "source.msh"
    make_mesh(args.gmsh, HERE / "two_bodies.geo", source, "4.1", False)
    make_mesh(args.gmsh, HERE / "two_bodies.geo", folder / "triangles.msh", "4.1", False,
              "-setnumber", "recombine", "0")
    reference = meshio.read(source)
    check("the reference has triangles, quadrilaterals and markers",
          bool(cells(reference, ("triangle",)) and cells(reference, ("quad",))
               and len(tags(reference, "gmsh:physical")) == 4))
    write_and_compare(folder, reference, source)
    read_and_compare(folder, reference)
    planes(folder, reference)
finish()

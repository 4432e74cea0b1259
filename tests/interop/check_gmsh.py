"""Gmsh writes meshes, winslow reads and writes them, Gmsh reads those and must see the same mesh."""
import pathlib

from support import (HERE, arguments, by_place, check, finish, make_mesh, resave, run, same,
                     workspace)

args = arguments()


def read_su2(path):
    """Points, elements and marker edges of an SU2 file."""
    points, elements, markers = [], [], {}
    lines = iter(pathlib.Path(path).read_text().split("\n"))
    for line in lines:
        key, _, value = line.partition("=")
        if key == "NELEM":
            for _ in range(int(value)):
                words = [int(w) for w in next(lines).split()]
                size = {5: 3, 9: 4}[words[0]]
                elements.append(tuple(words[1:1 + size]))
        if key == "NPOIN":
            points = [tuple(float(w) for w in next(lines).split()[:2])
                      for _ in range(int(value.split()[0]))]
        if key == "MARKER_TAG":
            name = value.strip()
            count = int(next(lines).partition("=")[2])
            markers[name] = [tuple(int(w) for w in next(lines).split()[1:3]) for _ in range(count)]
    return {"points": points, "elements": elements, "markers": markers}


def check_msh(folder):
    geo = HERE / "two_regions.geo"
    # The reference has the orientation that winslow gives to elements: Gmsh's own, counter-clockwise.
    for version in ("2.2", "4.1"):
        for binary in (False, True):
            label = f"msh {version} {'binary' if binary else 'ascii'}"
            source = folder / "source.msh"
            make_mesh(args.gmsh, geo, source, version, binary)
            reference = resave(args.gmsh, source, folder / "seen.msh")
            everything = resave(args.gmsh, source, folder / "seen.msh", everything=True)
            check(f"{label}: reference has groups", len(by_place(reference)) == 8,
                  str(by_place(reference).keys()))

            run(args.convert, source, folder / "same.msh")
            if not binary:
                check_same_text(label, source.read_text(), (folder / "same.msh").read_text())
            elif version == "4.1":
                # In 2.2 Gmsh writes a header for each element, we one for a run of them.
                same(f"{label}: same size", (folder / "same.msh").stat().st_size,
                     source.stat().st_size)
            same(f"{label}: mesh", resave(args.gmsh, folder / "same.msh", folder / "seen.msh"),
                 reference)
            same(f"{label}: everything",
                 resave(args.gmsh, folder / "same.msh", folder / "seen.msh", everything=True),
                 everything)

            other = "4.1" if version == "2.2" else "2.2"
            for target_binary in ("--binary", "--ascii"):
                run(args.convert, source, folder / "other.msh", "--msh", other, target_binary)
                found = by_place(resave(args.gmsh, folder / "other.msh", folder / "seen.msh"))
                # When Gmsh reads 2.2, elements in two groups end up twice in each.
                expected = {k: list(dict.fromkeys(v)) for k, v in by_place(reference).items()}
                found = {k: list(dict.fromkeys(v)) for k, v in found.items()}
                # Points belong to the entities of the source, which another version does not keep.
                expected.pop("corner", None)
                expected["curve_99"] = expected.pop("1:99")
                same(f"{label} to {other} {target_binary}", found, expected)


def check_same_text(label, source, written):
    """Word by word, but numbers by value: Gmsh prints 0.1 as 0.1, others with 16 digits."""
    def words(text):
        out = []
        for word in text.split():
            try:
                out.append(float(word))
            except ValueError:
                out.append(word)
        return out
    a, b = words(source), words(written)
    same(f"{label}: number of words", len(b), len(a))
    different = [(x, y) for x, y in zip(a, b) if x != y]
    check(f"{label}: same text", not different, str(different[:5]))


def check_su2(folder):
    """SU2 from Gmsh; to MSH and back; and through Gmsh."""
    geo = HERE / "two_regions.geo"
    run(args.gmsh, "-2", geo, "-o", folder / "gmsh.su2", "-format", "su2", "-v", "2")
    source = read_su2(folder / "gmsh.su2")
    run(args.convert, folder / "gmsh.su2", folder / "same.su2")
    same("su2: same", read_su2(folder / "same.su2"), source)
    for version in ("2.2", "4.1"):
        for encoding in ("--binary", "--ascii"):
            label = f"su2 to msh {version} {encoding}"
            run(args.convert, folder / "same.su2", folder / "there.msh", "--msh", version, encoding)
            run(args.convert, folder / "there.msh", folder / "back.su2", "--fresh")
            same(f"{label} and back", read_su2(folder / "back.su2"), source)
            seen = by_place(resave(args.gmsh, folder / "there.msh", folder / "seen.msh"))
            points = source["points"]
            for name, edges in source["markers"].items():
                expected = [(1, tuple((*points[n], 0.0) for n in edge)) for edge in edges]
                same(f"{label}: Gmsh sees marker {name}", seen.get(name), expected)
            same(f"{label}: Gmsh sees all elements", len(seen["domain"]), len(source["elements"]))


def check_gmsh_vtk(folder):
    """Legacy VTK as Gmsh writes it, ASCII and binary: physical tags become markers."""
    geo = HERE / "two_regions.geo"
    for flag in ([], ["-bin"]):
        run(args.gmsh, "-2", geo, "-o", folder / "gmsh.vtk", "-format", "vtk", "-v", "2", *flag)
        run(args.convert, folder / "gmsh.vtk", folder / "vtk.su2")
        run(args.gmsh, "-2", geo, "-o", folder / "gmsh.su2", "-format", "su2", "-v", "2")
        vtk, su2 = read_su2(folder / "vtk.su2"), read_su2(folder / "gmsh.su2")
        # Gmsh writes more digits to binary VTK than to SU2.
        def place(mesh):
            points = [tuple(round(c, 12) + 0.0 for c in p) for p in mesh["points"]]
            return sorted(sorted(points[n] for n in e) for e in mesh["elements"])
        same(f"vtk {flag}: elements", place(vtk), place(su2))
        same(f"vtk {flag}: markers", sorted(vtk["markers"]),
             ["marker_17", "marker_23", "marker_4", "marker_99"])


def check_our_vtk(folder):
    """Gmsh opens legacy VTK with markers as winslow writes it."""
    run(args.gmsh, "-2", HERE / "two_regions.geo", "-o", folder / "ours.su2", "-format", "su2", "-v", "2")
    run(args.convert, folder / "ours.su2", folder / "ours.vtk")
    count = len(read_su2(folder / "ours.su2")["points"])
    said = run(args.gmsh, "-0", folder / "ours.vtk", "-o", folder / "seen.msh", "-v", "5")
    check("our vtk: it has markers", "marker:" in (folder / "ours.vtk").read_text())
    check("our vtk: Gmsh reads all points", f"Reading {count} points" in said, said)


def check_planes(folder):
    """Meshes of Gmsh in other planes of space, from either side, stay where Gmsh had them."""
    text = (HERE / "two_regions.geo").read_text()
    for label, turn in TURNS.items():
        geo, source = folder / "turned.geo", folder / "turned.msh"
        geo.write_text(f"{text}\nRotate {{{turn}}} {{ Surface{{:}}; }}\n")
        for version, binary in (("2.2", False), ("4.1", False), ("4.1", True)):
            make_mesh(args.gmsh, geo, source, version, binary)
            reference = resave(args.gmsh, source, folder / "seen.msh")
            heights = {n[2] for n in reference["nodes"].values()}
            check(f"{label}: not in x and y", max(heights) - min(heights) > 0.1)
            run(args.convert, source, folder / "same.msh")
            same(f"{label}, {version}, binary {binary}",
                 resave(args.gmsh, folder / "same.msh", folder / "seen.msh"), reference)


TURNS = {"x-z": "{1, 0, 0}, {0, 0, 0}, Pi/2", "x-z from behind": "{1, 0, 0}, {0, 0, 0}, -Pi/2",
         "y-z": "{0, 1, 0}, {0, 0, 0}, Pi/2", "tilted": "{1, 1, 0}, {0, 0, 3}, 0.7"}


with workspace() as name:
    folder = pathlib.Path(name)
    check_msh(folder)
    check_su2(folder)
    check_gmsh_vtk(folder)
    check_our_vtk(folder)
    check_planes(folder)
finish()

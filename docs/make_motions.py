#!/usr/bin/python3
"""Draws worst against mean quality of motions, for docs/motions.md: make_motions.py WINSLOW MESHES

Runs the motions below with several targets, writes docs/pictures/motions.csv, and draws
docs/pictures/motions.png from it. "make_motions.py" alone draws again from the CSV. MESHES is a
folder with naca.su2 (NACA 0012, 8,114 nodes; marker airfoil), multi.su2 (three elements, 15,303
nodes; slat, main, flap), and sphere.su2 of assets/make_volumes.py; rows of a mesh that is not there
stay as they were. Needs Debian's python3-matplotlib, and Gmsh for the ellipsoid. About 10 minutes.
"""
import csv
import itertools
import json
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
TABLE, PICTURE = HERE / "pictures" / "motions.csv", HERE / "pictures" / "motions.png"

# An ellipsoid in a tight box, in uniform cells: 26,273 nodes with Gmsh 4.8.
ELLIPSOID = """
SetFactory("OpenCASCADE");
Box(1) = {-4, -3, -3, 8, 6, 6}; Sphere(2) = {0, 0, 0, 1};
Dilate {{0, 0, 0}, {1.2, 0.8, 0.6}} { Volume{2}; }
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.CharacteristicLengthMin = 0.21; Mesh.CharacteristicLengthMax = 0.21;
Mesh.CharacteristicLengthFromPoints = 0; Mesh.CharacteristicLengthExtendFromBoundary = 0;
body() = Surface In BoundingBox{-2.9, -2.9, -2.9, 2.9, 2.9, 2.9}; far() = Boundary{ Volume{3}; }; far() -= body();
Physical Volume("fluid") = {3}; Physical Surface("far") = {far()}; Physical Surface("body") = {body()};
"""

ALL = ["--marker", "slat", "--marker", "main", "--marker", "flap"]
AXIS = ["--axis", "0", "0", "1", "--pivot", "0", "0", "0"]
CASES = {  # title: mesh, options of move
    "NACA 0012, 90° and moved": ("naca.su2", ["--marker", "airfoil", "--rotate", "90", "--pivot", "0.5", "0",
                                              "--translate", "0.5", "0.3"]),
    "NACA 0012, 178°": ("naca.su2", ["--marker", "airfoil", "--rotate", "178", "--pivot", "0.5", "0"]),
    "three elements, 90° and moved": ("multi.su2", [*ALL, "--rotate", "90", "--pivot", "0.5", "0",
                                                    "--translate", "0.5", "0.3"]),
    "three elements, 178°": ("multi.su2", [*ALL, "--rotate", "178", "--pivot", "0.5", "0"]),
    "flap, −40° and moved": ("multi.su2", ["--marker", "flap", "--rotate", "-40", "--pivot", "0.862", "-0.015",
                                           "--translate", "0.02", "-0.02"]),
    "quadrilaterals, ellipse 40°": ("quads.su2", ["--marker", "ellipse", "--rotate", "40"]),
    "sphere, 90° and its radius": ("sphere.su2", ["--marker", "sphere", "--rotate", "90", *AXIS,
                                                  "--translate", "1", "0", "0"]),
    "ellipsoid in a tight box, 90°": ("ellipsoid.msh", ["--marker", "body", "--rotate", "90", *AXIS]),
    "208 hexahedra, cube 30°": ("hexahedra.su2", ["--marker", "body", "--rotate", "30", *AXIS]),
}
BLENDS = [f"rest={share} element={round(1 - share, 2)}" for share in (0.75, 0.5, 0.25)]
TARGETS = ["keep", "rest", *BLENDS, "element", "auto"]

# keep with other constants: rows of the table "How the constants were chosen" in motions.md. The
# constants are compiled in; each row was measured with a program of its own. (row, worst, mean)
CONSTANTS = {
    "NACA 0012, 178°": [("no guard", 0.137, 0.652), ("1.78, 10", 0.229, 0.646), ("1.78, 1", 0.228, 0.647),
                        ("1.4, 0.1", 0.227, 0.640), ("1.4, 0.1, slivers more", 0.229, 0.640),
                        ("the same, linear from 1.2", 0.229, 0.641), ("from 1.5", 0.229, 0.640)],
    "sphere, 90° and its radius": [("1.4, 0.1, slivers more", 0.132, 0.489), ("linear from 1.2", 0.077, 0.496),
                                   ("from 1.5", 0.132, 0.489)],
    "ellipsoid in a tight box, 90°": [("1.4, 0.1, slivers more", 0.098, 0.535), ("linear from 1.2", 0.011, 0.588),
                                      ("from 1.5", 0.035, 0.551)],
}


def hexahedra(path):
    """A cube of 2 x 2 x 2 cells that is missing in the middle of 6 x 6 x 6."""
    numbers, cells, faces = {}, [], {}
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    sides = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
    for cell in itertools.product(range(6), repeat=3):
        if not all(2 <= c < 4 for c in cell):
            places = [tuple(c + d for c, d in zip(cell, corner)) for corner in corners]
            nodes = [numbers.setdefault(place, len(numbers)) for place in places]
            cells.append(nodes)
            for side in sides:  # of two cells: inside
                face = [nodes[k] for k in side]
                if faces.pop(frozenset(face), None) is None:
                    faces[frozenset(face)] = face
    places = list(numbers)
    markers = {"body": [], "far": []}
    for face in faces.values():
        inner = all(2 <= c <= 4 for node in face for c in places[node])
        markers["body" if inner else "far"].append(face)
    lines = ["NDIME= 3", f"NELEM= {len(cells)}", *(" ".join(map(str, [12, *cell])) for cell in cells),
             f"NPOIN= {len(places)}", *(" ".join(str(c - 3) for c in place) for place in places), "NMARK= 2"]
    for name, quads in markers.items():
        lines += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(quads)}",
                  *(" ".join(map(str, [9, *quad])) for quad in quads)]
    path.write_text("\n".join(lines) + "\n")


def meshes(folder, own):
    """Path of each mesh of CASES that is there or can be made."""
    hexahedra(own / "hexahedra.su2")
    (own / "ellipsoid.geo").write_text(ELLIPSOID)
    subprocess.run(["gmsh", "-3", "-format", "msh2", own / "ellipsoid.geo", "-o", own / "ellipsoid.msh"],
                   check=True, stdout=subprocess.DEVNULL)
    known = {name: folder / name for name in ("naca.su2", "multi.su2", "sphere.su2")}
    known.update({name: own / name for name in ("hexahedra.su2", "ellipsoid.msh")})
    known["quads.su2"] = HERE.parent / "assets" / "quads.su2"
    return {name: path for name, path in known.items() if path.exists()}


def mean_sine(path):
    """Mean of the elements' smallest sines, of a plane mesh (the report has the mean of all corners)."""
    lines = iter(path.read_text().splitlines())
    for line in lines:
        key, _, count = line.partition("=")
        if key == "NELEM":
            elements = [[int(word) for word in next(lines).split()] for _ in range(int(count))]
        elif key == "NPOIN":
            places = [complex(*map(float, next(lines).split()[:2])) for _ in range(int(count.split()[0]))]
    smallest = []
    for kind, *rest in elements:
        nodes = [places[k] for k in rest[:{5: 3, 9: 4}[kind]]]
        edges = [after - node for node, after in zip(nodes, [*nodes[1:], nodes[0]])]
        smallest.append(min((before.conjugate() * edge).imag / abs(before) / abs(edge)
                            for before, edge in zip([edges[-1], *edges], edges)))
    return sum(smallest) / len(smallest)


def measured(winslow, mesh, options, targets, own):
    """Row of the table without its title. A motion that did not reach its end has no figures."""
    report, out = own / "report.json", own / "out.su2"
    report.unlink(missing_ok=True)
    done = subprocess.run([winslow, "move", mesh, "-o", out, *options, "--targets", *targets.split(),
                           "--report", report, "--quiet"], capture_output=True, text=True, check=False)
    row = {"targets": targets, "status": done.returncode}
    if done.returncode == 0:
        found = json.loads(report.read_text())
        before, after = (found[when]["normalized_jacobian"] for when in ("quality_before", "quality"))
        mean = after["avg"] if "--axis" in options else mean_sine(out)
        row |= {"worst": round(after["min"], 4), "mean": round(mean, 4),
                "ratio": round(found["quality"]["aspect_ratio"]["max"], 2), "solves": found["linear_solves"],
                "given_worst": round(before["min"], 4)}
    return row


def run(winslow, folder):
    rows = {(row["case"], row["targets"]): row for row in read()} if TABLE.exists() else {}
    with tempfile.TemporaryDirectory() as name:
        own = Path(name)
        paths = meshes(folder, own)
        for title, (mesh, options) in CASES.items():
            for targets in TARGETS if mesh in paths else []:
                row = measured(winslow, paths[mesh], options, targets, own)
                rows[title, targets] = {"case": title, **row}
                print(rows[title, targets], flush=True)
    fields = ["case", "targets", "status", "worst", "mean", "ratio", "solves", "given_worst"]
    with TABLE.open("w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, fields, restval="", lineterminator="\n")
        table.writeheader()
        table.writerows(rows[title, targets] for title in CASES for targets in TARGETS if (title, targets) in rows)


def read():
    with TABLE.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


LOOKS = {"keep": ("*", "#c8102e", 190), "element": ("s", "#1f5fa8", 42), "auto": ("D", "#2a8f3c", 34),
         "rest": ("^", "#e08214", 48)}  # marker, colour, size
LEAST_SPAN = 0.03  # of the means that a panel shows, so that small differences look small


def draw_case(axis, title, rows):
    """rows: of this motion, those that reached its end."""
    found = {row["targets"]: (float(row["mean"]), float(row["worst"])) for row in rows}
    axis.axhline(float(rows[0]["given_worst"]), color="0.55", lw=1, ls="--", label="worst element as given")
    line = [found[targets] for targets in ("rest", *BLENDS, "element") if targets in found]
    axis.plot(*zip(*line), color="0.6", lw=1, marker="o", ms=3.5, zorder=1, label="blends of rest and element")
    for _, worst, mean in CONSTANTS.get(title, []):
        axis.scatter(mean, worst, 40, facecolors="none", edgecolors=LOOKS["keep"][1], zorder=4,
                     label="keep with other constants")
    for name, (marker, color, size) in LOOKS.items():
        if name in found:
            axis.scatter(*found[name], size, marker=marker, color=color, zorder=5 if name == "keep" else 3,
                         label=name, edgecolors="white", linewidths=0.6)
    measure = "scaled Jacobian" if "--axis" in CASES[title][1] else "sine"
    axis.set(title=title, xlabel=f"mean of the elements' {measure} [-]", ylabel=f"smallest {measure} [-]")
    axis.set_ylim(0, axis.get_ylim()[1] * 1.06)
    axis.margins(x=0.12)
    low, high = axis.get_xlim()
    wider = max(0, LEAST_SPAN - (high - low)) / 2
    axis.set_xlim(low - wider, high + wider)
    axis.grid(color="0.92")
    axis.set_axisbelow(True)


def draw():
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot, ticker

    pyplot.rcParams.update({"font.family": "DejaVu Sans", "font.size": 9, "axes.titlesize": 9.5})
    figure, axes = pyplot.subplots(3, 3, figsize=(10.5, 9.4))
    table, entries = read(), {}
    for axis, title in zip(axes.flat, CASES):
        rows = [row for row in table if row["case"] == title and row["worst"]]
        if not rows:
            axis.set_axis_off()
            continue
        draw_case(axis, title, rows)
        axis.xaxis.set_major_locator(ticker.MaxNLocator(5))
        for handle, label in zip(*axis.get_legend_handles_labels()):
            entries.setdefault(label, handle)
    figure.legend(entries.values(), entries.keys(), loc="lower center", ncol=4, frameon=False,
                  title="up: better worst element; right: better mean")
    figure.tight_layout(rect=(0, 0.085, 1, 1))
    figure.savefig(PICTURE, dpi=100)


def main():
    if len(sys.argv) == 3:
        run(str(Path(sys.argv[1]).resolve()), Path(sys.argv[2]))
    elif len(sys.argv) != 1:
        sys.exit(__doc__)
    draw()


main()

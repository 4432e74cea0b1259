#!/usr/bin/python3
"""Layers around many bodies: python3 layers.py PATH/TO/winslow [--seed S] [--only NAME] [--keep DIR]

Every insertion must end valid, with the first height within 5 % over 98 % of the columns, or be
refused with a reason. What is written is checked without the program, as a flow solver would:
positive volumes, boundary nodes and edges where they were, every boundary edge in one marker,
element faces that close around every element; meshio and Gmsh read it, too.
"""
import argparse
import collections
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from winslow_cases import PYTHON, ROOT, count_inverted, read_elements, read_nodes, run

SPACING = ["--count", 20, "--first", 5e-5, "--ratio", 1.25, "--growth", 1]


def read_marker_edges(path):
    """Marker name: list of node pairs, of an SU2 file."""
    markers, name, left = {}, None, 0
    for line in Path(path).read_text().splitlines():
        if line.startswith("MARKER_TAG"):
            name = line.split("=")[1].strip()
            markers[name] = []
        elif line.startswith("MARKER_ELEMS"):
            left = int(line.split("=")[1])
        elif left and name is not None and line.strip():
            markers[name].append(tuple(map(int, line.split()[1:3])))
            left -= 1
    return markers


def flow_solvers_view(before, after, walls):
    """What is wrong with a mesh with layers, compared with the one without; empty if nothing."""
    if count_inverted(after):
        return f"{count_inverted(after)} inverted elements"
    old, new = read_nodes(before), read_nodes(after)
    if old != new[:len(old)] and any(old[n] != new[n] for edges in read_marker_edges(before).values()
                                     for edge in edges for n in edge):
        return "a node of the old boundary has moved"
    elements = read_elements(after)
    uses = collections.Counter()
    for element in elements:
        for a, b in zip(element, element[1:] + element[:1]):
            if (a, b) in uses:
                return f"two elements have face {(a, b)} on the same side"
            uses[a, b] += 1
        # Face normals of a closed cell sum to nothing.
        sx = sum(new[b][1] - new[a][1] for a, b in zip(element, element[1:] + element[:1]))
        sy = sum(new[a][0] - new[b][0] for a, b in zip(element, element[1:] + element[:1]))
        if abs(sx) + abs(sy) > 1e-9:
            return "faces of an element do not close"
    boundary = {frozenset(face) for face in uses if face[::-1] not in uses}
    marked = collections.Counter(frozenset(edge) for edges in read_marker_edges(after).values()
                                 for edge in edges)
    if set(marked) != boundary or max(marked.values()) > 1:
        return "the markers do not cover the boundary once"
    for wall in walls:
        if read_marker_edges(before)[wall] != read_marker_edges(after)[wall]:
            return f"the edges of wall {wall} have changed"
    area = lambda nodes, cells: sum(
        nodes[a][0] * nodes[b][1] - nodes[b][0] * nodes[a][1]
        for cell in cells for a, b in zip(cell, cell[1:] + cell[:1])) / 2
    whole = area(old, read_elements(before))
    if abs(area(new, elements) - whole) > 1e-9 * abs(whole):
        return "the elements do not fill the domain"
    return ""


def other_readers(winslow, mesh, folder):
    """What meshio and Gmsh say of the mesh, where they are installed; empty if nothing."""
    msh = folder / "other.msh"
    done = run(winslow, ["convert", mesh, msh, "--quiet"])
    if done.returncode:
        return f"convert: {done.stderr}"
    cells = len(read_elements(mesh))
    try:
        import meshio
        read = meshio.read(msh, file_format="gmsh")
        found = sum(len(block.data) for block in read.cells if block.type in ("triangle", "quad"))
        if found != cells:
            return f"meshio reads {found} cells of {cells}"
    except ImportError:
        pass
    if shutil.which("gmsh"):
        done = subprocess.run(["gmsh", msh, "-0", "-v", "3"], capture_output=True, text=True,
                              check=False)
        if done.returncode or "Error" in done.stdout + done.stderr:
            return f"Gmsh: {done.stdout[-300:]}{done.stderr[-300:]}"
    return ""


def first_heights(report):
    """Share of the columns with layers whose first height is within 5 %, from the report."""
    return report["layers"]["first_height_within"]["0.05"]


def insert(winslow, folder, mesh, walls, spacing):
    out, report = folder / "layers.su2", folder / "layers.json"
    for path in (out, report):
        path.unlink(missing_ok=True)
    markers = [x for wall in walls for x in ("--marker", wall)]
    done = run(winslow, ["layers", mesh, "-o", out, *markers, *spacing, "--report", report,
                         "--quiet"])
    return done, json.loads(report.read_text()) if report.exists() else None, out


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("winslow", type=Path)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--keep", type=Path)
    options = parser.parse_args()
    winslow = options.winslow.resolve()
    valid, refused, wrong = 0, [], []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([PYTHON, ROOT / "tests/meshes/make_bodies.py", folder, "--seed",
                        str(options.seed)], check=True)
        bodies = json.loads((folder / "bodies.json").read_text())["bodies"]
        bodies = [b for b in bodies if options.only in b["name"]]
        for body in bodies:
            mesh = folder / body["file"]
            done, report, out = insert(winslow, folder, mesh, body["walls"], SPACING)
            if done.returncode in (2, 5) and not out.exists() and done.stderr.strip():
                refused.append(body["name"])
                print(f"{body['name']}: refused: {done.stderr.strip()}", flush=True)
                continue
            fault = f"status {done.returncode}: {done.stderr.strip()}" if done.returncode else ""
            fault = fault or flow_solvers_view(mesh, out, body["walls"])
            fault = fault or other_readers(winslow, out, folder)
            if not fault and first_heights(report) < 0.98:
                fault = f"first height within 5 % in {100 * first_heights(report):.1f} % of columns"
            layers = report["layers"] if report else {}
            print(f"{body['name']}: " + (f"WRONG: {fault}" if fault else "valid") +
                  (f"; {layers['columns']} columns, {len(layers['cut_short'])} cut short, first height "
                   f"off by {100 * layers['first_height_error']['max']:.2g} % at most, smallest sine "
                   f"{report['quality']['normalized_jacobian']['min']:.3f}, {report['linear_solves']} "
                   f"solves, {report['seconds']['solve']:.1f} s" if layers else ""), flush=True)
            valid += not fault
            if fault:
                wrong.append(body["name"])
            if options.keep and out.exists():
                options.keep.mkdir(parents=True, exist_ok=True)
                shutil.copy(out, options.keep / body["file"])
    print(f"{valid} of {len(bodies)} valid, refused: {', '.join(refused) or 'none'}; wrong: "
          f"{', '.join(wrong) or 'none'}")
    return 1 if wrong or valid < 0.95 * len(bodies) else 0


if __name__ == "__main__":
    sys.exit(main())

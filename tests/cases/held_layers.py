#!/usr/bin/python3
"""Turns the body of each mesh by 15 degrees about its centre, with and without --hold-layers, and
measures the files by itself: what --hold-layers finds, and what becomes of heights and angles.

    tests/cases/held_layers.py WINSLOW MESH.su2 ... [--angle 15] [--shift 0.05] [--table OUT.json]

Meshes without an inner boundary are passed over. Needs numpy. Heights are those of the elements at the
wall (area over the length of the wall edge, a triangle's twice), and of every row of the stack: the
shortest edge from each node to the row below, as many rows above a wall node as the report says were
found there. Both are ratios, after over before. Sines are those of all corners.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "meshes"))
import debian_python  # noqa: E402

debian_python.take_over()
import numpy as np  # noqa: E402


def read_su2(path):
    """Points (n by 2), elements (tuples of node numbers), markers (name to list of edges)."""
    lines = [line.split("%")[0].split() for line in open(path, errors="replace")]
    lines = [line for line in lines if line]
    points, elements, markers, i, tag = [], [], {}, 0, None
    while i < len(lines):
        key = " ".join(lines[i])
        i += 1
        if "=" not in key:
            continue
        name, value = (part.strip() for part in key.split("=", 1))
        if name == "NELEM":
            for line in lines[i:i + int(value)]:
                elements.append(tuple(int(v) for v in line[1:4 + (line[0] == "9")]))
                if line[0] not in ("5", "9"):
                    raise ValueError(f"an element of type {line[0]}")
            i += int(value)
        elif name == "NPOIN":
            count = int(value.split()[0])
            points = [[float(line[0]), float(line[1])] for line in lines[i:i + count]]
            i += count
        elif name == "MARKER_TAG":
            tag = value
        elif name == "MARKER_ELEMS" and not (i < len(lines) and lines[i][0].startswith("SEND")):
            if tag is None:
                raise ValueError("a marker without a name")
            markers[tag] = [tuple(int(v) for v in line[1:3]) for line in lines[i:i + int(value)]]
            i += int(value)
    points = np.array(points)
    for k, e in enumerate(elements):  # some files list them clockwise
        x, y = points[list(e)].T
        if (x * np.roll(y, -1) - y * np.roll(x, -1)).sum() < 0:
            elements[k] = e[::-1]
    return points, elements, markers


def boundary_loops(elements):
    """Closed runs of nodes along the sides that one element alone has, elements on the left."""
    sides = {}
    for e in elements:
        for a, b in zip(e, e[1:] + e[:1]):
            sides[a, b] = True
    following = {}
    for a, b in sides:
        if (b, a) not in sides:
            following.setdefault(a, []).append(b)
    loops = []
    while following:
        start = at = next(iter(following))
        loop = []
        while at in following:
            loop.append(at)
            choices = following[at]
            at = choices.pop()
            if not choices:
                del following[loop[-1]]
            if at == start:
                break
        loops.append(loop)
    return loops


def body_of(points, elements, markers):
    """Names of the markers of the inner boundary with the most edges, and its centre; or None."""
    loops = boundary_loops(elements)
    box = [np.ptp(points[loop], axis=0).prod() for loop in loops]
    outer = int(np.argmax(box))
    inner = [set(loop) for k, loop in enumerate(loops) if k != outer]
    if not inner:
        return None
    body = max(inner, key=len)
    names = [m for m, edges in markers.items() if edges and all(n in body for e in edges for n in e)]
    if not names:  # one marker for several bodies
        everything = set().union(*inner)
        names = [m for m, edges in markers.items()
                 if edges and all(n in everything for e in edges for n in e)]
        names = [m for m in names if any(n in body for e in markers[m] for n in e)]
    if not names:
        return None
    edges = np.array([e for m in names for e in markers[m]])
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    centre = (lengths[:, None] * points[edges].mean(axis=1)).sum(axis=0) / lengths.sum()
    return names, centre, edges, np.ptp(points[np.unique(edges)], axis=0).max()


def sines(points, elements):
    """Smallest sine of each element's corners; negative: inverted."""
    smallest = np.empty(len(elements))
    for corners in (3, 4):
        of = [k for k, e in enumerate(elements) if len(e) == corners]
        if not of:
            continue
        nodes = np.array([elements[k] for k in of])
        values = []
        for k in range(corners):
            u = points[nodes[:, (k + 1) % corners]] - points[nodes[:, k]]
            v = points[nodes[:, (k - 1) % corners]] - points[nodes[:, k]]
            cross = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
            values.append(cross / (np.linalg.norm(u, axis=1) * np.linalg.norm(v, axis=1)))
        smallest[of] = np.min(values, axis=0)
    return smallest


def wall_elements(elements, edges):
    wanted = {frozenset(e) for e in edges.tolist()}
    found = {}
    for k, e in enumerate(elements):
        for a, b in zip(e, e[1:] + e[:1]):
            if frozenset((a, b)) in wanted:
                found[frozenset((a, b))] = k
    return found


def first_heights(points, elements, at_wall):
    heights = []
    for edge, k in at_wall.items():
        nodes = points[list(elements[k])]
        x, y = nodes[:, 0], nodes[:, 1]
        area = 0.5 * (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()
        a, b = edge
        heights.append(area * (2 if len(nodes) == 3 else 1) / np.linalg.norm(points[a] - points[b]))
    return np.array(heights)


def columns_of(points, elements, edges, rows):
    """Edges (n by 2, lower node first) of the rows above each wall node, as many as `rows` says (wall
    node to number): from every node to the row below the shortest edge, rows counted in edges from the
    wall. Only where the edge is less than half as long as the longest of its node."""
    neighbours = {}
    for e in elements:
        for a, b in zip(e, e[1:] + e[:1]):
            neighbours.setdefault(a, set()).add(b)
            neighbours.setdefault(b, set()).add(a)
    level = {n: 0 for n in np.unique(edges).tolist()}
    wall = {n: n for n in level}
    front, found = list(level), []
    for row in range(1, max(rows.values(), default=0) + 1):
        above = {n for f in front for n in neighbours[f] if n not in level}
        for n in above:
            below = [b for b in neighbours[n] if level.get(b) == row - 1]
            lengths = {b: np.linalg.norm(points[b] - points[n]) for b in neighbours[n]}
            best = min(below, key=lengths.get)
            wall[n] = wall[best]
            if row <= rows.get(wall[n], 0) and lengths[best] < 0.5 * max(lengths.values()):
                found.append((best, n))
        level.update({n: row for n in above})
        front = above
    return np.array(found, dtype=int).reshape(-1, 2)


def percentile(values):
    return (100 * float(np.percentile(values, 95)), 100 * float(values.max())) if len(values) else (0, 0)


def measure(before, after, elements, at_wall, columns):
    s0, s1 = sines(before, elements), sines(after, elements)
    first = np.abs(first_heights(after, elements, at_wall) / first_heights(before, elements, at_wall) - 1)
    length = lambda x: np.linalg.norm(x[columns[:, 1]] - x[columns[:, 0]], axis=1)
    rows = np.abs(length(after) / length(before) - 1) if len(columns) else np.zeros(0)
    return {"sine_before": float(s0.min()), "sine": float(s1.min()), "mean": float(s1.mean()),
            "inverted": int((s1 <= 0).sum()), "first": percentile(first), "rows": percentile(rows)}


def run(winslow, mesh, out, arguments, report, limit):
    spent = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([winslow, "move", mesh, "-o", out, "--report", report, *arguments],
                          capture_output=True, text=True, timeout=limit)
    now = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = now.ru_utime + now.ru_stime - spent.ru_utime - spent.ru_stime
    return done, cpu


def study(winslow, mesh, options):
    points, elements, markers = read_su2(mesh)
    body = body_of(points, elements, markers)
    if body is None:
        return None
    names, centre, edges, size = body
    at_wall = wall_elements(elements, edges)
    result = {"mesh": Path(mesh).stem, "nodes": len(points), "markers": names}
    motion = [a for n in names for a in ("--marker", n)]
    motion += ["--rotate", str(options.angle), "--pivot", repr(centre[0]), repr(centre[1])]
    if options.shift:
        motion += ["--translate", str(options.shift * size), "0"]
    stack = None
    with tempfile.TemporaryDirectory() as folder:
        out, report = os.path.join(folder, "out.su2"), os.path.join(folder, "report.json")
        for key in ("hold", "plain"):
            hold = [a for n in names for a in ("--hold-layers", n)] if key == "hold" else []
            try:
                done, cpu = run(winslow, mesh, out, motion + hold, report, options.limit)
            except subprocess.TimeoutExpired:
                result[key] = {"fault": "more time than the limit"}
                continue
            if done.returncode != 0:
                result[key] = {"fault": f"{done.returncode}: " + done.stderr.strip()[-200:]}
                continue
            told = json.load(open(report))
            stack = told.get("layers", stack)
            rows = {}
            for column in (stack or {}).get("found", []):  # a node may have several
                rows[column["node"]] = min(rows.get(column["node"], 1000), column["rows"])
            columns = columns_of(points, elements, edges, rows)
            moved = read_su2(out)[0]
            result[key] = measure(points, moved, elements, at_wall, columns)
            result[key].update(solves=told["linear_solves"], cpu=cpu, converged=told["converged"])
            if key == "hold":
                result["said"] = [line for line in done.stdout.splitlines() if line.startswith("Layers")]
                result["layers"] = {k: stack.get(k) for k in ("columns", "columns_with_layers", "count",
                                                             "rows", "total_thickness", "ends")}
    return result


def line_of(r):
    text = f"{r['mesh'][:34]:34s} {r['nodes']:6d}"
    for key in ("plain", "hold"):
        v = r[key]
        if "fault" in v:
            text += " | " + v["fault"].replace("\n", " ")[:100]
            continue
        text += (f" | {v['sine_before']:.3f} {v['sine']:.3f} {v['inverted']:2d} {v['first'][0]:6.2f} {v['first'][1]:6.2f}"
                 f" {v['rows'][0]:6.2f} {v['rows'][1]:6.2f} {v['solves']:3d} {v['cpu']:5.1f}")
    if "layers" in r:
        thick = r["layers"]["total_thickness"]
        text += (f" | {r['layers']['columns']} cols, {r['layers']['rows']:.1f} rows,"
                 f" {thick['min']:.3g}..{thick['max']:.3g} {r['layers'].get('ends') or ''}")
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("winslow")
    parser.add_argument("meshes", nargs="+")
    parser.add_argument("--angle", type=float, default=15)
    parser.add_argument("--shift", type=float, default=0, help="in lengths of the body")
    parser.add_argument("--limit", type=float, default=600, help="seconds for one run")
    parser.add_argument("--table", help="JSON file with all figures")
    options = parser.parse_args()
    print("mesh, nodes | without: sine before, after, inverted, first heights off by % (95 %, worst),"
          " all rows (the same), solves, CPU s | with --hold-layers | found")
    results = []
    for mesh in options.meshes:
        try:
            result = study(options.winslow, mesh, options)
        except ValueError as error:
            print(f"{Path(mesh).stem}: {error}", file=sys.stderr)
            continue
        if result:
            results.append(result)
            print(line_of(result), flush=True)
    if options.table:
        Path(options.table).write_text(json.dumps(results, indent=1))


if __name__ == "__main__":
    main()

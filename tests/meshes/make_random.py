#!/usr/bin/python3
"""Makes random test meshes.

python3 make_random.py OUT_FOLDER [--count N] [--seed S] [--max-rotation DEG]
                                  [--max-holes H]

Needs numpy and the gmsh program. Mesh k is drawn from seed S + k alone: an outer polygon (convex or
not) with one to H (default 3) holes (polygons or ellipses), meshed with triangles, recombined
quadrilaterals, or both (quadrilaterals in a disc around the first hole), and written as .su2, .msh
(4.1) or .msh (2.2) with the markers `outer`, `hole1`, `hole2`, ...  OUT_FOLDER/meshes.json lists
for each mesh

    {"file", "seed", "elements", "nodes",
     "motions": [{"marker", "rotate" (degrees), "pivot", "translate"}]}

Motions keep the moved hole clear of every other boundary: the disc that the hole sweeps when it
turns about its centre stays inside the free space all along the straight path.
"""
import argparse
import json
import subprocess
from pathlib import Path

import debian_python

debian_python.take_over()
import numpy as np  # noqa: E402

KINDS = ("triangles", "quads", "mixed")
FORMATS = ((".su2", "su2"), (".msh", "msh41"), (".msh", "msh22"))
# Thinnest free space, and so the finest boundary, against the size of the domain (about 2).
CLEARANCE = 0.12


def star_polygon(rng, corners, low, high):
    """A polygon that its centre (0, 0) sees whole, counter-clockwise; radii in [low, high]."""
    gaps = rng.uniform(0.6, 1.4, corners)
    angles = np.cumsum(gaps / gaps.sum()) * 2 * np.pi
    radii = rng.uniform(low, high, corners)
    return np.stack([radii * np.cos(angles), radii * np.sin(angles)], 1)


def convex_polygon(rng, corners, radius):
    """Corners on an ellipse."""
    gaps = rng.uniform(0.6, 1.4, corners)
    angles = np.cumsum(gaps / gaps.sum()) * 2 * np.pi
    b = radius * rng.uniform(0.7, 1.0)
    return np.stack([radius * np.cos(angles), b * np.sin(angles)], 1)


def ellipse(rng, radius):
    t = 2 * np.pi * np.arange(48) / 48
    b = radius * rng.uniform(0.35, 1.0)
    turn = rng.uniform(0, np.pi)
    x, y = radius * np.cos(t), b * np.sin(t)
    return np.stack([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)], 1)


def distance_to_loop(point, loop):
    """From a point to a closed polyline."""
    a, b = loop, np.roll(loop, -1, 0)
    d = b - a
    t = np.clip(np.sum((point - a) * d, 1) / np.sum(d * d, 1), 0, 1)
    return float(np.min(np.hypot(*(a + t[:, None] * d - point).T)))


def inside(point, loop):
    x, y = point
    a, b = loop, np.roll(loop, -1, 0)
    crosses = (a[:, 1] > y) != (b[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        at = a[:, 0] + (y - a[:, 1]) / (b[:, 1] - a[:, 1]) * (b[:, 0] - a[:, 0])
    return bool(np.count_nonzero(crosses & (at > x)) % 2)


def draw_holes(rng, outer, most):
    """One to `most` holes, as far as there is room, as (centre, radius of the disc around it, loop)."""
    holes, wanted = [], int(rng.integers(1, most + 1))
    for _ in range(400):
        if len(holes) == wanted:
            break
        centre = rng.uniform(-0.8, 0.8, 2)
        if not inside(centre, outer):
            continue
        room = distance_to_loop(centre, outer)
        room = min([room] + [float(np.hypot(*(centre - c))) - r for c, r, _ in holes])
        if room < 2.2 * CLEARANCE:
            continue
        radius = rng.uniform(0.35, 0.75) * min(room, 0.7)
        shape = rng.integers(3)
        if shape == 0:
            loop = ellipse(rng, radius)
        elif shape == 1:
            loop = convex_polygon(rng, int(rng.integers(3, 8)), radius)
        else:
            loop = star_polygon(rng, int(rng.integers(4, 9)), 0.5 * radius, radius)
        holes.append((centre, radius, centre + loop))
    return holes


def clearance(k, outer, holes):
    """Free width of the ring around the disc of hole k."""
    centre, radius, _ = holes[k]
    others = [float(np.hypot(*(centre - c))) - r for j, (c, r, _) in enumerate(holes) if j != k]
    return min([distance_to_loop(centre, outer)] + others) - radius


def loop_lines(loop, last):
    n = len(loop)
    return ([f"Point({last + k + 1}) = {{{x:.17g}, {y:.17g}, 0}};" for k, (x, y) in enumerate(loop)]
            + [f"Line({last + k + 1}) = {{{last + k + 1}, {last + (k + 1) % n + 1}}};"
               for k in range(n)])


def geo_text(outer, holes, kind, size, shares):
    """.geo of the domain: spacing `size` at most; `shares` are the spacing at the holes, as a
    share of it, and its growth from them. Mixed meshes have quadrilaterals in a disc around the
    first hole only."""
    lines, loops, last = [], [], 0
    for loop in [outer] + [h[2] for h in holes]:
        lines += loop_lines(loop, last)
        loops.append((last + 1, last + len(loop)))
        last += len(loop)
    for k, (a, b) in enumerate(loops, 1):
        name = "outer" if k == 1 else f"hole{k - 1}"
        lines += [f"Curve Loop({k}) = {{{a}:{b}}};",
                  f'Physical Curve("{name}", {k}) = {{{a}:{b}}};']
    first_hole, holes_end = loops[1][0], last
    if kind == "mixed":
        centre, radius, _ = holes[0]
        t = 2 * np.pi * np.arange(32) / 32
        ring = radius + 0.5 * clearance(0, outer, holes)
        lines += loop_lines(centre + ring * np.stack([np.cos(t), np.sin(t)], 1), last)
        lines.append(f"Curve Loop(90) = {{{last + 1}:{last + 32}}};")
        rest = ", ".join(map(str, [1, 90] + list(range(3, len(loops) + 1))))
        lines += ["Plane Surface(1) = {90, 2};", f"Plane Surface(2) = {{{rest}}};",
                  'Physical Surface("domain", 100) = {1, 2};']
    else:
        lines += [f"Plane Surface(1) = {{1:{len(loops)}}};",
                  'Physical Surface("domain", 100) = {1};']
    if kind != "triangles":
        lines.append("Recombine Surface {1};")
    lines += ["Field[1] = Distance;", f"Field[1].EdgesList = {{{first_hole}:{holes_end}}};",
              "Field[1].NNodesByEdge = 30;", "Field[2] = MathEval;",
              f'Field[2].F = "{shares[0] * size:.17g} + {shares[1]:.17g} * F1";',
              "Background Field = 2;", "Mesh.CharacteristicLengthFromPoints = 0;",
              "Mesh.CharacteristicLengthExtendFromBoundary = 0;",
              f"Mesh.CharacteristicLengthMax = {size:.17g};", "Mesh.Algorithm = 6;",
              "General.NumThreads = 1;"]
    return "\n".join(lines) + "\n"


def count_nodes(path):
    """Nodes of an SU2 or MSH file (the counts gmsh wrote)."""
    lines = path.read_text().splitlines()
    for k, line in enumerate(lines):
        if line.startswith("NPOIN="):
            return int(line.split("=")[1].split()[0])
        if line == "$Nodes":
            count = lines[k + 1].split()
            return int(count[1] if len(count) > 1 else count[0])
    raise RuntimeError(f"{path}: no node count")


def mesh_it(folder, name, geo, suffix, kind, dimension=2):
    geo_path, out = folder / f"{name}.geo", folder / f"{name}{suffix}"
    geo_path.write_text(geo)
    done = subprocess.run(["gmsh", f"-{dimension}", str(geo_path), "-format", kind, "-o", str(out), "-v", "1"],
                          capture_output=True, text=True)
    if done.returncode != 0 or not out.exists():
        raise RuntimeError(f"gmsh failed on {geo_path}:\n{done.stdout}{done.stderr}")
    return out


def draw_motion(rng, outer, holes, max_rotation):
    k = int(rng.integers(len(holes)))
    angle, way = rng.uniform(-1, 1) * max_rotation, rng.uniform(0, 2 * np.pi)
    step = 0.4 * rng.uniform(0.2, 1.0) * clearance(k, outer, holes)
    return {"marker": f"hole{k + 1}", "rotate": float(angle),
            "pivot": [float(c) for c in holes[k][0]],
            "translate": [float(step * np.cos(way)), float(step * np.sin(way))]}


def make(folder, index, seed, max_rotation, max_holes):
    rng = np.random.default_rng(seed)
    holes = []
    while not holes:
        if rng.random() < 0.5:
            outer = convex_polygon(rng, int(rng.integers(4, 9)), 1.0)
        else:
            outer = star_polygon(rng, int(rng.integers(5, 10)), 0.7, 1.0)
        holes = draw_holes(rng, outer, max_holes)
    kind = KINDS[index % len(KINDS)]
    suffix, fmt = FORMATS[index // len(KINDS) % len(FORMATS)]
    target, shares = rng.uniform(800, 4000), (rng.uniform(0.25, 0.6), rng.uniform(0.06, 0.15))
    motions = [draw_motion(rng, outer, holes, max_rotation) for _ in range(2)]
    size = 1.5 / np.sqrt(target)
    name = f"random{index:02d}"
    for _ in range(6):
        out = mesh_it(folder, name, geo_text(outer, holes, kind, size, shares), suffix, fmt)
        nodes = count_nodes(out)
        if 500 <= nodes <= 5000:
            break
        size *= np.sqrt(nodes / target)
    else:
        raise RuntimeError(f"seed {seed}: {nodes} nodes, wanted 500 to 5000")
    print(f"{out.name}: seed {seed}, {kind}, {len(holes)} holes, {nodes} nodes")
    return {"file": out.name, "seed": seed, "elements": kind, "nodes": nodes, "motions": motions}


def main():
    parser = argparse.ArgumentParser(description="Makes random test meshes with gmsh.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--max-rotation", type=float, default=120.0, help="degrees, either way")
    parser.add_argument("--max-holes", type=int, default=3)
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    made = [make(args.folder, k, args.seed + k, args.max_rotation, args.max_holes)
            for k in range(args.count)]
    (args.folder / "meshes.json").write_text(json.dumps({"meshes": made}, indent=2) + "\n")


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""Makes random volume meshes.

python3 make_random_volumes.py OUT_FOLDER [--count N] [--seed S] [--max-rotation DEG] [--max-bodies B]

Needs numpy and the gmsh program. Mesh k is drawn from seed S + k alone, and is one of

    tetrahedra   a box less one to B bodies (spheres, tori, boxes, cylinders, cones, prisms over stars), meshed by Gmsh
    prisms       a mesh of triangles of make_random.py's kind, extruded, with a body of finite height
    hexahedra    over each hole; the same of recombined quadrilaterals;
    mixed        quadrilaterals with triangles under and over the bodies, and some of the cells
                 split about their centres into pyramids and tetrahedra.
                 Extruded meshes are bent a little, so that no face of four nodes is flat

Tetrahedra are written as .su2, .msh (4.1) or .msh (2.2), the others as .su2. Markers: `body1`, `body2`, ...,
and `outer`, of extruded meshes `side`, `floor` and `ceiling`. OUT_FOLDER/meshes.json lists for each mesh

    {"file", "seed", "elements", "nodes",
     "motions": [{"marker", "rotate" (degrees), "axis", "pivot", "translate"}]}

Motions keep the moved body clear of every other boundary: the ball around it, which it does not leave when it
turns about its centre, stays inside the free space all along the straight path. Every gap is two or three
cells wide.
"""
import argparse
import json
from pathlib import Path

import debian_python

debian_python.take_over()
import numpy as np  # noqa: E402
from extrusion import extruded, split_about_centres, write_su2  # noqa: E402
from make_random import (FORMATS, clearance, convex_polygon, count_nodes, distance_to_loop, draw_holes, loop_lines,
                         mesh_it, star_polygon)

KINDS = ("tetrahedra", "prisms", "hexahedra", "mixed")
FEWEST, MOST = 500, 9000  # nodes
BOX = 1.2                 # half the edge of a box around a ball: Gmsh's own boxes around surfaces are not tight
CLEARANCE = 0.15          # of a body that moves, against a domain about 2 wide


def direction(rng):
    v = rng.normal(size=3)
    return v / np.linalg.norm(v)


def draw_motion(rng, name, centre, room, max_rotation):
    step = 0.4 * rng.uniform(0.2, 1.0) * room
    return {"marker": name, "rotate": float(rng.uniform(-1, 1) * max_rotation),
            "axis": direction(rng).tolist(), "pivot": np.asarray(centre).tolist(),
            "translate": (step * direction(rng)).tolist()}


# Tetrahedra: a box less bodies, each within a ball (centre, radius).

def draw_balls(rng, half, most):
    """One to `most` balls in the box, as far as there is room."""
    balls, wanted = [], int(rng.integers(1, most + 1))
    for _ in range(400):
        if len(balls) == wanted:
            break
        centre = rng.uniform(-0.8, 0.8, 3) * half
        room = min([float(np.min(half - np.abs(centre)))]
                   + [float(np.linalg.norm(centre - c)) - r for c, r in balls])
        radius = min(rng.uniform(0.35, 0.6) * room, 0.6)
        if room > 2.4 * CLEARANCE and not any(in_box_of((centre, radius), ball) for ball in balls):
            balls.append((centre, radius))
    return balls


def in_box_of(ball, other):
    """Whether one of two balls lies in the box by which Gmsh is to find the surfaces within the other."""
    (small, least), (large, most) = sorted((ball, other), key=lambda b: b[1])
    return np.max(np.abs(small - large)) + least < BOX * most


def room_of_ball(k, half, balls):
    centre, radius = balls[k]
    others = [float(np.linalg.norm(centre - c)) - r for j, (c, r) in enumerate(balls) if j != k]
    return min([float(np.min(half - np.abs(centre)))] + others) - radius


def numbers(*values):
    return ", ".join(f"{v:.17g}" for v in values)


def upright(centre_line, radius, *ends):
    """A cylinder or cone about the z axis that fits into the ball."""
    return f"{{0, 0, {numbers(-centre_line)}, 0, 0, {numbers(2 * centre_line)}, {numbers(radius, *ends)}}}"


def prism_over_star(rng, number, radius):
    loop = star_polygon(rng, int(rng.integers(4, 8)), 0.45 * radius, 0.8 * radius)
    first, n = 1000 * number, len(loop)
    return ([f"Point({first + k}) = {{{numbers(x, y, -0.5 * radius)}}};" for k, (x, y) in enumerate(loop)]
            + [f"Line({first + k}) = {{{first + k}, {first + (k + 1) % n}}};" for k in range(n)]
            + [f"Curve Loop({first}) = {{{first}:{first + n - 1}}};", f"Plane Surface({first}) = {{{first}}};",
               f"out[] = Extrude {{0, 0, {numbers(radius)}}} {{ Surface{{{first}}}; }};",
               f"body{number} = out[1];"])


def shape_lines(rng, number, radius):
    """A body within the ball about the origin: its volume is in the variable of that number."""
    a, b, c = rng.uniform(0.4, 1.0, 3)
    box, tube = (0.99 * radius / np.linalg.norm(v) for v in ((a, b, c), (a, c)))
    lines = [
        [f"Sphere({number}) = {{0, 0, 0, {numbers(radius)}}};"],
        [f"Torus({number}) = {{0, 0, 0, {numbers(0.65 * radius, 0.3 * radius)}}};"],
        [f"Box({number}) = {{{numbers(-a * box, -b * box, -c * box, 2 * a * box, 2 * b * box, 2 * c * box)}}};"],
        [f"Cylinder({number}) = {upright(c * tube, a * tube)};"],
        [f"Cone({number}) = {upright(c * tube, a * tube, 0.3 * a * tube)};"],
    ]
    which = int(rng.integers(len(lines) + 1))
    if which == len(lines):
        return prism_over_star(rng, number, radius)
    return lines[which] + [f"body{number} = {number};"]


def box_geo(rng, half, balls, size, shares):
    """.geo of a box less a body in each ball: spacing `size` at most; `shares` are the spacing at the
    bodies, as a share of it, and its growth from them."""
    lines = ['SetFactory("OpenCASCADE");',
             f"Box(1) = {{{numbers(*-half)}, {numbers(*(2 * half))}}};"]
    for k, (centre, radius) in enumerate(balls, 2):
        lines += shape_lines(rng, k, radius)
        lines += [f"Rotate {{{{{numbers(*direction(rng))}}}, {{0, 0, 0}}, {numbers(rng.uniform(0, 6.28))}}} "
                  f"{{ Volume{{body{k}}}; }}",
                  f"Translate {{{numbers(*centre)}}} {{ Volume{{body{k}}}; }}"]
    bodies = ", ".join(f"body{k}" for k in range(2, len(balls) + 2))
    lines += [f"BooleanDifference(1000) = {{ Volume{{1}}; Delete; }}{{ Volume{{{bodies}}}; Delete; }};",
              "outer[] = Abs(Boundary{ Volume{1000}; });"]
    for k, (centre, radius) in enumerate(balls, 1):
        around = numbers(*(centre - BOX * radius), *(centre + BOX * radius))
        lines += [f"s{k}[] = Surface In BoundingBox {{{around}}};", f"outer[] -= s{k}[];",
                  f'Physical Surface("body{k}", {k}) = {{s{k}[]}};']
        distance = "Sqrt(" + " + ".join(f"({a} - ({c:.17g}))^2" for a, c in zip("xyz", centre)) + f") - {radius:.17g}"
        lines += [f"Field[{k}] = MathEval;", f'Field[{k}].F = "{shares[0] * size:.17g} + {shares[1]:.17g} * '
                  f'(({distance}) + Fabs({distance})) / 2";']
    n = len(balls) + 1
    lines += [f"Field[{n}] = Min;", f"Field[{n}].FieldsList = {{1:{n - 1}}};", f"Background Field = {n};",
              'Physical Surface("outer", 100) = {outer[]};', 'Physical Volume("domain", 101) = {1000};',
              "Mesh.CharacteristicLengthFromPoints = 0;", "Mesh.CharacteristicLengthExtendFromBoundary = 0;",
              f"Mesh.CharacteristicLengthMax = {numbers(size)};", "General.NumThreads = 1;"]
    return "\n".join(lines) + "\n"


def make_box(folder, name, index, rng, max_rotation, most):
    half, balls = None, []
    while not balls:
        half = rng.uniform(0.7, 1.0, 3)
        balls = draw_balls(rng, half, most)
    suffix, fmt = FORMATS[index // len(KINDS) % len(FORMATS)]
    shares = (rng.uniform(0.3, 0.5), rng.uniform(0.1, 0.25))
    motions = []
    for _ in range(2):
        k = int(rng.integers(len(balls)))
        motions.append(draw_motion(rng, f"body{k + 1}", balls[k][0], room_of_ball(k, half, balls), max_rotation))
    seed = rng.integers(1 << 32)

    def build(size):
        geo = box_geo(np.random.default_rng(seed), half, balls, size, shares)
        return mesh_it(folder, name, geo, suffix, fmt, dimension=3)
    return build, motions


# Extruded meshes: over every hole of a plane domain a body, from one height to another.

def base_geo(outer, holes, kind, size):
    """.geo of a domain and of its holes, all meshed."""
    lines, last = [], 0
    for k, loop in enumerate([outer] + [h[2] for h in holes], 1):
        lines += loop_lines(loop, last) + [f"Curve Loop({k}) = {{{last + 1}:{last + len(loop)}}};"]
        last += len(loop)
    lines.append(f"Plane Surface(1) = {{1:{len(holes) + 1}}};")
    lines += [f"Plane Surface({k}) = {{{k}}};" for k in range(2, len(holes) + 2)]
    if kind != "prisms":
        lines.append("Recombine Surface {1};" if kind == "mixed" else f"Recombine Surface {{1:{len(holes) + 1}}};")
    lines += [f'Physical Surface("region{k - 1}", {k}) = {{{k}}};' for k in range(1, len(holes) + 2)]
    first_hole = len(outer) + 1
    lines += ["Field[1] = Distance;", f"Field[1].EdgesList = {{{first_hole}:{last}}};",
              "Field[1].NNodesByEdge = 30;", "Field[2] = MathEval;",
              f'Field[2].F = "{numbers(0.4 * size)} + 0.4 * F1";', "Background Field = 2;",
              "Mesh.CharacteristicLengthFromPoints = 0;",
              "Mesh.CharacteristicLengthExtendFromBoundary = 0;",
              f"Mesh.CharacteristicLengthMax = {numbers(size)};", "Mesh.Algorithm = 6;",
              "Mesh.RecombinationAlgorithm = 1;", "General.NumThreads = 1;"]
    return "\n".join(lines) + "\n"


def draw_columns(rng, most):
    """A polygon with holes, and the heights of the body over each: (outer, holes, height of the domain,
    (centre, radius of the ball around it, bottom, top) of each)."""
    while True:
        outer = convex_polygon(rng, int(rng.integers(4, 9)), 1.0)
        holes = draw_holes(rng, outer, most)
        if not holes or min(clearance(k, outer, holes) for k in range(len(holes))) < CLEARANCE:
            continue
        halves = [radius * rng.uniform(0.4, 1.0) for _, radius, _ in holes]
        radii = [float(np.hypot(h[1], half)) for h, half in zip(holes, halves)]
        height = 2 * max(radii) + rng.uniform(2, 4) * CLEARANCE
        bodies = []
        for (centre, _, _), half, radius in zip(holes, halves, radii):
            low, high = radius + CLEARANCE, height - radius - CLEARANCE
            middle = rng.uniform(low, max(low, high))
            bodies.append((np.array([*centre, middle]), radius, middle - half, middle + half))
        if max(room_of_column(k, outer, holes, height, bodies) for k in range(len(bodies))) > CLEARANCE:
            return outer, holes, height, bodies


def room_of_column(k, outer, holes, height, bodies):
    centre, radius, _, _ = bodies[k]
    others = [float(np.hypot(*(centre[:2] - c))) - r for j, (c, r, _) in enumerate(holes) if j != k]
    return min([distance_to_loop(centre[:2], outer), centre[2], height - centre[2]] + others) - radius


def bent(points, by=0.03):
    """The same mesh with sides that are not flat: no parallel faces are left."""
    x, y, z = points.T
    return points + by * np.stack([np.sin(3 * z + y), np.sin(3 * x + z), np.sin(3 * y + x)], 1)


def make_columns(folder, name, kind, rng, max_rotation, most):
    outer, holes, height, bodies = draw_columns(rng, most)
    rooms = [room_of_column(k, outer, holes, height, bodies) for k in range(len(bodies))]
    able = [k for k, room in enumerate(rooms) if room > CLEARANCE]
    motions = []
    for _ in range(2):
        k = int(rng.choice(able))
        motions.append(draw_motion(rng, f"body{k + 1}", bodies[k][0], rooms[k], max_rotation))
    seed, split = rng.integers(1 << 32), kind == "mixed"

    def build(size):
        base = mesh_it(folder, f"{name}_base", base_geo(outer, holes, kind, size), ".msh", "msh22")
        mesh = extruded(base, height, [body[2:] for body in bodies], 0.8 * size)
        mesh = mesh._replace(points=bent(mesh.points))
        if split:
            mesh = split_about_centres(mesh, np.random.default_rng(seed))
        out = folder / f"{name}.su2"
        write_su2(out, mesh)
        return out
    return build, motions


def make(folder, index, seed, max_rotation, most):
    rng = np.random.default_rng(seed)
    kind, name = KINDS[index % len(KINDS)], f"volume{index:02d}"
    target = rng.uniform(1500, 5000)
    if kind == "tetrahedra":
        build, motions = make_box(folder, name, index, rng, max_rotation, most)
    else:
        build, motions = make_columns(folder, name, kind, rng, max_rotation, most)
    size = 2.5 / np.cbrt(target)
    for _ in range(8):
        out = build(size)
        nodes = count_nodes(out)
        if FEWEST <= nodes <= MOST:
            break
        size *= np.cbrt(nodes / target)
    else:
        raise RuntimeError(f"seed {seed}: {nodes} nodes, wanted {FEWEST} to {MOST}")
    print(f"{out.name}: seed {seed}, {kind}, {nodes} nodes")
    return {"file": out.name, "seed": seed, "elements": kind, "nodes": nodes, "motions": motions}


def main():
    parser = argparse.ArgumentParser(description="Makes random volume meshes with gmsh.")
    parser.add_argument("folder", type=Path)
    parser.add_argument("--count", type=int, default=8)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--max-rotation", type=float, default=90.0, help="degrees, either way")
    parser.add_argument("--max-bodies", type=int, default=3)
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    made = [make(args.folder, k, args.seed + k, args.max_rotation, args.max_bodies)
            for k in range(args.count)]
    (args.folder / "meshes.json").write_text(json.dumps({"meshes": made}, indent=2) + "\n")


if __name__ == "__main__":
    main()

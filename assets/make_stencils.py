#!/usr/bin/env python3
"""Seven stars of tetrahedra, one mesh: python3 assets/make_stencils.py [OUT.su2]

The links of AIAA 2009-1362, figure 24: 4, 6, 8, 10, 22, 40 and 80 triangles around a node. Nodes 0 to 6 are the
middles; their neighbours, on the boundary, lie unevenly around them, so that a star and its virtual control volume
differ. Needs nothing but Python.
"""
import itertools
import math
import random
import sys
from pathlib import Path

SPACING = 2.8


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def hull(points):
    """Triangles of the convex hull of points in general position, counter-clockwise from outside."""
    triangles = []
    for i, j, k in itertools.combinations(range(len(points)), 3):
        normal = cross(minus(points[j], points[i]), minus(points[k], points[i]))
        sides = [dot(normal, minus(p, points[i])) for n, p in enumerate(points) if n not in (i, j, k)]
        if max(sides) < 0:
            triangles.append((i, j, k))
        elif min(sides) > 0:
            triangles.append((i, k, j))
    return triangles


def spiral(count):
    """Points spread evenly over the sphere."""
    turn = math.pi * (3 - math.sqrt(5))
    points = []
    for k in range(count):
        z = 1 - (2 * k + 1) / count
        r = math.sqrt(1 - z * z)
        points.append((r * math.cos(k * turn), r * math.sin(k * turn), z))
    return points


def double_pyramid(n):
    ring = [(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n), 0.0) for k in range(n)]
    return ring + [(0.0, 0.0, 1.0), (0.0, 0.0, -1.0)]


def icosahedron():
    g = (1 + math.sqrt(5)) / 2
    points = []
    for a, b in itertools.product((-1, 1), (-g, g)):
        points += [unit((0, a, b)), unit((a, b, 0)), unit((b, 0, a))]
    return points


def subdivided(points):
    """With a point in the middle of every edge of the hull."""
    edges = {tuple(sorted(pair)) for t in hull(points) for pair in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))}
    return points + [unit(tuple(points[a][c] + points[b][c] for c in range(3))) for a, b in sorted(edges)]


def links():
    tetrahedron = [unit(p) for p in ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))]
    shapes = [tetrahedron] + [double_pyramid(n) for n in (3, 4, 5)] + [spiral(13), spiral(22), subdivided(icosahedron())]
    for points, count in zip(shapes, (4, 6, 8, 10, 22, 40, 80)):
        # Corners of a regular solid are in no general position: a touch aside for the hull alone.
        noise = random.Random(count)
        aside = [unit(tuple(c + noise.uniform(-1e-7, 1e-7) for c in p)) for p in points]
        triangles = hull(aside)
        assert len(triangles) == count, (count, len(triangles))
        yield points, triangles


def main():
    out = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parent / "coarse" / "stencils.su2")
    nodes = [(SPACING * i, 0.0, 0.0) for i in range(7)]
    elements, markers = [], []
    for middle, (points, triangles) in enumerate(links()):
        noise = random.Random(7 + middle)
        reach = 0.5 * math.sqrt(4 / len(points))  # so that no tetrahedron turns over
        around = []
        for p in points:
            moved = unit(tuple(c + noise.uniform(-0.6, 0.6) * reach * 0.5 for c in p))
            length = noise.uniform(0.75, 1.15)
            around.append(tuple(length * c for c in moved))
        for t in triangles:
            a, b, c = (around[k] for k in t)
            assert dot(a, cross(b, c)) > 0, (middle, t)
        first = len(nodes)
        nodes += [tuple(c + m for c, m in zip(p, nodes[middle])) for p in around]
        faces = [tuple(first + k for k in t) for t in triangles]
        # The tetrahedron of SU2: the last node lies where the others are counter-clockwise from.
        elements += [(f[0], f[2], f[1], middle) for f in faces]
        markers.append((f"link{len(triangles)}", faces))
    lines = [f"% Made by assets/make_stencils.py", "NDIME= 3", f"NELEM= {len(elements)}"]
    lines += [f"10 {' '.join(map(str, e))} {n}" for n, e in enumerate(elements)]
    lines.append(f"NPOIN= {len(nodes)}")
    lines += [f"{x:.6f} {y:.6f} {z:.6f} {n}" for n, (x, y, z) in enumerate(nodes)]
    lines.append(f"NMARK= {len(markers)}")
    for name, faces in markers:
        lines += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(faces)}"]
        lines += [f"5 {' '.join(map(str, f))}" for f in faces]
    out.write_text("\n".join(lines) + "\n")
    print(out)


if __name__ == "__main__":
    main()

"""Plane meshes of polygons for tests, as legacy VTK files."""

import math


def dual(nodes, elements, markers, voronoi=False):
    """The dual of a mesh of triangles: a polygon for each node, through the middles of the triangles around it,
    or through their circumcentres where these lie inside. That of a boundary node also goes through the middles
    of its edges and the node. Returns nodes, polygons and markers (name: list of edges)."""
    points = [middle(nodes, element, voronoi) for element in elements]
    around = {}  # node: {next corner of a triangle: (previous corner, triangle)}
    for e, corners in enumerate(elements):
        n = len(corners)
        for k, node in enumerate(corners):
            around.setdefault(node, {})[corners[(k + 1) % n]] = (corners[k - 1], e)
    of_edge, of_node = {}, {}

    def edge_point(a, b):
        key = (min(a, b), max(a, b))
        if key not in of_edge:
            of_edge[key] = len(points)
            points.append(tuple((p + q) / 2 for p, q in zip(nodes[a], nodes[b])))
        return of_edge[key]

    polygons = []
    for node, steps in sorted(around.items()):
        lasts = {last for last, _ in steps.values()}
        firsts = [first for first in steps if first not in lasts]
        first = firsts[0] if firsts else min(steps)
        corners, at = ([edge_point(node, first)] if firsts else []), first
        while at in steps:
            at, e = steps[at]
            corners.append(e)
            if at == first:
                break
        if firsts:
            corners.append(edge_point(node, at))
            of_node[node] = len(points)
            corners.append(of_node[node])
            points.append(nodes[node])
        polygons.append(corners)
    edges = {}
    for name, own in markers.items():
        edges[name] = []
        for a, b in own:
            edges[name] += [(of_node[a], edge_point(a, b)), (edge_point(a, b), of_node[b])]
    return points, polygons, edges


def middle(nodes, element, voronoi):
    places = [nodes[k] for k in element]
    centre = tuple(sum(p[i] for p in places) / len(places) for i in range(2))
    if not voronoi or len(element) != 3:
        return centre
    (ax, ay), (bx, by), (cx, cy) = places
    twice = 2 * (ax * (by - cy) + bx * (cy - ay) + cx * (ay - by))
    squares = [x * x + y * y for x, y in places]
    x = (squares[0] * (by - cy) + squares[1] * (cy - ay) + squares[2] * (ay - by)) / twice
    y = (squares[0] * (cx - bx) + squares[1] * (ax - cx) + squares[2] * (bx - ax)) / twice
    inside = all((q[0] - p[0]) * (y - p[1]) - (q[1] - p[1]) * (x - p[0]) >
                 0.05 * abs(twice) for p, q in zip(places, places[1:] + places[:1]))
    return (x, y) if inside else centre


def write_vtk(path, nodes, polygons, markers):
    cells = polygons + [edge for edges in markers.values() for edge in edges]
    tags = [0] * len(polygons) + [tag for tag, edges in enumerate(markers.values(), 1) for _ in edges]
    types = [7] * len(polygons) + [3] * (len(cells) - len(polygons))
    lines = ["# vtk DataFile Version 3.0", "polygons", "ASCII", "DATASET UNSTRUCTURED_GRID",
             f"POINTS {len(nodes)} double"]
    lines += [f"{x!r} {y!r} 0" for x, y in nodes]
    lines.append(f"CELLS {len(cells)} {sum(len(c) + 1 for c in cells)}")
    lines += [" ".join(map(str, (len(c), *c))) for c in cells]
    lines += [f"CELL_TYPES {len(cells)}", *map(str, types), f"FIELD FieldData {len(markers)}"]
    for tag, name in enumerate(markers, 1):
        lines += [f"marker:{name} 1 1 int", str(tag)]
    lines += [f"CELL_DATA {len(cells)}", "SCALARS marker int 1", "LOOKUP_TABLE default", *map(str, tags)]
    path.write_text("\n".join(lines) + "\n")


def read_vtk(path):
    """Nodes and polygons of a legacy file in text, version 3.0."""
    words = path.read_text().split()
    at = words.index("POINTS")
    count = int(words[at + 1])
    numbers = list(map(float, words[at + 3:at + 3 + 3 * count]))
    nodes = [(numbers[k], numbers[k + 1]) for k in range(0, 3 * count, 3)]
    at = words.index("CELLS")
    cells, k = [], at + 3
    for _ in range(int(words[at + 1])):
        size = int(words[k])
        cells.append(list(map(int, words[k + 1:k + 1 + size])))
        k += size + 1
    return nodes, [cell for cell in cells if len(cell) > 2]


def area(places):
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(places, places[1:] + places[:1])) / 2


def is_sound(places):
    """A polygon that goes round counter-clockwise and whose edges do not cross: by its angles, and by all pairs
    of its edges."""
    def side(a, b, c):
        return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])

    n = len(places)
    for i in range(n):
        for j in range(i + 2, n):
            if i == 0 and j == n - 1:
                continue
            a, b, c, d = places[i], places[(i + 1) % n], places[j], places[(j + 1) % n]
            if side(a, b, c) * side(a, b, d) < 0 and side(c, d, a) * side(c, d, b) < 0:
                return False
    return area(places) > 0


def distance(nodes, others):
    return max(math.dist(p, q) for p, q in zip(nodes, others))

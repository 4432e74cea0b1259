"""Surface meshes for the tests of the program."""

import math
import random


def write_obj(path, nodes, elements):
    with open(path, "w", encoding="ascii") as out:
        for node in nodes:
            out.write("v " + " ".join(repr(float(value)) for value in node) + "\n")
        for element in elements:
            out.write("f " + " ".join(str(i + 1) for i in element) + "\n")


def read_obj(path):
    nodes, elements = [], []
    for line in path.read_text(encoding="ascii").splitlines():
        words = line.split()
        if words and words[0] == "v":
            nodes.append(tuple(float(value) for value in words[1:4]))
        elif words and words[0] == "f":
            elements.append(tuple(int(value) - 1 for value in words[1:]))
    return nodes, elements


def norm(p):
    return math.sqrt(sum(value * value for value in p))


def sphere(n):
    """An octahedron whose faces are cut into n by n triangles, on the unit sphere."""
    number, nodes, elements = {}, [], []

    def node(i, j, k):
        if (i, j, k) not in number:
            number[i, j, k] = len(nodes)
            length = norm((i, j, k))
            nodes.append((i / length, j / length, k / length))
        return number[i, j, k]

    for sx in (1, -1):
        for sy in (1, -1):
            for sz in (1, -1):
                def at(i, j):
                    return node(sx * i, sy * j, sz * (n - i - j))
                for i in range(n):
                    for j in range(n - i):
                        faces = [(at(i, j), at(i + 1, j), at(i, j + 1))]
                        if i + j + 1 < n:
                            faces.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
                        for a, b, c in faces:
                            elements.append((a, b, c) if sx * sy * sz > 0 else (a, c, b))
    return nodes, elements


def torus(n, m, ring=2.0, tube=0.8):
    """Rows of triangles whose diagonals alternate, so that they can be equilateral."""
    def node(i, j):
        return (j % m) * n + i % n

    nodes = []
    for j in range(m):
        for i in range(n):
            a, b = 2 * math.pi * i / n, 2 * math.pi * j / m
            r = ring + tube * math.cos(b)
            nodes.append((r * math.cos(a), r * math.sin(a), tube * math.sin(b)))
    elements = []
    for j in range(m):
        for i in range(n):
            a, b, c, d = node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)
            elements += [(a, b, d), (b, c, d)] if j % 2 else [(a, b, c), (a, c, d)]
    return nodes, elements


def grid(n, place, quads=False, rows=None):
    """n by `rows` cells of the unit square, laid where place(x, y) is. Diagonals alternate from row to
    row."""
    rows = rows or n
    nodes = [place(i / n, j / rows) for j in range(rows + 1) for i in range(n + 1)]
    elements = []
    for j in range(rows):
        for i in range(n):
            a = j * (n + 1) + i
            b, c, d = a + 1, a + n + 2, a + n + 1
            if quads and (i + j) % 3:
                elements.append((a, b, c, d))
            else:
                elements += [(a, b, d), (b, c, d)] if j % 2 else [(a, b, c), (a, c, d)]
    return nodes, elements


def cube(n, seed=None):
    """The surface of the unit cube, n by n cells of triangles a side; nodes inside its faces, and only
    they, are moved at random by up to a third of a cell."""
    number, nodes, elements = {}, [], []

    def node(p):
        if p not in number:
            number[p] = len(nodes)
            nodes.append([value / n for value in p])
        return number[p]

    for axis in range(3):
        for side in (0, n):
            for i in range(n):
                for j in range(n):
                    def at(u, v):
                        p = [u, v]
                        p.insert(axis, side)
                        return node(tuple(p))
                    a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
                    outward = (side > 0) == (axis != 1)
                    for t in ((a, b, c), (a, c, d)):
                        elements.append(t if outward else t[::-1])
    if seed is not None:
        numbers = random.Random(seed)
        for p, i in number.items():
            if sum(value in (0, n) for value in p) == 1:
                for axis in range(3):
                    if p[axis] not in (0, n):
                        nodes[i][axis] += numbers.uniform(-0.33, 0.33) / n
    return [tuple(p) for p in nodes], elements


def features_of_cube(nodes):
    """Numbers of the nodes on its edges, and of its corners."""
    sides = [sum(value in (0.0, 1.0) for value in p) for p in nodes]
    return ([i for i, count in enumerate(sides) if count == 2],
            [i for i, count in enumerate(sides) if count == 3])

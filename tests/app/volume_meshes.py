"""Small volume meshes for the tests of the program."""
import itertools

N = 5  # cubes along each side; the one in the middle is the body
TETRAHEDRON, TRIANGLE = 10, 5


def box_mesh():
    """Tetrahedra (six to a cube) in [0, 1]^3 around a cube that is left out."""
    ids, nodes, tetrahedra = {}, [], []

    def node(i, j, k):
        if (i, j, k) not in ids:
            ids[i, j, k] = len(nodes)
            nodes.append((i / N, j / N, k / N))
        return ids[i, j, k]

    for i, j, k in itertools.product(range(N), repeat=3):
        if (i, j, k) == (N // 2,) * 3:
            continue
        for order in itertools.permutations(range(3)):
            place, corners = [i, j, k], [node(i, j, k)]
            for axis in order:
                place[axis] += 1
                corners.append(node(*place))
            tetrahedra.append(corners)
    count = {}
    for cell in tetrahedra:
        for face in itertools.combinations(cell, 3):
            count[tuple(sorted(face))] = count.get(tuple(sorted(face)), 0) + 1
    markers = {"body": [], "far": []}
    for face, uses in count.items():
        if uses == 1:
            inside = all(0 < c < 1 for n in face for c in nodes[n])
            markers["body" if inside else "far"].append(face)
    return nodes, tetrahedra, markers


def write_box(path, shift=None):
    nodes, cells, markers = box_mesh()
    if shift:
        nodes[shift[0]] = shift[1]
    lines = ["NDIME= 3", f"NELEM= {len(cells)}"]
    lines += [" ".join(map(str, (TETRAHEDRON, *c, i))) for i, c in enumerate(cells)]
    lines += [f"NPOIN= {len(nodes)}"]
    lines += [" ".join([*(repr(c) for c in p), str(i)]) for i, p in enumerate(nodes)]
    lines += [f"NMARK= {len(markers)}"]
    for name, faces in markers.items():
        lines += [f"MARKER_TAG= {name}", f"MARKER_ELEMS= {len(faces)}"]
        lines += [" ".join(map(str, (TRIANGLE, *f))) for f in faces]
    path.write_text("\n".join(lines) + "\n")
    return nodes, cells, markers

"""Layers of prisms at a sphere about the origin, put below the tetrahedra around it."""
import numpy as np

from meshgen.su2 import VolumeMesh


def layer_heights(first, ratio, layers):
    """Heights of the layers, from the wall."""
    return first * ratio ** np.arange(layers)


def with_prisms(mesh, marker, heights):
    """mesh: tetrahedra around the sphere `marker`, which becomes the outer end of the layers. heights: from the
    wall. The wall gets the marker's name, and its nodes lie on the rays to those of the marker."""
    rim = sorted({node for face in mesh.markers[marker] for node in face})
    place = {node: k for k, node in enumerate(rim)}
    radii = np.linalg.norm(mesh.points[rim], axis=1, keepdims=True)
    depths = np.cumsum(heights[::-1])  # below the rim, so that the last is the wall
    rings = [mesh.points[rim] * (1 - depth / radii) for depth in depths]
    count, nodes = len(mesh.points), len(rim)

    def node_at(node, level):
        """The node so many layers below a node of the rim."""
        return node if level == 0 else count + (level - 1) * nodes + place[node]

    cells = list(mesh.cells)
    for face in mesh.markers[marker]:
        # From outside in, counter-clockwise seen from outside.
        a, b, c = face if np.linalg.det(mesh.points[list(face)]) > 0 else face[::-1]
        cells += [tuple(node_at(n, level) for level in (k, k + 1) for n in (a, b, c))
                  for k in range(len(heights))]
    wall = [tuple(node_at(n, len(heights)) for n in face) for face in mesh.markers[marker]]
    return VolumeMesh(np.concatenate([mesh.points, *rings]), cells, {**mesh.markers, marker: wall})

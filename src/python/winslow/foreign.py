"""Meshes of other packages: meshio, pyvista, and plain arrays.

    mesh = winslow.from_meshio(meshio.read("wing.vtu"))
    back = winslow.move(mesh, "flap", rotate=-10).mesh.to_meshio()

What winslow has no use for is kept and given back: the order of the cells, their data, point data, cell
sets. So `from_meshio(m).to_meshio()` is `m` again, bit for bit.
"""

import dataclasses
import os
from collections.abc import Mapping

import numpy as np

from . import _winslow
from .errors import UsageError

Mesh = _winslow.Mesh

_DIMENSION = {"vertex": 0, "line": 1, "triangle": 2, "quad": 2, "polygon": 2,
              "tetra": 3, "pyramid": 3, "wedge": 3, "hexahedron": 3, "polyhedron": 3}

# Cell types of VTK (vtkCellType.h). Pixels and voxels count their corners row by row.
_VTK_TYPES = {1: "vertex", 3: "line", 5: "triangle", 7: "polygon", 8: "pixel", 9: "quad", 10: "tetra",
              11: "voxel", 12: "hexahedron", 13: "wedge", 14: "pyramid", 42: "polyhedron"}
_VTK_NUMBERS = {name: number for number, name in _VTK_TYPES.items()}
_VTK_ORDER = {"pixel": ("quad", [0, 1, 3, 2]), "voxel": ("hexahedron", [0, 1, 3, 2, 4, 5, 7, 6])}


@dataclasses.dataclass
class Foreign:
    """What a foreign mesh holds besides nodes and elements."""

    kind: str = "arrays"
    blocks: list = dataclasses.field(default_factory=list)  # (type, data), as they were given
    z: object = None  # third coordinates of a plane mesh
    attributes: dict = dataclasses.field(default_factory=dict)  # of a meshio mesh
    grid: object = None  # class, cells, celltypes and arrays of a pyvista grid


def _base(name):
    """"polyhedron8" is a polyhedron: meshio has a type for each number of corners."""
    return "polyhedron" if name.startswith("polyhedron") else name


def _dimension(name):
    if _base(name) not in _DIMENSION:
        raise UsageError(f'cells: found "{name}", expected one of {", ".join(_DIMENSION)}: winslow takes meshes of '
                         "first order")
    return _DIMENSION[_base(name)]


def _pairs(cells):
    """Blocks of cells as a list of (type, data)."""
    if isinstance(cells, Mapping):
        return list(cells.items())
    pairs = []
    for block in cells:
        if hasattr(block, "type") and hasattr(block, "data"):
            pairs.append((block.type, block.data))
        elif isinstance(block, (tuple, list)) and len(block) == 2 and isinstance(block[0], str):
            pairs.append(tuple(block))
        else:
            raise UsageError("cells: expected a dict of arrays by the type of the cells, or a list of pairs "
                             "(type, array)")
    return pairs


def _is_rows(data):
    """Whether polygons or polyhedra are given as offsets and nodes."""
    return isinstance(data, tuple) and len(data) in (2, 3) and all(
        isinstance(part, np.ndarray) and part.ndim == 1 for part in data)


def _offsets(lengths):
    return np.concatenate([[0], np.cumsum(np.asarray(lengths, dtype=np.int64))]).astype(np.int32)


def _flat(parts):
    parts = [np.asarray(part) for part in parts]
    return np.concatenate(parts).astype(np.int32) if parts else np.zeros(0, np.int32)


def _polygons(data):
    if _is_rows(data):
        return data
    return _offsets([len(cell) for cell in data]), _flat(data)


def _polyhedra(data):
    if _is_rows(data):
        return data
    faces = [face for cell in data for face in cell]
    return _offsets([len(cell) for cell in data]), _offsets([len(face) for face in faces]), _flat(faces)


def _count(name, data):
    return len(data[0]) - 1 if _is_rows(data) and _base(name) in ("polygon", "polyhedron") else len(data)


def _whole(data, name):
    array = np.asarray(data)
    if array.size == 0:
        return array.reshape(0, array.shape[-1] if array.ndim == 2 else 1).astype(np.int32)
    if array.dtype == object or array.dtype.kind not in "iu":
        raise UsageError(f'cells["{name}"]: expected an array of whole numbers, the nodes of each cell')
    return array


def _is_cell_set(value, blocks):
    """Whether a value has an array of indices, or nothing, for each block."""
    return (isinstance(value, (list, tuple)) and len(value) == len(blocks) and len(blocks) > 0
            and all(part is None or (isinstance(part, np.ndarray) and part.ndim == 1) for part in value))


def _faces(value):
    """Faces as a list of arrays (m, k), one for each number of corners; a tuple of tuples counts as one array."""
    if isinstance(value, Mapping):
        return [part for data in value.values() for part in (_split(data) if _is_rows(data) else [np.asarray(data)])]
    if isinstance(value, np.ndarray):
        return [value]
    value = list(value)
    if value and all(isinstance(part, np.ndarray) and part.ndim == 2 for part in value):
        return value
    return [np.array([face for face in value if len(face) == k])
            for k in sorted({len(face) for face in value})]


def _split(rows):
    offsets, nodes = rows
    return [nodes[a:b].reshape(1, -1) for a, b in zip(offsets[:-1], offsets[1:])]


def _block_faces(name, data, ids):
    """Some cells of a block as faces."""
    if name == "polygon":
        offsets, nodes = _polygons(data)
        return [nodes[offsets[i]:offsets[i + 1]].reshape(1, -1) for i in ids]
    return [_whole(data, name)[ids]]


class _Sets:
    """Sets of cells by their names, sorted into markers and regions."""

    def __init__(self, pairs):
        self.pairs = pairs
        self.top = max((_dimension(name) for name, _ in pairs), default=2)
        self.first, count = [], 0  # number of the first element of each block
        for name, data in pairs:
            self.first.append(count if _dimension(name) == self.top else -1)
            count += _count(name, data) if _dimension(name) == self.top else 0
        self.taken = np.zeros(count, bool)
        self.markers, self.regions = {}, {}

    def add(self, name, indices):
        faces, elements = [], []
        for (kind, data), first, ids in zip(self.pairs, self.first, indices):
            if ids is None or len(ids) == 0:
                continue
            ids = np.asarray(ids).astype(np.int64)
            if ids.min() < 0 or ids.max() >= _count(kind, data):
                raise UsageError(f'markers["{name}"]: found an index beyond the {_count(kind, data)} cells of type {kind}')
            if first >= 0:
                elements.append(first + ids)
            elif _dimension(kind) == self.top - 1:
                faces += _block_faces(kind, data, ids)
        if faces:
            self.markers[name] = faces
        if elements:
            elements = np.unique(np.concatenate(elements))
            # An element is in one region. Sets that overlap are kept as sets alone.
            if not self.taken[elements].any():
                self.taken[elements] = True
                self.regions[name] = elements.astype(np.int32)

    def elements(self):
        """The blocks of elements, as the extension takes them."""
        blocks = []
        for (name, data), first in zip(self.pairs, self.first):
            if first < 0:
                continue
            base = _base(name)
            if base == "polygon":
                data = _polygons(data)
            elif base == "polyhedron":
                data = _polyhedra(data)
            else:
                data = _whole(data, name)
            blocks.append((base, data))
        return blocks


def arrays_of(cells, markers, regions):
    """The arguments of Mesh in order: blocks of elements, markers, regions, and what is to be kept."""
    pairs = _pairs(cells)
    sets = _Sets(pairs)
    for name, value in (markers or {}).items():
        if _is_cell_set(value, pairs):
            sets.add(name, value)
        else:
            sets.markers[name] = _faces(value)
    for name, ids in (regions or {}).items():
        sets.regions[name] = np.asarray(ids)
    return sets.elements(), sets.markers, sets.regions, Foreign(blocks=pairs)


def _plane_points(points, top):
    """Points of a mesh, and the third coordinates of one that lies in a plane z = const."""
    points = np.asarray(points)
    if points.ndim == 2 and points.shape[1] == 3 and top == 2 and len(points) and (points[:, 2] == points[0, 2]).all():
        return np.ascontiguousarray(points[:, :2], dtype=np.float64), points[:, 2].copy()
    return points, None


def _made(points, sets, foreign):
    points, foreign.z = _plane_points(points, sets.top)
    mesh = Mesh(points, sets.elements(), sets.markers, sets.regions)
    mesh._foreign = foreign
    return mesh


def _points_back(mesh, foreign):
    if foreign.z is None or mesh.dimension == 3:
        return mesh.copy_points()
    return np.column_stack([mesh.points, foreign.z])


def from_meshio(m):
    """A mesh from a meshio mesh.

    Cell sets of lines (in volume meshes of triangles and quads) become markers, sets of elements
    regions; without sets the names of `field_data` with "gmsh:physical" do. Points with one z are a
    plane mesh. All sets, data and the order of the cells are kept for `to_meshio()`.

    Parameters
    ----------
    m : meshio.Mesh
        Or anything with `points`, `cells`, `cell_sets`, `cell_data`, `point_data`.

    Returns
    -------
    Mesh
    """
    pairs = _pairs(m.cells)
    sets = _Sets(pairs)
    named = {name: value for name, value in (getattr(m, "cell_sets", None) or {}).items()
             if not name.startswith("gmsh:")}
    for name, value in named.items():
        sets.add(name, value)
    data = getattr(m, "cell_data", None) or {}
    tags = next((data[key] for key in ("gmsh:physical", "medit:ref", "cell_tags") if key in data), None)
    if not named and tags is not None:
        names = {(int(v[0]), int(v[1])): k for k, v in (getattr(m, "field_data", None) or {}).items() if len(v) == 2}
        _add_tags(sets, [np.asarray(part).ravel() for part in tags], names)
    attributes = {name: getattr(m, name, None)
                  for name in ("point_data", "cell_data", "field_data", "point_sets", "cell_sets", "gmsh_periodic",
                               "info")}
    return _made(m.points, sets, Foreign("meshio", pairs, None, attributes))


def _add_tags(sets, tags, names):
    """Markers and regions by the tag of each cell: one array for each block."""
    for dimension, stem in ((sets.top - 1, "marker_"), (sets.top, "region_")):
        parts = [part if _dimension(kind) == dimension else np.zeros(0, int)
                 for (kind, _), part in zip(sets.pairs, tags)]
        for tag in np.unique(np.concatenate(parts)) if parts else []:
            if tag == 0:
                continue
            name = names.get((int(tag), dimension), f"{stem}{int(tag)}")
            sets.add(name, [np.flatnonzero(part == tag) for part in parts])


def _own_blocks(mesh):
    """Blocks of the elements in their order, runs of one type each: (type, data, ids)."""
    kinds = np.empty(mesh.element_count, dtype=object)
    rows = np.empty(mesh.element_count, dtype=np.int64)
    for name, ids in mesh.element_ids.items():
        kinds[ids] = name
        rows[ids] = np.arange(len(ids))
    blocks = []
    starts = [i for i in range(len(kinds)) if i == 0 or kinds[i] != kinds[i - 1]]
    for a, b in zip(starts, [*starts[1:], len(kinds)]):
        name, data = kinds[a], mesh.cells[kinds[a]]
        first, last = rows[a], rows[b - 1] + 1
        if name == "polygon":
            blocks += [(name, data[1][data[0][k]:data[0][k + 1]].reshape(1, -1)) for k in range(first, last)]
        elif name == "polyhedron":
            blocks += [_one_polyhedron(data, k) for k in range(first, last)]
        else:
            blocks.append((name, data[first:last].copy()))
    return blocks


def _one_polyhedron(data, k):
    cells, faces, nodes = data
    shape = [nodes[faces[f]:faces[f + 1]].copy() for f in range(cells[k], cells[k + 1])]
    return f"polyhedron{len(np.unique(np.concatenate(shape)))}", [shape]


def _own_arrays(mesh):
    """Blocks and cell sets of a mesh that came from no foreign one."""
    blocks = _own_blocks(mesh)
    elements = len(blocks)
    starts = np.concatenate([[0], np.cumsum([len(block[1]) for block in blocks])])
    parts = {}
    for name, by_type in mesh.faces.items():
        for kind, data in by_type.items():
            for faces in (_split(data) if kind == "polygon" else [data]):
                parts.setdefault(name, []).append(len(blocks))
                blocks.append((kind, np.array(faces)))
    sets = {}
    if mesh.markers_from_file:
        for name, numbers in parts.items():
            sets[name] = [np.arange(len(data)) if k in numbers else np.zeros(0, int)
                          for k, (_, data) in enumerate(blocks)]
    for name, ids in mesh.regions.items():
        own = [ids[(ids >= a) & (ids < b)] - a for a, b in zip(starts[:-1], starts[1:])]
        sets[name] = [*own, *[np.zeros(0, int)] * (len(blocks) - elements)]
    return blocks, sets


def to_meshio(mesh):
    """The mesh as a `meshio.Mesh`: with everything that came with it, if it came from one."""
    import meshio

    foreign = mesh._foreign
    if isinstance(foreign, Foreign) and foreign.kind == "meshio":
        more = {name: value for name, value in foreign.attributes.items() if value}
        return meshio.Mesh(_points_back(mesh, foreign), foreign.blocks, **more)
    blocks, sets = _own_arrays(mesh)
    return meshio.Mesh(mesh.copy_points(), blocks, cell_sets=sets)


def _vtk_cells(grid):
    """Cells of a pyvista grid as (type, nodes) one by one, in runs of one type: a list of (type, list)."""
    stream, types = np.asarray(grid.cells), np.asarray(grid.celltypes)
    runs, at = [], 0
    for number in types:
        name = _VTK_TYPES.get(int(number))
        if name is None:
            raise UsageError(f"found a cell of VTK's type {int(number)}, expected one of first order: "
                             f"{', '.join(map(str, sorted(_VTK_TYPES)))}")
        length = int(stream[at])
        cell = stream[at + 1:at + 1 + length]
        at += 1 + length
        if name in _VTK_ORDER:
            name, order = _VTK_ORDER[name]
            cell = cell[order]
        if not runs or runs[-1][0] != name:
            runs.append((name, []))
        runs[-1][1].append(cell)
    return runs


def _vtk_polyhedron(cell):
    """Faces from VTK's stream: number of faces, then each with the number of its nodes before it."""
    faces, at = [], 1
    for _ in range(int(cell[0])):
        faces.append(cell[at + 1:at + 1 + int(cell[at])])
        at += 1 + int(cell[at])
    return faces


def _is_pyvista(value):
    return all(hasattr(value, name) for name in ("points", "cells", "celltypes"))


def _is_meshio(value):
    return hasattr(value, "points") and hasattr(value, "cells") and not hasattr(value, "celltypes")


def from_pyvista(grid):
    """A mesh from a `pyvista.UnstructuredGrid`.

    Markers are the lines (in volume meshes the triangles, quads and polygons) of the grid by the cell
    array `marker`, with names from the field arrays `marker:NAME`, as winslow writes them to VTK files;
    else by `gmsh:physical` or `CellEntityIds`. Regions likewise. All arrays are kept for `to_pyvista()`.

    Parameters
    ----------
    grid : pyvista.UnstructuredGrid
        Or anything with `points`, `cells`, `celltypes`, `point_data`, `cell_data` in VTK's layout.

    Returns
    -------
    Mesh
    """
    pairs = []
    for name, cells in _vtk_cells(grid):
        if name == "polyhedron":
            pairs.append((name, [_vtk_polyhedron(cell) for cell in cells]))
        elif name == "polygon":
            pairs.append((name, cells))
        else:
            pairs.append((name, np.array(cells)))
    sets = _Sets(pairs)
    data = dict(getattr(grid, "cell_data", None) or {})
    field = dict(getattr(grid, "field_data", None) or {})
    starts = np.cumsum([0, *[len(cells) for _, cells in pairs]])
    for dimension, own in ((sets.top - 1, "marker"), (sets.top, "region")):
        key = next((k for k in (own, "gmsh:physical", "CellEntityIds") if k in data), None)
        if key is None:
            continue
        array = np.asarray(data[key]).ravel()
        names = {(int(np.asarray(v).ravel()[0]), dimension): k.partition(":")[2] for k, v in field.items()
                 if k.startswith(own + ":")}
        tags = [array[a:b] if _dimension(kind) == dimension else np.zeros(b - a, int)
                for (kind, _), a, b in zip(pairs, starts[:-1], starts[1:])]
        _add_tags(sets, tags, names)
    foreign = Foreign("pyvista", pairs, None, {}, {
        "class": type(grid), "cells": np.array(grid.cells), "celltypes": np.array(grid.celltypes),
        "point_data": {k: np.array(v) for k, v in dict(getattr(grid, "point_data", None) or {}).items()},
        "cell_data": {k: np.array(v) for k, v in data.items()},
        "field_data": {k: np.array(v) for k, v in field.items()}})
    return _made(grid.points, sets, foreign)


def to_pyvista(mesh):
    """The mesh as a `pyvista.UnstructuredGrid`: with everything that came with it, if it came from one."""
    foreign = mesh._foreign
    if isinstance(foreign, Foreign) and foreign.kind == "pyvista":
        kept = foreign.grid
        grid = kept["class"](kept["cells"], kept["celltypes"], _points_back(mesh, foreign))
        for name in ("point_data", "cell_data", "field_data"):
            for key, value in kept[name].items():
                getattr(grid, name)[key] = value.copy()
        return grid
    import pyvista

    return pyvista.UnstructuredGrid(*vtk_arrays(mesh))


def vtk_arrays(mesh):
    """(cells, celltypes, points) of the elements in VTK's layout, points with three coordinates."""
    stream, types = [], []
    for name, data in _own_blocks(mesh):
        for cell in data:
            if name.startswith("polyhedron"):
                body = [len(cell)]
                for face in cell:
                    body += [len(face), *face]
            else:
                body = list(cell)
            stream += [len(body), *body]
            types.append(_VTK_NUMBERS[_base(name)])
    points = mesh.copy_points()
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    return np.array(stream, np.int64), np.array(types, np.uint8), points


def as_mesh(value):
    """A mesh from what a function was given: a mesh, a file, a foreign mesh, or (points, cells[, sets])."""
    if isinstance(value, Mesh):
        return value
    if isinstance(value, (str, os.PathLike)):
        from .files import read

        return read(value)
    if _is_pyvista(value):
        return from_pyvista(value)
    if _is_meshio(value):
        return from_meshio(value)
    if isinstance(value, (tuple, list)) and len(value) in (2, 3):
        return Mesh(*value)
    raise UsageError(f"found {type(value).__name__}, expected a winslow.Mesh, a file, a mesh of meshio or pyvista, "
                     "or (points, cells, cell_sets)")


Mesh.to_meshio = to_meshio
Mesh.to_pyvista = to_pyvista

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
_VTK_SIZES = {1: 1, 3: 2, 5: 3, 8: 4, 9: 4, 10: 4, 11: 8, 12: 8, 13: 6, 14: 5}
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
                raise UsageError(f'markers["{name}"]: found an index beyond the {_count(kind, data)} cells of '
                                 f"type {kind}")
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


def _runs(keys):
    """(begin, end) of the runs of equal numbers."""
    keys = np.asarray(keys)
    inside = np.flatnonzero(keys[1:] != keys[:-1]) + 1
    return list(zip([0, *inside], [*inside, len(keys)])) if len(keys) else []


def _own_blocks(mesh):
    """Blocks of the elements in their order, runs of one type each: (type, data), as meshio has them."""
    names = list(mesh.element_ids)
    kinds, rows = np.empty((2, mesh.element_count), dtype=np.int64)
    for k, name in enumerate(names):
        ids = mesh.element_ids[name]
        kinds[ids], rows[ids] = k, np.arange(len(ids))
    blocks = []
    for a, b in _runs(kinds):
        name, data = names[kinds[a]], mesh.cells[names[kinds[a]]]
        first, last = rows[a], rows[b - 1] + 1
        if name == "polygon":
            offsets = data[0][first:last + 1]
            blocks += [(name, data[1][offsets[c]:offsets[d]].reshape(d - c, -1)) for c, d in _runs(np.diff(offsets))]
        elif name == "polyhedron":
            cells = [_polyhedron(data, k) for k in range(first, last)]
            counts = [len(np.unique(np.concatenate(cell))) for cell in cells]
            blocks += [(f"polyhedron{counts[c]}", cells[c:d]) for c, d in _runs(counts)]
        else:
            blocks.append((name, data[first:last].copy()))
    return blocks


def _polyhedron(data, k):
    cells, faces, nodes = data
    return [nodes[faces[f]:faces[f + 1]].copy() for f in range(cells[k], cells[k + 1])]


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


def _vtk_offsets(stream, types):
    """Where each cell begins in VTK's stream, in which the number of its numbers comes first."""
    sizes = np.array([_VTK_SIZES.get(int(t), 0) for t in np.unique(types)])[np.searchsorted(np.unique(types), types)]
    if (sizes > 0).all():
        starts = np.concatenate([[0], np.cumsum(sizes + 1)])
    else:
        starts, at = np.empty(len(types) + 1, np.int64), 0
        for k in range(len(types)):
            starts[k] = at
            at += 1 + (int(stream[at]) if at < len(stream) else 0)
        starts[-1] = at
    sound = starts[-1] == len(stream) and (np.diff(starts) - 1 == stream[starts[:-1]]).all()
    if not sound:
        raise UsageError("found cells of which the number of nodes does not suit celltypes, expected VTK's layout: for "
                         "each cell the number of its nodes, then the nodes")
    return starts


def _vtk_cells(grid):
    """Cells of a pyvista grid as (type, data), in runs of one type."""
    stream, types = np.asarray(grid.cells), np.asarray(grid.celltypes)
    for number in np.unique(types):
        if int(number) not in _VTK_TYPES:
            raise UsageError(f"found a cell of VTK's type {int(number)}, expected one of first order: "
                             f"{', '.join(map(str, sorted(_VTK_TYPES)))}")
    starts = _vtk_offsets(stream, types)
    runs = []
    for a, b in _runs(types):
        name, part = _VTK_TYPES[int(types[a])], stream[starts[a]:starts[b]]
        if name in ("polygon", "polyhedron"):
            cells = [stream[starts[k] + 1:starts[k + 1]] for k in range(a, b)]
            runs.append((name, [_vtk_polyhedron(cell) for cell in cells] if name == "polyhedron" else cells))
            continue
        data = part.reshape(b - a, -1)[:, 1:]
        if name in _VTK_ORDER:
            name, order = _VTK_ORDER[name]
            data = data[:, order]
        runs.append((name, data))
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
    pairs = _vtk_cells(grid)
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
    stream, types = [np.zeros(0, np.int64)], []
    for name, data in _own_blocks(mesh):
        base = _base(name)
        types += [_VTK_NUMBERS[base]] * len(data)
        if base == "polyhedron":
            for cell in data:
                body = [len(cell), *(number for face in cell for number in (len(face), *face))]
                stream.append(np.array([len(body), *body]))
        else:
            stream.append(np.column_stack([np.full(len(data), data.shape[1]), data]).ravel())
    points = mesh.copy_points()
    if points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    return np.concatenate(stream).astype(np.int64), np.array(types, np.uint8), points


def as_mesh(value, show=False):
    """A mesh from what a function was given: a mesh, a file, a foreign mesh, or (points, cells[, sets]).

    show: as of `read`.
    """
    if isinstance(value, Mesh):
        return value
    if isinstance(value, (str, os.PathLike)):
        from .files import read

        return read(value, show=show)
    if _is_pyvista(value):
        return from_pyvista(value)
    if _is_meshio(value):
        return from_meshio(value)
    if isinstance(value, (tuple, list)) and len(value) in (2, 3):
        return Mesh(*value)
    raise UsageError(f"found {type(value).__name__}, expected a winslow.Mesh, a file, a mesh of meshio or pyvista, "
                     "or (points, cells, cell_sets)")


def _unpickled(points, blocks, faces, regions, foreign):
    mesh = Mesh(points, blocks, faces, regions)
    mesh._foreign = foreign
    return mesh


def _pickled(mesh):
    """A mesh for other processes: nodes, elements, markers, regions. What its file says besides stays behind."""
    blocks = _own_blocks(mesh)
    faces = {name: {kind: part if isinstance(part, tuple) else np.array(part) for kind, part in by_type.items()}
             for name, by_type in mesh.faces.items()} if mesh.markers_from_file else {}
    return _unpickled, (mesh.copy_points(), blocks, faces, dict(mesh.regions), mesh._foreign)


Mesh.__reduce__ = _pickled
Mesh.to_meshio = to_meshio
Mesh.to_pyvista = to_pyvista

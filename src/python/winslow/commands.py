"""The commands that change or measure a mesh. Their options are those of the program's tables."""

import fnmatch
import os

from . import _winslow
from .errors import UsageError
from .foreign import as_mesh
from .results import checked, quality_of
from .tables import documented


def _dicts(what, given):
    """Raises UsageError unless an argument is a sequence of dicts, or None."""
    if given is not None and not (isinstance(given, (list, tuple)) and all(isinstance(one, dict) for one in given)):
        raise UsageError(f"{what}: found {given!r}, expected a list of dicts")


def _number(what, given, kind):
    """A float or an int; raises UsageError for anything else."""
    if isinstance(given, bool) or not hasattr(given, "__float__" if kind is float else "__index__"):
        raise UsageError(f"{what}: found {given!r}, expected {'a number' if kind is float else 'a whole number'}")
    return kind(given)


def _columns(given):
    """What single columns of layers are to have, with numbers of Python."""
    if given is None:
        return None
    if not isinstance(given, dict) or not all(isinstance(own, dict) for own in given.values()):
        raise UsageError("columns: expected a dict of nodes to dicts with columns and thickness")
    kinds = {"columns": int}
    return {_number("columns", node, int): {key: _number(f"columns[{node}] {key}", value, kinds.get(key, float))
                                            for key, value in own.items()} for node, own in given.items()}


def _run(name, run, mesh, options, *arguments):
    """Carries a command out, and raises what is to be raised."""
    allow_inverted = bool(options.pop("allow_inverted", False))
    if options.get("reference") is not None:
        options["reference"] = as_mesh(options["reference"])
    if options.get("config") is not None:
        options["config"] = os.fspath(options["config"])
    allow_incomplete = bool(options.get("allow_incomplete", False))
    return checked(name, run(as_mesh(mesh), *arguments, options), allow_inverted, allow_incomplete)


@documented("smooth")
def smooth(mesh, **options):
    """Smooth the interior of a mesh, the boundary held.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    """
    return _run("smooth", _winslow.smooth, mesh, options)


def untangle(mesh, **options):
    """Smooth a mesh if it has inverted elements; else it is returned as it is.

    Parameters
    ----------
    mesh : Mesh
        As of `smooth`.
    **options
        Those of `smooth`; `untangle` chooses the method.

    Returns
    -------
    Mesh
        Without inverted elements.

    Raises
    ------
    IncompleteMotion
        Inverted elements are left; has the result.
    """
    mesh = as_mesh(mesh)
    return smooth(mesh, **options).mesh if _winslow.inverted(mesh) else mesh


@documented("move")
def move(mesh, markers=None, *, bodies=None, **options):
    """Move bodies rigidly, and the mesh with them.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    markers : str or sequence of str
        Markers that move together; * stands for any characters.
    bodies : sequence of dict
        In place of `markers`: bodies that move at the same time, each a dict with `markers` and the
        options rotate, translate, pivot, axis.
    """
    _dicts("bodies", bodies)
    return _run("move", _winslow.move, mesh, options, markers, bodies)


@documented("deform")
def deform(mesh, markers=None, *, displacements=None, positions=None, nodes=None, sine=None, **options):
    """Change the shape of bodies, or prescribe single nodes, and move the mesh with them.

    Give one of `displacements`, `positions` and `sine`.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    markers : str or sequence of str
        Markers that move. Nodes of them without a row stay. None: any node may be prescribed.
    displacements : array_like (k, dimension), or a CSV file
        How far the nodes move.
    positions : array_like (k, dimension), or a CSV file
        Where the nodes are afterwards, to the bit.
    nodes : array_like (k,)
        Ids of the nodes of the rows. None: the rows are all nodes of the mesh, of which those of
        `markers` are taken; or the nodes of `markers`, ascending (`mesh.markers[name]`).
    sine : dict
        A sine wave along the body: amplitude, waves, direction, along, fade, fade_length.
    """
    given = [name for name, value in (("displacements", displacements), ("positions", positions), ("sine", sine))
             if value is not None]
    if sine is not None and not isinstance(sine, dict):
        raise UsageError(f"sine: found {sine!r}, expected a dict with amplitude and waves")
    if len(given) != 1:
        raise UsageError("give either displacements, positions or sine")
    mesh, numbers = as_mesh(mesh), positions if displacements is None else displacements
    if isinstance(numbers, (str, os.PathLike)):
        numbers, nodes = os.fspath(numbers), None
    elif sine is None:
        nodes, numbers = _rows(mesh, markers, nodes, numbers)
    return _run("deform", _winslow.deform, mesh, options, markers, sine, given[0], nodes, numbers)


def _rows(mesh, markers, nodes, numbers):
    """Ids and rows of the nodes that are prescribed."""
    import numpy as np

    numbers = np.asarray(numbers)
    if nodes is not None:
        return np.asarray(nodes), numbers
    if markers is None:
        raise UsageError("found rows without ids: expected nodes, or markers whose nodes the rows are of")
    names = [markers] if isinstance(markers, str) else list(markers)
    names = [known for name in names for known in fnmatch.filter(mesh.markers, name) or [name]]
    unknown = [name for name in names if name not in mesh.markers]
    if unknown:
        raise UsageError(f'unknown marker "{unknown[0]}", expected one of {", ".join(mesh.markers)}')
    nodes = np.unique(np.concatenate([mesh.markers[name] for name in names]))
    if len(numbers) == mesh.node_count:
        return nodes, numbers[nodes]
    if len(numbers) == len(nodes):
        return nodes, numbers
    raise UsageError(f"found {len(numbers)} rows, expected {len(nodes)} for the nodes of {', '.join(names)}, or "
                     f"{mesh.node_count} for all nodes")


@documented("layers")
def layers(mesh, markers=None, *, walls=None, columns=None, **options):
    """Insert viscous layers at walls, or respace or hold those that a mesh has.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    markers : str or sequence of str
        Walls.
    walls : sequence of dict
        Walls with heights of their own: `markers`, the options under Heights, and xmin, xmax, ymin,
        ymax for a part of the markers.
    columns : dict
        What single wall nodes are to have: {17: {"columns": 1, "thickness": 0.01}}.
    y_plus, reynolds, reference_length : float
        In place of `first`: the wanted y+ of the first node by the friction of a flat plate, with the
        Reynolds number of the reference length (1).
    """
    _dicts("walls", walls)
    for name in ("y_plus", "reynolds", "reference_length"):
        if options.get(name) is not None:
            options[name] = _number(name, options[name], float)
    return _run("layers", _winslow.layers, mesh, options, markers, walls, _columns(columns))


@documented("scramble")
def scramble(mesh, **options):
    """Put every interior node at a random place: a test of smoothing (needs allow_inverted=True).

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    """
    return _run("scramble", _winslow.scramble, mesh, options)


def replay(recipe, mesh, **options):
    """Apply the commands of a recipe (docs/recipes.md) to a mesh, in order.

    Parameters
    ----------
    recipe : str or os.PathLike
        The recipe, JSON.
    mesh : Mesh
        The mesh to start from, as of `smooth`.
    **options
        reference, config, progress, allow_inverted, allow_incomplete, as of `move`.

    Returns
    -------
    Result
    """
    return _run("replay", _winslow.replay, mesh, options, os.fspath(recipe))


def quality(mesh, *, worst=10, bins=20, threads=0):
    """Measure a mesh.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    worst : int
        How many of the worst elements to list for each metric.
    bins : int
        Bins of the histograms.
    threads : int
        Threads; 0: all cores.

    Returns
    -------
    Quality
        A dict as `winslow quality --report` writes it.
    """
    if not 0 <= worst <= 1000000 or not 1 <= bins <= 1000 or not 0 <= threads <= 4096:
        raise UsageError("quality: expected worst from 0 to 1000000, bins from 1 to 1000, threads from 0 to 4096")
    return quality_of(as_mesh(mesh, show=True), worst, bins, threads)


def values(mesh, field, *, before=None):
    """A number for each element.

    Parameters
    ----------
    mesh : Mesh
        As of `quality`.
    field : str
        "normalized_jacobian", "aspect_ratio", ...: `fields(mesh)` lists them.
    before : Mesh, optional
        An earlier mesh, for "first_height_ratio".

    Returns
    -------
    numpy.ndarray (elements,) float64
        NaN for elements without a value.
    """
    return _winslow.values(as_mesh(mesh, show=True), field, None if before is None else as_mesh(before))


def fields(mesh):
    """The names that `values` and the colours of pictures take for a mesh: a list of str."""
    return _winslow.fields(as_mesh(mesh, show=True))

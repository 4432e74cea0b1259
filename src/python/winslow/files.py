"""Reading and writing meshes."""

import os
import warnings

from . import _winslow
from .errors import InputError, MeshWarning
from .foreign import as_mesh


def say(sentences, level=3):
    """Issues each sentence as a MeshWarning of the caller's caller."""
    for sentence in sentences:
        warnings.warn(sentence, MeshWarning, stacklevel=level)


def read(path, *, zone=0, regions="", time="", repair=False, show=False):
    """Read a mesh file.

    Parameters
    ----------
    path : str or os.PathLike
        SU2, Gmsh, CGNS, VTK, OpenFOAM, ...: docs/formats.md. The content decides the format.
    zone : int
        Number of the zone, of files that have several; 0: the first.
    regions : str
        Cell array of a VTK file whose whole numbers are the regions; "": one of the known names.
    time : str
        Time of an OpenFOAM case whose points have moved: "latest", or the name of its folder.
    repair : bool
        Mend the mesh first: points in one place, elements given twice or without area, ...
    show : bool
        Read what can be shown of a file that is no sound mesh. For pictures and measures alone.

    Returns
    -------
    Mesh

    Raises
    ------
    InputError
        The file cannot be read, or its content is wrong: `file`, `line` and `byte` say where.
    UsageError
        A zone or an array that the file does not have.

    Warns
    -----
    MeshWarning
        What the reader has to say; also in `Mesh.warnings`.
    """
    try:
        mesh = _winslow.read(os.fspath(path), zone, regions, time, repair, show)
    except InputError as error:
        error.file = error.file or os.fspath(path)
        raise
    say(mesh.warnings)
    return mesh


def write(mesh, path, *, binary=None, gmsh_version="", cgns_container="", overwrite=False):
    """Write a mesh file; its extension says the format.

    To a file of the format that the mesh was read from, everything else goes back as it was: comments,
    tags, the order and the words of the file.

    Parameters
    ----------
    mesh : Mesh
        Or whatever else is a mesh: see `as_mesh`.
    path : str or os.PathLike
        The file. It is written whole or not at all.
    binary : bool, optional
        Binary or text, where the format has both; None: as the source.
    gmsh_version : str
        "2.2" or "4.1"; "": that of the source, else 4.1.
    cgns_container : str
        "hdf5" or "adf"; "": that of the source, else hdf5.
    overwrite : bool
        Allow the file that the mesh was read from.

    Returns
    -------
    list of str
        What was lost.

    Raises
    ------
    OutputError
        The file cannot be written; it is as it was.
    UsageError
        An unknown extension, elements that the format cannot hold, the file that the mesh is from.
    """
    lost = _winslow.write(as_mesh(mesh), os.fspath(path), binary, gmsh_version, cgns_container, overwrite)
    say(lost)
    return lost


def convert(source, path, *, binary=None, gmsh_version="", cgns_container="", **reading):
    """Write a mesh file in another format: `read` and `write` in one.

    Parameters
    ----------
    source : str, os.PathLike or Mesh
        The mesh to read.
    path : str or os.PathLike
        The file to write; its extension says the format.
    binary, gmsh_version, cgns_container
        As of `write`.
    **reading
        The options of `read`: zone, regions, time, repair.

    Returns
    -------
    list of str
        What was lost.
    """
    mesh = read(source, **{"show": True, **reading}) if isinstance(source, (str, os.PathLike)) else as_mesh(source)
    return write(mesh, path, binary=binary, gmsh_version=gmsh_version, cgns_container=cgns_container)

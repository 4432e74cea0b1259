"""winslow: moves the bodies of unstructured meshes and repairs the mesh around them.

    import winslow

    mesh = winslow.read("flap.su2")
    result = winslow.move(mesh, "flap", rotate=-10, pivot=(0.8, 0))
    winslow.write(result.mesh, "moved.su2")

Functions: read, write, convert, smooth, untangle, move, deform, layers, scramble, replay, sweep,
quality, values, fields, render, from_meshio, from_pyvista; classes: Mesh, Deformer,
Sensitivity. A mesh may also be
a file, a mesh of meshio or pyvista, or (points, cells, cell_sets). docs/python.md has more.
"""

from ._winslow import Iteration, Mesh
from ._winslow import version as __version__
from .commands import deform, fields, layers, move, quality, replay, scramble, smooth, untangle, values
from .errors import (Cancelled, Error, IncompleteMotion, InputError, MeshError, MeshWarning, NumericError, OutputError,
                     UsageError)
from .files import convert, read, write
from .foreign import as_mesh, from_meshio, from_pyvista, to_meshio, to_pyvista
from .derivatives import Sensitivity
from .pictures import Picture, plot, render
from .results import Quality, Result
from .session import Deformer
from .series import Step, sweep

for _class in (Iteration, Mesh):
    _class.__module__ = __name__

__all__ = ["Cancelled", "Deformer", "Error", "IncompleteMotion", "InputError", "Iteration", "Mesh", "MeshError",
           "MeshWarning", "NumericError", "OutputError", "Picture", "Quality", "Result", "Sensitivity", "Step",
           "UsageError", "__version__", "as_mesh", "convert", "deform", "fields", "from_meshio", "from_pyvista",
           "layers", "move", "plot", "quality", "read", "render", "replay", "scramble", "smooth", "sweep", "to_meshio",
           "to_pyvista", "untangle", "values", "write"]

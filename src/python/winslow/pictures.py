"""Pictures of meshes, drawn without a display."""

import os

from . import _winslow
from .errors import Error
from .foreign import Mesh, as_mesh


class Picture:
    """A picture as the bytes of a PNG; a notebook shows it."""

    def __init__(self, png):
        self.png = png

    def _repr_png_(self):
        return self.png

    def save(self, path):
        """Write the PNG to a file."""
        with open(path, "wb") as out:
            out.write(self.png)

    def __repr__(self):
        width, height = (int.from_bytes(self.png[k:k + 4], "big") for k in (16, 20))
        return f"<winslow.Picture: {width} x {height} pixels>"


def render(mesh, path=None, **options):
    """Draw a mesh as a picture. Inverted elements are red.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    path : str or os.PathLike, optional
        File to write: .png, .svg or .pdf. None: the bytes of a PNG are returned.
    size : (int, int), default (1200, 900)
        Width and height in pixels.
    color : str
        Colour elements by a field, one of `fields(mesh)`; "none": plain, the default of plane meshes.
    range, percentiles : (float, float)
        Values at the ends of the colours; or percentiles of the values.
    map : str, default "automatic"
        Colours: viridis, cividis, glacier, plasma, magma, inferno, neutral, puor.
    axis : str, default "automatic"
        Spread the colours over differences ("linear") or ratios ("log") of values.
    title : str
        Line above the picture.
    dark, wireframe, legend : bool
        Dark background; edges of elements; colour bar.
    vcv : sequence of int
        Nodes whose virtual control volumes are drawn over the mesh.
    bounds : (float, float, float, float)
        Plane meshes: x0, y0, x1, y1 of the part to show.
    view : str
        Meshes in space: the side that they are seen from.
    up : str, default "z"
        Axis that is up on screen.
    azimuth, elevation : float
        Degrees, in place of those of `view`.
    perspective : bool
    centre : (float, float, float)
        Point in the middle of the picture.
    half_width : float
        Half of the width that is shown.
    cuts : sequence of (point, normal)
        Volume meshes: planes; what their normals point to is taken away. []: no cut. Default: through
        the middle of the bodies.
    crinkle : bool
        Cuts leave whole elements.
    isolate : float
        Show whole the elements whose field is worse than this.
    show, hide, see_through : str or sequence of str
        Markers to draw alone, not at all, or so that one sees through.

    Returns
    -------
    bytes or None
        A PNG; None where a file was written.

    Raises
    ------
    UsageError
        An option that is unknown, out of range, or not for this kind of mesh.
    Error
        There is no OpenGL (EGL), or the build has no graphics.
    """
    if not _winslow.draws:
        raise Error("this build of winslow has no graphics: build it with -DWINSLOW_BUILD_GUI=ON")
    png = _winslow.picture(as_mesh(mesh, show=True), "" if path is None else os.fspath(path), options)
    return png if path is None else None


def plot(mesh, **options):
    """The mesh as a picture that a notebook shows: `render` with its options."""
    return Picture(render(mesh, **options))


Mesh.plot = plot

"""Many motions of one mesh."""

import itertools
import os

from . import _winslow
from .errors import UsageError
from .foreign import as_mesh
from .tables import documented


class Step:
    """A step of a sweep.

    Attributes
    ----------
    step : int
        Its number, from 0 on.
    bodies : list of dict
        What moved: markers, rotate, translate, ...
    status : str
        "done", "not converged", "incomplete", "inverted" or "failed".
    message : str
        Why it is not done; "": it is.
    mesh : Mesh or None
        The mesh; None if the step failed, or once `keep=False` has handed it over.
    inverted, converged, fraction_reached, linear_solves
        As of `Result`; None if the step failed.
    begins : int or None
        The step from whose mesh it began; None: the mesh as given.
    seconds : float
        Wall-clock time.
    """

    def __init__(self, bodies, step):
        self.bodies = bodies
        for name in ("step", "status", "message", "mesh", "begins", "seconds"):
            setattr(self, name, step[name])
        for name in ("inverted", "converged", "fraction_reached", "linear_solves"):
            setattr(self, name, step.get(name))

    def __repr__(self):
        return f"<winslow.Step {self.step}: {self.status}{': ' if self.message else ''}{self.message}>"


def _steps(markers, rotate, translate, steps, motion):
    """All steps as lists of bodies."""
    if steps is not None:
        if markers is not None or rotate is not None or translate is not None:
            raise UsageError("found steps together with markers, rotate or translate: expected the motions in steps "
                             "alone")
        return [[body] if isinstance(body, dict) else list(body) for body in steps]
    if markers is None:
        raise UsageError("nothing to move: give markers, or motions by steps")
    if rotate is None and translate is None:
        raise UsageError("nothing to do: give rotate, translate, or motions by steps")
    angles = [None] if rotate is None else [float(angle) for angle in rotate]
    shifts = [None] if translate is None else list(translate)
    return [[{"markers": markers, **motion, **({} if angle is None else {"rotate": angle}),
              **({} if shift is None else {"translate": shift})}]
            for shift, angle in itertools.product(shifts, angles)]


@documented("sweep", """Returns
-------
list of Step
    In the order of the steps. A step that fails does not end the others and raises nothing.

Raises
------
UsageError
    Before anything is solved: an option out of range, a step that is no motion of this mesh.
Cancelled
    `on_step` returned False.""")
def sweep(mesh, markers=None, *, rotate=None, translate=None, steps=None, jobs=1, on_step=None, keep=True, **options):
    """Move bodies to many places, each from the mesh as given.

    Steps begin from the mesh of their nearest neighbour, so that each needs two or three linear solves.
    The results depend neither on the order nor on `jobs`.

    Parameters
    ----------
    mesh : Mesh
        Or a file, a mesh of meshio or pyvista, or (points, cells, cell_sets).
    markers : str or sequence of str
        Markers that move together.
    rotate : sequence of float
        Angles, degrees.
    translate : sequence of vectors
        Shifts. All combinations of angles and shifts are steps, those of the angles next to each other.
    steps : sequence
        In place of these: a list of bodies for each step, as `bodies` of `move`.
    jobs : int
        Steps at once, each on one thread; 0: all cores.
    on_step : callable
        Called with each `Step` as soon as it has ended, one at a time, from another thread than the
        caller's. Returning False ends the sweep; an exception does, too, and propagates.
    keep : bool
        Whether the steps that are returned keep their meshes: False saves memory where `on_step` has
        done with them.
    """
    mesh = as_mesh(mesh)
    if not isinstance(jobs, int) or not 0 <= jobs <= 4096:
        raise UsageError(f"jobs: found {jobs!r}, expected 0 to 4096")
    if on_step is not None and not callable(on_step):
        raise UsageError("on_step: expected a function of one argument, the step")
    for name in ("progress", "allow_inverted"):  # on_step takes the place of the one; all meshes are returned
        if name in options:
            raise UsageError(f"{name}: not an option of sweep, whose on_step gets every step")
    motion = {name: options.pop(name) for name in ("pivot", "axis") if name in options}
    wanted = _steps(markers, rotate, translate, steps, motion)
    if options.get("reference") is not None:
        options["reference"] = as_mesh(options["reference"])
    if options.get("config") is not None:
        options["config"] = os.fspath(options["config"])
    done = [None] * len(wanted)

    def take(given):
        step = Step(wanted[given["step"]], given)
        done[step.step] = step
        answer = on_step(step) if on_step else None
        if not keep:
            step.mesh = None
        return answer

    _winslow.sweep(mesh, wanted, jobs, take, options)
    return done

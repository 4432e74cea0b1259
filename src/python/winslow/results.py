"""What functions return: results of commands, qualities of meshes."""

import json

from . import _winslow
from .errors import IncompleteMotion
from .files import say


class Result:
    """The result of a command.

    Attributes
    ----------
    mesh : Mesh
        The mesh after the command. It shares the connectivity of the mesh before, but after an
        insertion of layers.
    inverted : int
        Number of inverted elements.
    converged : bool
        Whether the mesh is the solution to within the tolerance.
    fraction_reached : float
        Share of the motion that was carried out, 0 to 1.
    why_incomplete : str
        Why it is less than 1, a clause; "": it is 1.
    linear_solves : int
        Linear systems solved.
    history : list of Iteration
        All outer iterations.
    warnings : list of str
        Damage that may hurt a flow solver, bodies that nothing followed.
    remarks : list of str
        What the file says of its boundary and the run took over: markers that slide, periodic pairs.
    """

    def __init__(self, name, run):
        self._name, self._run = name, run
        self.mesh = run.mesh
        self.inverted = run.inverted
        self.converged = run.converged
        self.fraction_reached = run.fraction_reached
        self.why_incomplete = run.why_incomplete
        self.linear_solves = run.linear_solves
        self.warnings = run.warnings
        self.remarks = run.remarks

    @property
    def history(self):
        return self._run.history

    @property
    def complete(self):
        """Whether the motion was carried out whole, without an inverted element."""
        return self.inverted == 0 and not self.why_incomplete

    def report(self):
        """Everything that `--report` writes on the command line, as a dict; measures the quality."""
        return json.loads(self._run.report())

    def __repr__(self):
        state = "converged" if self.converged else "not converged"
        text = f"<winslow.Result of {self._name}: {state}, {self.inverted} inverted"
        if self.fraction_reached < 1 or self.why_incomplete:
            text += f", {100 * self.fraction_reached:.4g} % of the motion: {self.why_incomplete}"
        return f"{text}, {self.linear_solves} linear solves; {self.mesh!r}>"


def checked(name, run, allow_inverted, allow_incomplete):
    """The result, unless it is one to raise."""
    result = Result(name, run)
    fault = ""
    if result.inverted and not allow_inverted:
        fault = (f"the result has {result.inverted} inverted element{'s' if result.inverted > 1 else ''} "
                 "(allow_inverted=True returns it)")
    elif result.why_incomplete and not result.inverted and not allow_incomplete:
        fault = (f"the motion could be followed to {100 * result.fraction_reached:.6g} % only: {result.why_incomplete} "
                 "(allow_incomplete=True returns the mesh there)")
    if fault:
        raise IncompleteMotion(fault, result)
    if result.complete and not result.converged:
        result.warnings.append("not converged: within the limit of iterations, or with nothing gained any more")
    say(result.warnings, 4)
    return result


class Quality(dict):
    """The quality of a mesh: the dict that `winslow quality --report` writes.

    `quality["quality"]["normalized_jacobian"]` has min, avg and max; "worst" lists the worst elements,
    "histograms" the counts, "openfoam" what checkMesh would say of a volume mesh.
    """

    @property
    def inverted(self):
        """Number of inverted elements."""
        return self["inverted"]

    def min(self, metric):
        """Smallest value of a metric over all elements."""
        return self["quality"][metric]["min"]

    def max(self, metric):
        """Largest value of a metric over all elements."""
        return self["quality"][metric]["max"]

    def mean(self, metric):
        """Mean value of a metric over all elements."""
        return self["quality"][metric]["avg"]

    def __repr__(self):
        rows = [f"  {name:24}{v['min']!s:>24}{v['avg']!s:>24}{v['max']!s:>24}" for name, v in self["quality"].items()]
        return "\n".join([f"<winslow.Quality: {self['elements']} elements, {self['inverted']} inverted",
                          f"  {'':24}{'min':>24}{'mean':>24}{'max':>24}", *rows]) + ">"


def quality_of(mesh, worst, bins, threads):
    return Quality(json.loads(_winslow.quality(mesh, worst, bins, threads)))

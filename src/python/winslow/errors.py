"""The exceptions of winslow: everything that a function of this package raises on purpose.

All derive from `Error`. A message is one sentence for the user, as the program `winslow` would say it.
"""

import re

_PLACE = re.compile(r"(?P<file>.+?):(?:(?P<line>\d+)|(?: [^:]*:)* byte (?P<byte>\d+)): ", re.S)


class Error(Exception):
    """Base of all exceptions of this package."""


class UsageError(Error, ValueError):
    """An argument or an option that is unknown, out of range, or does not suit the mesh."""


class InputError(Error, OSError):
    """A file that cannot be read or has wrong content.

    Attributes
    ----------
    file : str or None
        The file, as it was named.
    line : int or None
        The line, counted from 1; None where the file is binary or the fault has no place.
    byte : int or None
        The byte, counted from 0, of a binary file.
    """

    def __init__(self, message="", *more):
        super().__init__(message, *more)
        found = _PLACE.match(str(message))
        self.file = found["file"] if found else None
        self.line = int(found["line"]) if found and found["line"] else None
        self.byte = int(found["byte"]) if found and found["byte"] else None


class OutputError(Error, OSError):
    """A file that cannot be written. The file is as it was."""


class MeshError(Error, ValueError):
    """Arrays that are no mesh, for example with a node that does not exist.

    Attributes
    ----------
    entity : str
        What is wrong: "node", "element", "marker_face" or "mesh".
    index : int or None
        Which of them, counted from 0.
    elements, nodes : list of int
        The element or the node, if it is one.
    """

    def __init__(self, message="", entity="mesh", index=-1):
        super().__init__(message)
        self.entity = entity
        self.index = index if index >= 0 and entity != "mesh" else None
        self.elements = [index] if entity == "element" and index >= 0 else []
        self.nodes = [index] if entity == "node" and index >= 0 else []


class NumericError(Error, ArithmeticError):
    """A numerical failure: a singular matrix, a mesh of which no solution is found."""


class Cancelled(Error):
    """The progress callback returned False. Nothing is changed."""


class IncompleteMotion(Error):
    """The result has inverted elements, or the motion could not be completed.

    Attributes
    ----------
    result : Result
        The result all the same: its mesh, how far the motion went, and why no farther.
    """

    def __init__(self, message="", result=None):
        super().__init__(message)
        self.result = result


class MeshWarning(UserWarning):
    """What is harmless, or may be: what a reader, a motion or a writer has to say about a mesh."""

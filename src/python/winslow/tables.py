"""Docstrings and signatures that the program's tables of options say."""

import ast
import inspect
import textwrap

from . import _winslow

_WIDTH = 100

# What functions take besides the options of the tables: name, type, default, help.
COMMON = [
    ("allow_inverted", "bool", "False", "Return a mesh with inverted elements, too, instead of raising"),
    ("config", "Optional[PathLike]", "None", "Configuration file of SU2: its markers of symmetry slide, its periodic "
                                             "ones move together"),
    ("progress", "Optional[Callable[[Iteration], Any]]", "None",
     "Called with each iteration; returning False cancels, an exception ends the run and propagates"),
]
MOTION = [
    ("reference", "Optional[MeshLike]", "None", "Mesh of the same connectivity whose element shapes motions keep, in "
                                                "place of `mesh`: the mesh before the first of several motions"),
    ("allow_incomplete", "bool", "False", "Return the last valid mesh of a motion that could not be completed"),
    ("hold_layers", "Union[str, Sequence[str]]", "()", "Walls whose layers, as the mesh has them, keep their heights"),
    ("min_quality", "Optional[Dict[str, float]]", "None",
     "Limits by the names of metrics: the motion ends before any element is worse"),
]


def own_options(function):
    """The options of a function that stand in no table."""
    if function in ("move", "deform"):
        return MOTION + COMMON
    if function == "sweep":
        return MOTION + COMMON[1:2]
    if function == "deformer":
        return [row for row in MOTION if row[0] in ("reference", "min_quality", "hold_layers")] + COMMON[1:2]
    if function == "sensitivity":
        return COMMON[1:]
    return COMMON


def _wrapped(text):
    return textwrap.fill(text, _WIDTH, initial_indent="    ", subsequent_indent="    ", break_long_words=False,
                         break_on_hyphens=False)


def _entry(row):
    """One option in a docstring."""
    shown = row["shown"]
    lines = [f"{row['name']} : {row['type']}" + (f", default {shown}" if shown else "")]
    text = row["help"] + (f", {row['unit']}" if row["unit"] else "")
    text += (f" ({row['range']})" if row["range"] else "") + "."
    lines.append(_wrapped(text + (" " + row["advice"] if row["advice"] else "")))
    lines += [_wrapped(f"{name!r}: {help_}" if help_ else repr(name)) for name, help_ in row["choices"]]
    return "\n".join(lines)


def option_text(function):
    """The options of a function, as its docstring has them."""
    parts = []
    for heading, rows in _winslow.tables_of(function):
        parts.append("\n".join([heading, "-" * len(heading), *map(_entry, rows)]))
    own = [f"{name} : {kind}, default {default}\n{_wrapped(help_ + '.')}"
           for name, kind, default, help_ in own_options(function)]
    parts.append("\n".join(["Other Parameters", "-" * 16, *own]))
    return "\n\n".join(parts)


RETURNS = """Returns
-------
Result

Raises
------
IncompleteMotion
    The result has inverted elements, or the motion could not be completed; has `result`.
UsageError
    An unknown option, one out of range, or one that does not suit the mesh.
Cancelled, NumericError, InputError
    The callback said so; no solution was found; a file that an option names cannot be read."""


def _signature(function, name):
    """The signature with every option as a keyword."""
    given = [p for p in inspect.signature(function).parameters.values() if p.kind is not p.VAR_KEYWORD]
    rows = {row["name"]: row["default"] for _, table in _winslow.tables_of(name) for row in table}
    rows.update({row[0]: row[2] for row in own_options(name)})
    more = [inspect.Parameter(option, inspect.Parameter.KEYWORD_ONLY, default=ast.literal_eval(default))
            for option, default in rows.items()]
    return inspect.Signature(given + more)


def documented(name, returns=RETURNS):
    """Adds the options of the tables to the docstring and the signature of a function."""
    def decorate(function):
        text = inspect.getdoc(function)
        function.__doc__ = f"{text}\n\n{option_text(name)}\n\n{returns}\n"
        function.__signature__ = _signature(function, name)
        return function

    return decorate

#!/usr/bin/python3
"""Writes the stub of the Python package and the tables of docs/python.md, from the package itself:
PYTHONPATH=build/release/python make_python.py

The stub src/python/winslow/__init__.pyi is __init__.pyi.in with the options of the program's tables and the
docstrings. With --check nothing is written: the exit status is 1 if a file is not what it should be.
"""
import inspect
import re
import sys
import textwrap
from pathlib import Path

import winslow
from winslow import _winslow, errors, tables

ROOT = Path(__file__).resolve().parent.parent
STUB = ROOT / "src" / "python" / "winslow" / "__init__.pyi"
PAGE = ROOT / "docs" / "python.md"
BLOCK = re.compile(r"(<!-- python (\w+) -->\n).*?(<!-- end of python -->)", re.S)
# Attributes of exceptions, and their types.
ATTRIBUTES = {
    "InputError": "file: Optional[str]\nline: Optional[int]\nbyte: Optional[int]",
    "MeshError": "entity: Literal[\"mesh\", \"node\", \"element\", \"marker_face\"]\nindex: Optional[int]\n"
                 "elements: List[int]\nnodes: List[int]",
    "IncompleteMotion": "result: Result",
}


def quoted(text, indent):
    """A docstring."""
    body = textwrap.indent(inspect.cleandoc(text or "").replace("\\", "\\\\"), indent).strip()
    lines = "\n" in body
    return f'{indent}"""{body}' + (f"\n{indent}" if lines else "") + '"""'


def error_classes():
    parts = []
    for name in [n for n in vars(errors) if inspect.isclass(getattr(errors, n))]:
        kind = getattr(errors, name)
        bases = ", ".join(base.__name__ for base in kind.__bases__)
        attributes = textwrap.indent(ATTRIBUTES.get(name, ""), "    ")
        parts.append(f"class {name}({bases}):\n{quoted(kind.__doc__, '    ')}\n"
                     + (f"\n{attributes}\n" if attributes else ""))
    return "\n".join(parts)


def options_of(name):
    """name: type = default, of every option of a function that its table or all functions have."""
    rows = {row["name"]: (row["type"], row["default"]) for _, table in _winslow.tables_of(name) for row in table}
    rows.update({row[0]: (row[1], row[2]) for row in tables.own_options(name)})
    return [f"{option}: {kind} = {default}" for option, (kind, default) in rows.items()]


def documented(name):
    """Functions whose keywords the tables say."""
    return name in ("smooth", "move", "deform", "layers", "scramble", "sweep", "sensitivity", "deformer")


def function(declaration, indent, kind):
    """The stub of a function: its declaration with the options of the tables, and its docstring. kind: its class."""
    name, arguments, result = re.fullmatch(r"def (\w+)\((.*)\) -> (.*)", declaration).groups()
    whole = kind.lower() if name == "__init__" else name
    parts = re.split(r", (?![^\[]*\])", arguments)
    if documented(whole):
        parts += ["*"] * ("*" not in parts) + options_of(whole)
    text = getattr(winslow, kind).__init__.__doc__ if name == "__init__" else getattr(winslow, name).__doc__
    lines = textwrap.fill(", ".join(p.replace(" ", "\0") for p in parts), 118 - len(indent) - 4,
                          break_long_words=False, break_on_hyphens=False).replace("\0", " ")
    return (f"{indent}def {name}(\n{textwrap.indent(lines, indent + '    ')}\n{indent}) -> {result}:\n"
            f"{quoted(text, indent + '    ')}\n")


def stub():
    out, kind = [], ""
    for line in STUB.with_suffix(".pyi.in").read_text().splitlines():
        found = re.fullmatch(r"( *)#: (.*)", line)
        kind = line[6:].split(":")[0].split("(")[0] if line.startswith("class ") else kind
        if not found:
            out.append(line)
        elif found[2] == "errors":
            out.append(error_classes().rstrip())
        elif found[2].startswith("doc "):
            out.append(quoted(getattr(winslow, found[2][4:]).__doc__, found[1]))
        else:
            out.append(function(found[2], found[1], kind))
    made = "# Made by docs/make_python.py from the tables of the program: changes here are lost."
    return "\n".join([made, *out]).rstrip() + "\n"


def first_sentence(text):
    return " ".join(inspect.cleandoc(text).split("\n\n")[0].split()).replace("|", "\\|").rstrip(".")


def table_of(kind):
    """A table of docs/python.md."""
    if kind == "errors":
        rows = [(name, ", ".join(f"`{base.__name__}`" for base in getattr(errors, name).__bases__),
                 first_sentence(getattr(errors, name).__doc__))
                for name in vars(errors) if inspect.isclass(getattr(errors, name))]
        return "| exception | is a | when |\n|---|---|---|\n" + "".join(f"| `{n}` | {b} | {t} |\n" for n, b, t in rows)
    names = [name for name in winslow.__all__ if inspect.isfunction(getattr(winslow, name))]
    return "| function | |\n|---|---|\n" + "".join(
        f"| `{name}` | {first_sentence(getattr(winslow, name).__doc__)} |\n" for name in names)


def main(check):
    wanted = {STUB: stub()}
    if PAGE.exists():
        wanted[PAGE] = BLOCK.sub(lambda block: block[1] + table_of(block[2]) + block[3], PAGE.read_text())
    stale = [path for path, text in wanted.items() if not path.exists() or path.read_text() != text]
    if check and stale:
        sys.exit(f"not as the package says: {', '.join(p.name for p in stale)}; run docs/make_python.py")
    for path in stale:
        path.write_text(wanted[path])


if __name__ == "__main__":
    if any(argument != "--check" for argument in sys.argv[1:]):
        sys.exit(__doc__)
    main("--check" in sys.argv)

#!/usr/bin/env python3
"""Makes a source of the examples in the public headers, for the compiler to check: header_examples.py FOLDER

FOLDER: where winslow.h is. An example is the indented part of the comment before a header's namespace.
Each becomes a function of its own; what it takes for granted are the arguments of that function. The exit
status is 1 if a header that winslow.h names has none.
"""
import re
import sys
from pathlib import Path

GIVEN = ["winslow::MeshState state", "winslow::Mesh mesh", "winslow::Command command", "winslow::Index node",
         "winslow::Coordinates x", "winslow::RigidMotion motion", "winslow::DragGrip grip",
         "winslow::CommandResult result", "winslow::SolverMonitor& monitor", "winslow::SolverCache& cache",
         "const winslow::EnergyProblem& problem", "const winslow::EquationProblem& equations",
         "const winslow::DeformCommand& bend_wing", "int steps", "const winslow::MeshData& data",
         "const winslow::MoveCommand& move", "const winslow::MovingBody& body",
         "const winslow::MeshSensitivity& sensitivity", "const winslow::Coordinates& derivative_by_nodes",
         "const std::vector<winslow::Index>& nodes", "const winslow::Coordinates& places"]
INCLUDES = ["winslow/winslow.h", "array", "chrono", "cstdio", "string", "thread", "vector"]


def example(text):
    """The lines of the examples of a header; none if it has none. They stand before the namespace or, in a
    header of several classes, in comments of their own before these. Equations are no examples."""
    head, *rest = re.split(r"^namespace winslow", text, maxsplit=1, flags=re.M)
    apart = re.findall(r"(?:^///.*\n)+(?=\n)", rest[0] if rest else "", re.M)
    code = []
    for block in (head, *apart):
        lines = [line[8:] for line in block.splitlines() if line.startswith("///     ")]
        code += ["} {"] * bool(code and lines) + [line for line in lines if not line.startswith("#")]
    return code if any(line.rstrip().endswith((";", "{")) for line in code) else []


def main(folder):
    named = re.findall(r'^#include "([^"]+)"', (folder / "winslow.h").read_text(), re.M)
    examples = {str(path.relative_to(folder)): example(path.read_text()) for path in sorted(folder.rglob("*.h"))}
    lacking = [header for header in named if header in examples and not examples[header]]
    print("".join(f"#include <{name}>\n" for name in INCLUDES))
    for number, (header, lines) in enumerate((h, e) for h, e in examples.items() if e):
        if header.startswith("core/version"):
            lines = lines[:1]
        body = "".join(f"    {line}\n" for line in lines)
        print(f"// {header}\nvoid example_{number}({', '.join(GIVEN)}) {{\n  {{\n{body}  }}\n}}\n")
    if lacking:
        sys.exit("no example of how it is used: " + ", ".join(lacking))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]))

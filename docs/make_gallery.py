#!/usr/bin/python3
"""Runs the paper's cases, draws them, and prints the README's table: make_gallery.py WINSLOW

The column "pointwise" counts the linear solves of the same case with the paper's operator.
Pictures go to docs/pictures. Needs no display, but ImageMagick, which puts the pictures of case A
side by side for the README's head and makes the files small.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "tests" / "cases"))
from winslow_cases import CASES, ROOT, run, run_steps  # noqa: E402

PICTURES = HERE / "pictures"
PAPERS_METHOD = ["--formulation", "pointwise", "--outer", "picard"]


def draw(winslow, mesh, picture, view, title):
    done = run(winslow, ["render", mesh, "-o", picture, "--color", "normalized_jacobian", "--range", 0, 1,
                         "--bounds", *view, "--size", 900, 675, "--title", title, "--quiet"])
    if done.returncode != 0:
        sys.exit(done.stderr)


def solve(winslow, case, folder, stem, options=()):
    """Report and mesh of a case with these options of smoothing."""
    steps = [step if step[0] == "scramble" else [*step, *options] for step in case["steps"]]
    done, report, out = run_steps(winslow, steps, ROOT / "assets" / case["mesh"], folder, stem)
    if done.returncode != 0:
        sys.exit(f"case {stem}: {done.stderr}")
    return report, out


def row(case, report, papers):
    def numbers(metric, *keys):
        return " / ".join(f"{report['quality'][metric][key]:.3f}" for key in keys)

    paper = case["paper"]
    return (f"| **{case['name']}** {case['title']} | {report['inverted']} "
            f"| {numbers('normalized_jacobian', 'min', 'avg')} | {paper['normalized_jacobian']} "
            f"| {numbers('aspect_ratio', 'avg', 'max')} | {paper['aspect_ratio']} "
            f"| {numbers('condition_number', 'avg', 'max')} | {paper['condition_number']} "
            f"| {report['linear_solves']} | {papers['linear_solves']} "
            f"| [before](docs/pictures/{case['name']}_before.png), "
            f"[after](docs/pictures/{case['name']}_after.png) |")


def main():
    winslow = str(Path(sys.argv[1]).resolve())
    PICTURES.mkdir(exist_ok=True)
    print("| case | inverted | sine min / avg | paper | R/2r avg / max | paper | condition avg / max | paper "
          "| linear solves | pointwise | pictures |\n|---|---|---|---|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for case in CASES:
            mesh = ROOT / "assets" / case["mesh"]
            report, out = solve(winslow, case, folder, case["name"])
            papers, _ = solve(winslow, case, folder, f"{case['name']}_pointwise", PAPERS_METHOD)
            before = mesh
            if case["name"] != "E":  # what smoothing is given: the boundary moved, the interior not
                before = Path(folder) / "before.su2"
                command, *options = case["steps"][0]
                still = [] if command == "scramble" else ["--no-smooth", "--allow-inverted"]
                run(winslow, [command, mesh, "-o", before, *options, *still, "--quiet"])
            name, view = case["name"], case["view"]
            draw(winslow, before, PICTURES / f"{name}_before.png", view, f"{name}: before smoothing")
            draw(winslow, out, PICTURES / f"{name}_after.png", view, f"{name}: smoothed")
            print(row(case, report, papers), flush=True)
    subprocess.run(["convert", PICTURES / "A_before.png", PICTURES / "A_after.png", "+append",
                    PICTURES / "head.png"], check=True)
    drawn = [PICTURES / f"{case['name']}_{when}.png" for case in CASES for when in ("before", "after")]
    subprocess.run(["mogrify", "-colors", "128", "+dither", *drawn, PICTURES / "head.png"], check=True)


main()

#!/usr/bin/python3
"""Draws the small pictures of the guided demos: make_demo_pictures.py WINSLOW

Each case is run on its coarse mesh, and the place that its demo looks at is drawn as the welcome page
shows it, into assets/demos. Needs no display.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FOLDER = ROOT / "assets" / "demos"
SIZE = (192, 120)  # pixels, twice as fine as shown

# Commands of the case, and the part of the plane that tells it from the others; of a volume mesh how it
# is looked at.
CASES = {
    "A": ("naca0012.su2", [["move", "--marker", "airfoil", "--rotate", "-90", "--pivot", "0.5", "0",
                            "--translate", "2", "-2"]], (1.3, -2.7, 3.7, -1.3)),
    "B": ("naca0012.su2", [["move", "--marker", "airfoil", "--rotate", "178", "--pivot", "0.5", "0"]],
          (-0.4, -0.55, 1.4, 0.55)),
    "C": ("three_element.su2", [["scramble", "--seed", "1", "--allow-inverted"]], (-0.2, -0.45, 1.25, 0.45)),
    "D": ("three_element.su2", [["move", "--marker", "flap", "--rotate", "-40", "--pivot", "0.848",
                                 "-0.036"]], (0.7, -0.28, 1.15, 0.03)),
    "E": ("quads.su2", [["smooth", "--targets", "element"]], (-1.7, -0.7, 0.5, 0.675)),
    "F": ("circle.su2", [["layers", "--marker", "circle"]], (0.0, 0.12, 0.72, 0.57)),
    "H": ("sphere.su2.gz", [["smooth", "--formulation", "pointwise", "--outer", "picard", "--vcv", "adjusted"]],
          ["--cut", 0, 0, 0, 0, -1, 0, "--centre", 0, 0, 0, "--half-width", 2.6]),
    "I": ("cube.su2.gz", [["move", "--marker", "cube", "--rotate", "60", "--axis", "0", "1", "0",
                           "--translate", "1", "0", "0.5"]],
          ["--cut", 0, 0, 0, 0, -1, 0, "--centre", 0.7, 0, 0.3, "--half-width", 3]),
    "J": ("wing.su2.gz", [["move", "--marker", "flap", "--rotate", "-15", "--axis", "0.2755", "0.018", "1.5",
                           "--pivot", "0.848", "-0.036", "0"]],
          ["--up", "y", "--cut", 0, 0, 0.5, 0, 0, 1, "--azimuth", 35, "--elevation", 20,
           "--centre", 0.5, 0, 0.35, "--half-width", 0.8]),
    "G": ("three_element.su2", [["deform", "--marker", "main", "--sine", "-0.04", "4"]],
          (-0.1, -0.35, 1.1, 0.35)),
}


def run(*arguments):
    done = subprocess.run([str(a) for a in arguments], capture_output=True, text=True, check=False)
    # 4: the scrambled mesh has inverted elements, which is what its picture shows.
    if done.returncode not in (0, 4):
        sys.exit(f"{arguments}: {done.stderr}")


def main():
    winslow = Path(sys.argv[1]).resolve()
    FOLDER.mkdir(exist_ok=True)
    with tempfile.TemporaryDirectory() as name:
        for letter, (mesh, steps, view) in CASES.items():
            source = ROOT / "assets" / "coarse" / mesh
            for number, (command, *options) in enumerate(steps):
                out = Path(name) / f"{letter}{number}.su2"
                run(winslow, command, source, "-o", out, *options, "--quiet")
                source = out
            run(winslow, "render", source, "-o", FOLDER / f"{letter}.png", "--size", *SIZE, *(["--bounds", *view] if isinstance(view, tuple) else view),
                "--color", "normalized_jacobian", "--range", 0, 1, "--no-legend", "--quiet")


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""Draws the pictures of docs/studio.md, and the README's of the studio, from the program itself:
make_tour.py WINSLOW [NAME ...]

Each picture is a script of the studio ("winslow studio --headless --script"), so the tour shows what
the program does today. With names, only those pictures are drawn. Needs no display; where ffmpeg is
installed the files are made small with a palette of their own colours.
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PICTURES = ROOT / "docs" / "pictures" / "tour"
SIZE = (1200, 750)
README_PICTURE = "studio"  # one level up, and larger
README_SIZE = (1440, 900)
NACA = ROOT / "assets" / "naca0012.su2"
CIRCLE = ROOT / "assets" / "circle.su2"
SPHERE = ROOT / "assets" / "coarse" / "sphere.su2.gz"
WING = ROOT / "assets" / "three_element.su2"
WING_IN_SPACE = ROOT / "assets" / "coarse" / "wing.su2.gz"
BUMPY = ROOT / "assets" / "coarse" / "bumpy.obj.gz"
PART = ROOT / "assets" / "coarse" / "part.obj.gz"
CUBE_IN_SPACE = ROOT / "assets" / "coarse" / "cube.su2.gz"
# Seen from aslant, the y axis upright.
ASLANT = "click tab/view\nclick view/up\nclick \"view/up/y axis\"\nkey 7\nclick tab/quality\n"

# Name: (mesh or None, script; the picture is taken at its end).
TOUR = {
    README_PICTURE: (WING, "click marker/flap\nfill motion/pivot_x 0.848\nfill motion/pivot_y -0.036\n"
                           "fill motion/rotate -10\nclick motion/apply\nwait\n"
                           "look 0.55 0 0.62\naway\nwait\n"),
    "welcome": (None, "away\nwait\n"),  # the pictures on its cards are drawn in time
    "window": (NACA, ""),
    "drag": (NACA, "click 0.3 0.03\nwait\npress 0.3 0.03\nmove 0.32 -0.05\nmove 0.35 -0.12\n"
                   "move 0.4 -0.2\nwait\n"),
    "gizmo": (NACA, "key Tab\nlook 0.8 0 0.6\nwait\npress 0.5 0\nmove 0.52 0.01\nmove 0.55 0.03\n"
                    "key X\nmove 0.6 0.1\nmove 0.65 0.2\nwait\n"),
    "shape": (NACA, "click section/shape\nkey E\nlook 0.65 0.05 0.5\nwait\npress 0.4 0.058\n"
                    "move 0.4 0.08\nmove 0.4 0.11\nwheel 0.4 0.13 9\nmove 0.4 0.14\nwait\n"),
    "layers": (CIRCLE, "click 0.5 0\nclick section/motion\nclick section/layers\n"
                       "look 0.25 0.25 0.55\nwait\naway\nwait\n"),
    "layers_in": (CIRCLE, "click 0.5 0\nclick section/motion\nclick section/layers\nwait\n"
                          "click layers/preview\nclick layers/insert\nwait\nkey Escape\n"
                          "click tab/view\nlook 0.25 0.25 0.55\naway\nwait\n"),
    "motion": (NACA, "click 0.5 0\nfill motion/rotate -90\nfill motion/dx 2\nfill motion/dy -2\n"
                     "click motion/apply\naway\nlook 2.5 -2 1\nwait\n"),
    "bodies": (WING, "click marker/slat\nfill motion/rotate 12\nclick motion/add_body\nclick marker/flap\n"
                     "fill motion/rotate -20\nfill motion/pivot_x 0.848\nfill motion/pivot_y -0.036\n"
                     "click motion/add_body\nlook 0.55 0 0.62\naway\nwait\n"),
    "solver": (NACA, "click menu/Edit\nwait 2\nclick menu/scramble\nwait\nkey Shift+N\naway\nwait\n"),
    "quality": (NACA, "click 0.5 0\nfill motion/rotate -40\nclick motion/apply\nwait\n"
                      "click tab/quality\naway\nwait\n"),
    "view": (NACA, "key Ctrl+D\nclick tab/view\naway\nlook 0.5 0 0.8\nwait\n"),
    "vcv": (NACA, "click tab/vcv\nwait\nlook 0.05 0 0.25\nwait\nclick 0.02 0.1\naway\nwait\n"),
    "vcv_edit": (NACA, "click tab/vcv\nwait\nlook 0.05 0.06 0.16\nwait\nclick 0.0246 0.1055\nwait 3\n"
                       "click vcv/pin\nclick vcv/row/1\nfill vcv/angle 110\nwait\naway\nwait\n"),
    "vcv_sphere": (SPHERE, "click tab/vcv\nwait\nkey K\nfill vcv/node 2419\nkey Enter\nwait\n"
                           "click vcv/pin\nclick vcv/large\naway\nwait\n"),
    "compare": (NACA, "click 0.5 0\nfill motion/rotate -40\nclick motion/apply\nwait\n"
                      "key Shift+G\nlook 0.5 0 0.8\naway\nwait\n"),
    "ghost": (NACA, "click 0.5 0\nfill motion/dy -0.2\nclick motion/apply\nwait\nkey Escape\n"
                    "key G\nlook 0.7 -0.05 0.5\naway\nwait\n"),
    "magnifier": (NACA, "click 0.5 0\nfill motion/rotate -40\nclick motion/apply\nwait\n"
                        "key Escape\nlook 0.5 0 0.8\nmove 0.883 -0.321\nkey Shift+M\naway\nwait\n"),
    "isolate": (NACA, "click 0.5 0\nfill motion/rotate -90\nclick motion/apply\nwait\n"
                      "key Escape\nlook 0.5 0 1\nclick section/go_to\nclick section/worst\nwait 3\n"
                      "key I\nwait\nfill isolate/threshold 0.7\naway\nwait\n"),
    "surface": (PART, "click menu/Edit\nwait 2\nclick menu/scramble\nwait\nkey Shift+N\nwait\nkey F\naway\nwait\n"),
    "surface_deviation": (BUMPY, "click menu/Edit\nwait 2\nclick menu/scramble\nwait\nkey Space\nwait\n"
                          "click tab/view\nclick view/color\nclick view/color/Deviation\n"
                          "click tab/quality\nkey F\naway\nwait\n"),
    "volume": (WING_IN_SPACE, ASLANT + "look 0.5 0 0.4 0.75\naway\nwait\n"),
    "volume_layers": (WING_IN_SPACE, ASLANT + "key Shift+C\nclick peel/on\nclick peel/marker\n"
                      "click peel/marker/flap\nfill peel/from 2\nfill peel/to 4\n"
                      "look 0.9 -0.05 0.5 0.5\naway\nwait\n"),
    "volume_ruler": (CUBE_IN_SPACE, "key Shift+C\nkey 7\nlook 0.3 0.3 -1 2.4\nwait\nkey R\n"
                     "click -1 -1 1\nclick 1 -1 1\nclick 1 -1 -1\naway\nwait\n"),
    "volume_compare": (CUBE_IN_SPACE, "click marker/cube\nfill motion/rotate 35\nfill motion/d_z 0.5\n"
                       "click motion/apply\nwait\nkey Escape\nkey Shift+G\nwait\nlook 0 0 0.2 2.6\n"
                       "away\nwait\n"),
    "volume_handle": (WING_IN_SPACE, ASLANT + "click marker/flap\nlook 0.95 -0.1 0.7 0.6\nwait\n"
                      "press gizmo/ring/z\nmove 1.2 -0.1 0.7\ntype -12\nwait\n"),
    "volume_region": (CUBE_IN_SPACE, "click marker/cube\nclick motion/keep_outside\n"
                      "click motion/keep_outside/Sphere\nclick motion/limits\n"
                      "click motion/min_quality_smallest_solid_angle/on\nlook 0 0 0 5\naway\n"
                      "wait\n"),
    "roles": (CIRCLE, "click marker_role/farfield\nwait\nclick markers/roles\nclick marker/circle\n"
                      "key F\naway\nwait\n"),
    "volume_roles": (CUBE_IN_SPACE, "click marker_role/farfield\nwait\nclick markers/features\n"
                     "click markers/roles\nkey Shift+C\nkey F\naway\nwait\n"),
    "demo": (None, "wait\nclick welcome/demo/C\nwait\nclick demo/next\nwait\naway\nwait\n"),
    "history": (NACA, "click 0.5 0\nfill motion/rotate -20\nclick motion/apply\nwait\n"
                      "fill motion/dx 0.3\nclick motion/apply\nwait\nkey Space\nwait\n"
                      "click tab/history\naway\nwait\n"),
    "commands": (NACA, "key Ctrl+P\nwait 3\ntype rec\nwait 3\n"),
    "picture": (NACA, "key Shift+F12\nwait 3\nclick picture/mesh_alone\naway\nwait 3\n"),
    "recording": (NACA, "click tool/record\naway\nwait 3\n"),
}


def shrink(path):
    """256 colours of the picture's own, where that saves something."""
    if not shutil.which("ffmpeg"):
        return
    small = path.with_suffix(".small.png")
    done = subprocess.run(
        ["ffmpeg", "-v", "error", "-y", "-i", path, "-vf",
         "split[a][b];[a]palettegen=max_colors=256[p];[b][p]paletteuse=dither=none", small],
        check=False)
    if done.returncode == 0 and small.stat().st_size < path.stat().st_size:
        small.replace(path)
    small.unlink(missing_ok=True)


def draw(winslow, name, mesh, script):
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"{name}.txt"
        file.write_text(script)
        readme = name == README_PICTURE
        picture = (PICTURES.parent if readme else PICTURES) / f"{name}.png"
        size = README_SIZE if readme else SIZE
        command = [winslow, "studio", "--headless", "--quiet", "--size", *map(str, size)]
        # The picture is the script's own: --screenshot would wait until a drag has settled.
        file.write_text(f'{script}screenshot "{picture}"\n')
        command += ["--script", file, *([mesh] if mesh else [])]
        done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=300)
        if done.returncode != 0:
            sys.exit(f"{name}: {done.stderr}")
        shrink(picture)
        print(f"{picture.relative_to(ROOT)}: {picture.stat().st_size // 1024} kB")


def main():
    winslow = str(Path(sys.argv[1]).resolve())
    PICTURES.mkdir(parents=True, exist_ok=True)
    for name in sys.argv[2:] or TOUR:
        draw(winslow, name, *TOUR[name])


if __name__ == "__main__":
    main()

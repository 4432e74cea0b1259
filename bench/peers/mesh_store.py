"""The meshes of the rows: bundled ones unpacked, others made by assets/make_volumes.py and kept in a cache."""
import gzip
import hashlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

ASSETS = Path(__file__).resolve().parents[2] / "assets"
MAKER = ASSETS / "make_volumes.py"


class NoMesh(Exception):
    """A mesh that cannot be had: a sentence."""


def default_cache():
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "winslow" / "meshes"


def python_with_numpy():
    """The first interpreter that has numpy; Debian's packages are only in its own."""
    for python in ("/usr/bin/python3", sys.executable):
        if os.access(python, os.X_OK) and subprocess.run([python, "-c", "import numpy"], capture_output=True,
                                                         check=False).returncode == 0:
            return python
    raise NoMesh("no Python with numpy to run assets/make_volumes.py (Debian: python3-numpy)")


class MeshStore:
    """Files of meshes. `folder` is for those of this run; `cache` is kept. Other sources of make_volumes.py have
    another folder in the cache, so a mesh there is never an old one."""

    def __init__(self, cache, folder, scramble, say):
        """scramble(mesh, out) writes a mesh with its interior nodes at random places; say: prints a line."""
        sources = sorted([MAKER, *(ASSETS / "meshgen").glob("*.py")])
        key = hashlib.sha256(b"".join(path.read_bytes() for path in sources)).hexdigest()[:12]
        self.cache, self.folder, self.scramble, self.say = cache / key, folder, scramble, say

    def path(self, mesh):
        """The SU2 file of a mesh. Throws NoMesh."""
        if mesh.scrambled:
            return self.scrambled(mesh)
        if not mesh.bundled:
            return self.made(mesh.made, msh=False)
        source = ASSETS / mesh.bundled
        if source.suffix != ".gz":
            return source
        target = self.folder / source.relative_to(ASSETS).with_suffix("").as_posix().replace("/", "-")
        if not target.exists():
            target.write_bytes(gzip.decompress(source.read_bytes()))
        return target

    def gmsh_files(self, mesh):
        """Geometry and mesh as Gmsh has them, without which its optimizers leave a mesh as it is. Throws NoMesh."""
        if not mesh.made:
            raise NoMesh("Gmsh did not make this mesh")
        msh = self.made(mesh.made, msh=True)
        return msh.with_suffix(".geo"), msh

    def scrambled(self, mesh):
        source = self.path(type(mesh)(made=mesh.made, bundled=mesh.bundled))
        target = self.folder / f"{source.stem}-scrambled.su2"
        if not target.exists():
            self.scramble(source, target)
        return target

    def made(self, name, msh):
        target = self.cache / f"{name}{'.msh' if msh else '.su2'}"
        if not target.exists():
            self.make(name, msh)
        return target

    def make(self, name, msh):
        if shutil.which("gmsh") is None:
            raise NoMesh(f"{name} is made by Gmsh, which is not installed (Debian: gmsh)")
        python = python_with_numpy()
        self.say(f"making {name} (kept in {self.cache}) ...")
        making = self.cache / f"making-{os.getpid()}"
        command = [python, "-B", str(MAKER), "--folder", str(making), *(["--msh"] if msh else []), name]
        try:
            making.mkdir(parents=True, exist_ok=True)
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                raise NoMesh(f"{name} was not made: {(done.stderr.strip().splitlines() or ['no reason given'])[-1]}")
            for file in (making / name).parent.iterdir():
                target = self.cache / Path(name).parent / file.name
                target.parent.mkdir(parents=True, exist_ok=True)
                os.replace(file, target)
        except OSError as error:
            raise NoMesh(f"{name} was not made: {error}") from error
        finally:
            shutil.rmtree(making, ignore_errors=True)

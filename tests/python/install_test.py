"""The package as it is installed by CMake, and as a wheel: imported outside of the build tree."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import zipfile

from support import ASSETS, PLAIN, ROOT, PackageTest, main

BUILD = pathlib.Path(os.environ.get("WINSLOW_BUILD_FOLDER", ""))
USE = """
import sys, winslow
assert winslow.__file__.startswith(sys.argv[1]), winslow.__file__
mesh = winslow.read(sys.argv[2])
result = winslow.move(mesh, "airfoil", rotate=-5)
assert result.inverted == 0 and result.mesh.points.shape == mesh.points.shape
print(winslow.__version__)
"""


@unittest.skipUnless(BUILD.name, "no build folder is given")
class Installed(PackageTest):
    def use(self, folder):
        environment = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "WINSLOW"))}
        run = subprocess.run([sys.executable, "-B", "-c", USE, str(folder), str(ASSETS / "coarse" / "naca0012.su2")],
                             cwd=self.folder, env={**environment, "PYTHONPATH": str(folder)}, capture_output=True,
                             text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        return run.stdout.strip()

    def test_installed_by_cmake(self):
        run = subprocess.run(["cmake", "--install", BUILD, "--prefix", self.folder, "--component", "python"],
                             capture_output=True, text=True, check=False, env=PLAIN)
        self.assertEqual(run.returncode, 0, run.stderr)
        package = self.folder / "lib" / "python3" / "dist-packages" / "winslow"
        names = {path.name for path in package.iterdir()}
        self.assertLessEqual({"__init__.py", "__init__.pyi", "py.typed", "errors.py"}, names)
        self.assertFalse(any(path.is_symlink() for path in package.iterdir()))
        self.use(package.parent)

    def test_wheel(self):
        # Where pip builds: not in the source tree, of which several runs may build at once.
        environment = {**PLAIN, "WINSLOW_BUILD_FOLDER": str(BUILD)}
        run = subprocess.run([sys.executable, "-m", "pip", "wheel", str(ROOT), "--no-build-isolation", "--no-deps",
                              "--quiet", "--wheel-dir", str(self.folder), "--disable-pip-version-check"],
                             cwd=self.folder, env=environment, capture_output=True, text=True, check=False)
        if "No module named pip" in run.stderr:
            self.skipTest("pip is not installed")
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        wheel, = self.folder.glob("winslow-*.whl")
        target = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(target)
        self.assertEqual(self.use(target), wheel.name.split("-")[1])
        self.assertTrue((target / "winslow" / "__init__.pyi").exists())


if __name__ == "__main__":
    main()

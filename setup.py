"""Builds the wheel of the Python package: its extension by CMake, the rest as it is.

Environment:
  WINSLOW_BUILD_FOLDER   a build folder of CMake with -DWINSLOW_BUILD_PYTHON=ON to take the extension from;
                         without it build/wheel-cmake is made, which takes minutes
  WINSLOW_CMAKE_ARGS     more arguments for CMake, such as -DWINSLOW_BUILD_GUI=OFF
"""

import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent


def version():
    text = (ROOT / "src" / "core" / "version.h").read_text()
    return ".".join(re.search(rf"#define WINSLOW_VERSION_{part} (\d+)", text)[1]
                    for part in ("MAJOR", "MINOR", "PATCH"))


class CMakeExtension(build_ext):
    """Has CMake make the extension, and copies it to where setuptools wants it."""

    def build_extension(self, ext):
        given = os.environ.get("WINSLOW_BUILD_FOLDER")
        folder = pathlib.Path(given or ROOT / "build" / "wheel-cmake").resolve()
        if not given:
            folder.mkdir(parents=True, exist_ok=True)
            generator = ["-G", "Ninja"] if shutil.which("ninja") else []
            subprocess.run(["cmake", "-S", str(ROOT), "-B", str(folder), *generator, "-DCMAKE_BUILD_TYPE=Release",
                            "-DWINSLOW_BUILD_PYTHON=ON", "-DWINSLOW_BUILD_APP=OFF", "-DWINSLOW_BUILD_TESTS=OFF",
                            "-DWINSLOW_UNITY=ON", f"-DPython_EXECUTABLE={sys.executable}",
                            *shlex.split(os.environ.get("WINSLOW_CMAKE_ARGS", ""))], check=True)
        subprocess.run(["cmake", "--build", str(folder), "--target", "winslow_python", "--parallel"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        target.parent.mkdir(parents=True, exist_ok=True)
        made = folder / "python" / "winslow" / target.name
        if not made.exists():
            raise SystemExit(f"{made}: is not there; the build folder is for another interpreter than {sys.executable}")
        shutil.copy2(made, target)


(ROOT / "build").mkdir(exist_ok=True)
setup(
    version=version(),
    packages=["winslow"],
    package_dir={"winslow": "src/python/winslow"},
    package_data={"winslow": ["py.typed", "*.pyi"]},
    ext_modules=[Extension("winslow._winslow", sources=[])],
    cmdclass={"build_ext": CMakeExtension},
    options={"build": {"build_base": "build/wheel"}, "egg_info": {"egg_base": "build"}},
    zip_safe=False,
)

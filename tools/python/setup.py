# SPDX-License-Identifier: BSD-3-Clause
"""pip install ./tools/python: the module with the library, its nodes, configs and pipelines beside it.

CMake builds them first, in build-pip/ of the repository, unless the environment variable POSEVOTE_BUILD
names a build folder that has them.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
MADE = os.environ.get("POSEVOTE_BUILD")
WORK = Path(MADE).resolve() / "pip" if MADE else SOURCE / "build-pip"


def version() -> str:
    text = (SOURCE / "CMakeLists.txt").read_text()
    return re.search(r"project\(posevote VERSION ([\d.]+)", text).group(1)


def cmake(*arguments: object) -> None:
    subprocess.run(["cmake", *map(str, arguments)], check=True)


def build() -> Path:
    """The folder of a build that can be installed."""
    if MADE:
        return Path(MADE).resolve()
    cmake("-S", SOURCE, "-B", WORK / "cmake", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
          "-DPOSEVOTE_PROGRAM=OFF", f"-DPython_EXECUTABLE={sys.executable}")
    cmake("--build", WORK / "cmake")
    return WORK / "cmake"


class BuildWithCMake(build_py):
    def run(self) -> None:
        super().run()
        made = build()
        package = Path(self.build_lib).resolve() / "posevote"
        staged = WORK / "staged"
        shutil.rmtree(staged, ignore_errors=True)
        for component in ("runtime", "pcl", "opencv", "python"):
            cmake("--install", made, "--prefix", staged, "--component", component, "--strip")
        libraries = next(staged.rglob("libposevote.so.*")).parent
        shutil.copytree(libraries.parent / "share" / "posevote", package / "share" / "posevote",
                        dirs_exist_ok=True)
        (package / "lib" / "posevote").mkdir(parents=True, exist_ok=True)
        for link in libraries.glob("libposevote.so.*"):
            if link.is_symlink():  # a wheel holds no links: the name that the loader asks for
                shutil.copy(link, package / "lib")
        for nodes in libraries.glob("posevote/*.so"):
            shutil.copy(nodes, package / "lib" / "posevote")
        for module in staged.rglob("_posevote.*"):
            shutil.copy(module, package)


class WithLibraries(Distribution):
    def has_ext_modules(self) -> bool:
        return True  # the wheel is for this Python and this machine


WORK.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    packages=["posevote"],
    package_data={"posevote": ["*.pyi", "py.typed"]},
    cmdclass={"build_py": BuildWithCMake},
    distclass=WithLibraries,
    options={"build": {"build_base": str(WORK / "setuptools")},
             "egg_info": {"egg_base": str(WORK)}},
)

"""The wheel: Python's files, and the extension as CMake builds it with the library inside.

BURNISH_BUILD names a build folder of the sources to build it in; without it there is one of its own.
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist
from setuptools.errors import SetupError

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    from wheel.bdist_wheel import bdist_wheel

ROOT = Path(__file__).resolve().parents[2]
BASE = ROOT / "build/setuptools"  # what setuptools leaves, besides the wheel


def version():
    text = (ROOT / "include/burnish/core.h").read_text()
    return ".".join(re.search(rf"#define BURNISH_VERSION_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))


class Build(build_ext):
    def build_extension(self, extension):
        folder = Path(os.environ.get("BURNISH_BUILD") or BASE / "cmake").resolve()
        if not (folder / "CMakeCache.txt").exists():
            options = ["-DCMAKE_BUILD_TYPE=Release", "-DBURNISH_PYTHON=ON", "-DBURNISH_TESTS=OFF", "-DBURNISH_SHARED=OFF"]
            subprocess.run(["cmake", "-S", ROOT, "-B", folder, f"-DPython3_EXECUTABLE={sys.executable}", *options], check=True)
        jobs = os.environ.get("BURNISH_JOBS") or str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", folder, "--target", "burnish_python", "-j", jobs], check=True)
        target = Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(folder / "bindings/python/_burnish.abi3.so", target)


class Sources(sdist):
    def run(self):
        raise SetupError("no sdist: the C sources are outside bindings/python; build a wheel in a checkout: pip wheel bindings/python")


class Wheel(bdist_wheel):
    def get_tag(self):
        return ("cp311", "abi3", super().get_tag()[2])  # later Pythons load it too


BASE.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    ext_modules=[Extension("burnish._burnish", sources=[], py_limited_api=True)],
    cmdclass={"build_ext": Build, "bdist_wheel": Wheel, "sdist": Sources},
    options={"build": {"build_base": str(BASE / "base")}, "egg_info": {"egg_base": str(BASE)}},
)

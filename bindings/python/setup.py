"""The sdist with the C sources, and the wheel with the extension as CMake builds it, the library inside.

BURNISH_BUILD names a build folder of the sources to build it in; without it there is one of its own.
BURNISH_CMAKE has more options for CMake, and BURNISH_URL is the address of the repository.
"""

import ast
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    from wheel.bdist_wheel import bdist_wheel

HERE = Path(__file__).resolve().parent
IN_SDIST = (HERE / "sources").exists()
ROOT = HERE / "sources" if IN_SDIST else HERE.parents[1]
BASE = (HERE if IN_SDIST else ROOT) / "build/setuptools"  # what setuptools leaves, besides the wheel
URL = os.environ.get("BURNISH_URL")
SYSTEM = {b"libc.so.6", b"libm.so.6", b"libdl.so.2", b"libpthread.so.0", b"ld-linux-x86-64.so.2", b"ld-linux-aarch64.so.1"}


def version():
    text = (ROOT / "base/include/burnish/core.h").read_text()
    return ".".join(re.search(rf"#define BURNISH_VERSION_{part} (\d+)", text)[1] for part in ("MAJOR", "MINOR", "PATCH"))


def state_license(path):
    """As an SPDX expression, which setuptools before 77 can't write."""
    text = re.sub("(?m)^Metadata-Version: .*", "Metadata-Version: 2.4", path.read_text(encoding="utf-8"), count=1)
    path.write_text(re.sub("(?m)^Summary: .*", r"\g<0>\nLicense-Expression: MIT", text, count=1), encoding="utf-8")


class Build(build_ext):
    def build_extension(self, extension):
        folder = Path(os.environ.get("BURNISH_BUILD") or BASE / "cmake").resolve()
        if not (folder / "CMakeCache.txt").exists():
            options = ["-DCMAKE_BUILD_TYPE=Release", "-DBURNISH_PYTHON=ON", "-DBURNISH_TESTS=OFF", "-DBURNISH_SHARED=OFF"]
            options += os.environ.get("BURNISH_CMAKE", "").split()
            subprocess.run(["cmake", "-S", ROOT, "-B", folder, f"-DPython3_EXECUTABLE={sys.executable}", *options], check=True)
        jobs = os.environ.get("BURNISH_JOBS") or str(os.cpu_count() or 1)
        subprocess.run(["cmake", "--build", folder, "--target", "burnish_python", "-j", jobs], check=True)
        (built,) = (folder / "bindings/python").glob("_burnish.*[od]")  # .abi3.so or .pyd
        target = Path(self.get_ext_fullpath(extension.name)).with_name(built.name)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(built, target)
        shutil.copyfile(folder / "bindings/python/_options.py", target.with_name("_options.py"))


class Modules(build_py):
    def run(self):
        super().run()
        self.run_command("build_ext")
        options = Path(self.get_finalized_command("build_ext").get_ext_fullpath("burnish._burnish")).with_name("_options.py")
        stub = Path(self.build_lib, "burnish/__init__.pyi")
        stub.write_text(ast.unparse(Stub(options).visit(ast.parse((HERE / "burnish/__init__.py").read_text()))))


class Stub(ast.NodeTransformer):
    """__init__.py as a stub whose functions name each option, for type checkers that do not know Unpack."""

    def __init__(self, options):
        tree = ast.parse(options.read_text())
        self.classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
        self.overloaded = None
        self.types = [node.targets[0].id for node in tree.body if isinstance(node, ast.Assign)][1:]  # not __all__

    def fields(self, name):
        node = self.classes.get(name)
        inherited = [field for base in node.bases for field in self.fields(base.id)] if node else []
        return inherited + [field for field in (node.body if node else []) if isinstance(field, ast.AnnAssign)]

    def visit_FunctionDef(self, node):
        if node.decorator_list:
            self.overloaded = node.name
        elif node.name == self.overloaded:
            return None  # the implementation
        arguments = node.args
        given = {argument.arg for argument in arguments.args + arguments.kwonlyargs}
        for field in self.fields(arguments.kwarg.annotation.slice.id) if arguments.kwarg else []:
            if field.target.id not in given:
                kind = ast.BinOp(field.annotation, ast.BitOr(), ast.Constant(None))
                arguments.kwonlyargs.append(ast.arg(field.target.id, kind))
                arguments.kw_defaults.append(ast.Constant(...))
        arguments.kwarg = None
        node.body = node.body[:1] if ast.get_docstring(node) else [ast.Expr(ast.Constant(...))]
        return None if re.match("_[^_]", node.name) else node

    def visit_If(self, node):
        return None  # imports for type checkers

    def visit_Import(self, node):
        return node if node.names[0].name == "os" else None

    def visit_ImportFrom(self, node):
        more = {"typing": ["Literal", "Union"], "_options": self.types}.get(node.module, [])
        names = [alias.name for alias in node.names if alias.name != "TYPE_CHECKING"]
        node.names = [ast.alias(name) for name in dict.fromkeys(names + more)]
        return node

    def visit_Assign(self, node):
        return node if node.targets[0].id in ("__all__", "Scene", "__slots__") else None

    def visit_Expr(self, node):
        return node if isinstance(node.value, ast.Constant) else None


class Sources(sdist):
    """Puts what CMake reads into the folder sources."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        state_license(Path(base_dir, "PKG-INFO"))
        sources = Path(base_dir, "sources")
        lobe = [f"lobe/{part}" for part in ("include", "spec", "theory", "program", "shaders", "scripts")]
        for folder in ("base", *lobe, "include", "src", "program", "scripts/cmake"):
            shutil.copytree(ROOT / folder, sources / folder)
        for file in (ROOT / "CMakeLists.txt", ROOT / "lobe/CMakeLists.txt", ROOT / "lobe/burnish-theory.pc.in", ROOT / "bindings/options.py", HERE / "CMakeLists.txt", *HERE.glob("*.[ch]")):
            target = sources / file.relative_to(ROOT)
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(file, target)


class Wheel(bdist_wheel):
    def egg2dist(self, egginfo_path, distinfo_path):
        super().egg2dist(egginfo_path, distinfo_path)
        state_license(Path(distinfo_path, "METADATA"))

    def get_tag(self):
        """Later Pythons load it too, and so does any Linux with the C library's symbols, if no other library is needed."""
        platform = super().get_tag()[2]
        if platform.startswith("win"):  # python3.dll has buffers from 3.11 on
            return ("cp311", "abi3", platform)
        extension = Path(self.get_finalized_command("build_ext").get_ext_fullpath("burnish._burnish")).read_bytes()
        if platform.startswith("linux_") and set(re.findall(rb"(?<=\0)(?:lib|ld-)[\w.+-]+\.so\.\d+(?=\0)", extension)) <= SYSTEM:
            newest = max(map(int, re.findall(rb"\0GLIBC_2\.(\d+)", extension)))
            platform = platform.replace("linux", f"manylinux_2_{newest}", 1)
        return ("cp39", "abi3", platform)


BASE.mkdir(parents=True, exist_ok=True)
setup(
    version=version(),
    project_urls={"Homepage": URL, "Source": URL, "Issues": f"{URL}/issues"} if URL else {},
    ext_modules=[Extension("burnish._burnish", sources=[], py_limited_api=True)],
    cmdclass={"build_ext": Build, "build_py": Modules, "bdist_wheel": Wheel, "sdist": Sources},
    options={"build": {"build_base": str(BASE / "base")}, "egg_info": {"egg_base": str(BASE)}},
)

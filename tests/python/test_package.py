"""What is in the wheel, and what it needs."""

import importlib.metadata
import re
import subprocess
import sys
import unittest
from pathlib import Path

import limn

FOLDER = Path(limn.__file__).parent


class Package(unittest.TestCase):
    def test_it_is_installed_with_its_stubs_and_libraries(self):
        names = {path.name for path in FOLDER.iterdir()}
        self.assertLessEqual({"__init__.py", "_limn.pyi", "py.typed", "open3d.py", "trimesh.py", "liblimn_tbb.so",
                              "liblimn_hwy.so"}, names)
        self.assertNotEqual(FOLDER.parents[1].name, "python")  # not the checkout's
        self.assertEqual(importlib.metadata.version("limn"), limn.__version__)

    def test_it_links_nothing_that_a_system_may_lack(self):
        allowed = re.compile(r"(liblimn_\w+\.so|(libstdc\+\+|libgcc_s|libm|libc|libpthread|libdl|librt|ld-linux[\w-]*)\.so\.\d+)$")
        for library in [*FOLDER.glob("_limn*.so"), *FOLDER.glob("liblimn_*.so")]:
            out = subprocess.run(["readelf", "-d", library], capture_output=True, text=True, check=True).stdout
            for needed in re.findall(r"\(NEEDED\).*\[(.*)\]", out):
                self.assertRegex(needed, allowed, library.name)
        module = next(FOLDER.glob("_limn*.so"))
        out = subprocess.run(["readelf", "-d", module], capture_output=True, text=True, check=True).stdout
        self.assertIn("[$ORIGIN]", out)

    def test_the_stable_interface_is_used_from_3_12_on(self):
        stable = next(FOLDER.glob("_limn*.so")).name == "_limn.abi3.so"
        self.assertEqual(stable, sys.version_info >= (3, 12))

    def test_the_stubs_name_all_that_there_is(self):
        stubs = (FOLDER / "_limn.pyi").read_text()
        compile(stubs, "_limn.pyi", "exec")
        from limn import _limn
        for name in vars(_limn):
            if not name.startswith("_"):
                self.assertRegex(stubs, rf"(?m)^(class|def) {name}\b|^{name}:")
        for name in vars(limn.CompiledScene):
            if not name.startswith("_"):
                self.assertRegex(stubs, rf"def {name}\(self")

    def test_everything_public_is_documented(self):
        for name in limn.__all__:
            if not name.startswith("__") and name != "INVALID_ID":
                self.assertTrue(getattr(limn, name).__doc__, name)
        for kind in (limn.CompiledScene, limn.Scene, limn.Mesh):
            for name, value in vars(kind).items():
                if not name.startswith("_") and callable(value):
                    self.assertTrue(value.__doc__ and "Args" in value.__doc__ or len(value.__doc__) > 60, name)

    def test_importing_it_loads_neither_open3d_nor_trimesh(self):
        code = "import sys, limn, limn.open3d, limn.trimesh; print(sorted({'open3d', 'trimesh'} & set(sys.modules)))"
        out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd="/").stdout
        self.assertEqual(out.strip(), "[]")


if __name__ == "__main__":
    unittest.main()

"""What is in the wheel, and what it needs."""

import ast
import importlib.metadata
import re
import subprocess
import sys
import tempfile
import textwrap
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
        from limn import _limn
        stubs = ast.parse((FOLDER / "_limn.pyi").read_text())
        classes = {node.name: node for node in stubs.body if isinstance(node, ast.ClassDef)}
        named = set(classes) | {node.name for node in stubs.body if isinstance(node, ast.FunctionDef)}
        named |= {node.target.id for node in stubs.body if isinstance(node, ast.AnnAssign)}
        self.assertLessEqual({name for name in vars(_limn) if not name.startswith("__")}, named)
        for name, node in classes.items():
            members = {member.name for member in node.body if isinstance(member, ast.FunctionDef)}
            there = {member for member in vars(getattr(_limn, name)) if not member.startswith("__")}
            self.assertEqual({member for member in members if not member.startswith("__")}, there, name)

    def test_a_type_checker_knows_right_from_wrong(self):
        right = """
            import numpy as np
            import limn
            scene = limn.Scene()
            number: int = scene.add(limn.Sphere((0, 0, 0), 1, limn.RoughConductor((0.9, 0.5, 0.2), (0.1, 0.4))))
            scene.add(limn.PointLight((0, 5, 0), (9, 9, 9)))
            scene.add(limn.Instance(limn.Sphere((0, 0, 0), 1, None), np.eye(4), None))
            scene.add(limn.Mesh(np.eye(3, dtype=np.float32), np.arange(3)[None], [limn.Metal((1, 1, 1))]))
            scene.environment = limn.make_sky(turbidity=4).environment
            hits = limn.first_hits(scene, limn.Camera(projection="panorama"), crop=(0, 0, 4, 4))
            depth: float = hits.depth.max()
            image = limn.render(scene.compile(), limn.Camera(look_from=np.zeros(3)))
            version: str = limn.__version__
        """
        wrong = ("limn.Sphere(0, 1)", "limn.Sphere(None, 1)", "limn.Scene().add(limn.Camera())",
                 "limn.Plastik((1, 1, 1), 0.5)",
                 "limn.Scene().environment = limn.Background.black()", "limn.render('scene', limn.Camera())",
                 "limn.NormalMap(limn.SolidColor((1, 1, 1)), limn.SolidColor((1, 1, 1)))", "limn.Camera((0, 0, 1))")
        program = textwrap.dedent(right) + "\n".join(wrong) + "\n"
        lines = program.split("\n")
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "program.py")
            path.write_text(program)
            out = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", folder, path], capture_output=True, text=True,
                                 cwd=folder).stdout
        found = {lines[int(line) - 1] for line in re.findall(r"(?m)^program\.py:(\d+): error", out)}
        self.assertEqual(found, set(wrong), out)

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

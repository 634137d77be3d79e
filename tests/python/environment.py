"""environment.py ROOT FOLDER PREFIX: a fresh virtual environment in FOLDER, with a wheel that is built of ROOT.

The wheel links the limn::core that is installed in PREFIX; with LIMN_FULL=1 it builds its own. Uses PyPI.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

NEEDS = ("numpy", "trimesh", "rtree", "mypy")  # of the tests


def main(root, folder, prefix):
    folder = Path(folder)
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([sys.executable, "-m", "venv", folder], check=True)
    pip = [folder / "bin/python", "-m", "pip", "--disable-pip-version-check", "--retries", "3"]
    options = []
    if os.environ.get("LIMN_FULL") != "1":
        options = ["--config-settings=cmake.define.LIMN_INSTALLED=ON", f"--config-settings=cmake.define.CMAKE_PREFIX_PATH={prefix}"]
    # Kept from run to run, so that only what has changed is compiled again.
    build = folder.with_name("build-core" if not options else "build")
    options += [f"--config-settings=build-dir={build}", "--config-settings=cmake.define.LIMN_WARNINGS_AS_ERRORS=ON"]
    subprocess.run([*pip, "wheel", "--no-deps", "-w", folder / "wheels", *options, root], check=True)
    (wheel,) = (folder / "wheels").glob("limn-*.whl")
    subprocess.run([*pip, "install", "-q", *NEEDS, wheel], check=True)
    print(wheel.name)


if __name__ == "__main__":
    main(*sys.argv[1:])

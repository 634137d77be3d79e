"""environment.py ROOT FOLDER PREFIX: a fresh virtual environment in FOLDER, with a wheel that is built of ROOT.

The wheel links the limn::core that is installed in PREFIX, and is compiled in a third of the time; with LIMN_FULL=1 it
builds its own, as users do. Uses PyPI.
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
    full = os.environ.get("LIMN_FULL") == "1"
    # Kept from run to run, so that only what has changed is compiled again.
    settings = {"build-dir": folder.with_name("build-core" if full else "build"), "cmake.define.LIMN_WARNINGS_AS_ERRORS": "ON"}
    if not full:
        settings |= {"cmake.define.LIMN_INSTALLED": "ON", "cmake.define.CMAKE_PREFIX_PATH": prefix,
                     "cmake.define.CMAKE_CXX_FLAGS_RELEASE": "-O1 -DNDEBUG", "cmake.define.CMAKE_UNITY_BUILD": "ON"}
    options = [f"--config-settings={name}={value}" for name, value in settings.items()]
    subprocess.run([*pip, "wheel", "--no-deps", "-w", folder / "wheels", *options, root], check=True)
    (wheel,) = (folder / "wheels").glob("limn-*.whl")
    subprocess.run([*pip, "install", "-q", *NEEDS, wheel], check=True)
    print(wheel.name)


if __name__ == "__main__":
    main(*sys.argv[1:])

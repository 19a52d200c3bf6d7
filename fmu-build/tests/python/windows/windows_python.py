"""Puts together a Python for Windows, with packages.

The package index has no Python for Windows, but its parts: panda3d's wheel brings the library of the interpreter and
the compiled half of the standard library; the other half is that of the Python that runs this, of the same version.

Arguments: folder, file with a list of packages.
"""

import importlib.util
import shutil
import subprocess
import sys
import sysconfig
import zipfile
from pathlib import Path

folder, packages = Path(sys.argv[1]), sys.argv[2]
# The environment may have been made by a pip that is not in it: that of the Python beneath.
has_pip = importlib.util.find_spec("pip") is not None
python = sys.executable if has_pip else Path(sys.base_prefix) / "bin" / "python3"
pip = [python, "-m", "pip", "--quiet", "--disable-pip-version-check"]
of_windows = ["--no-deps", "--only-binary", ":all:", "--platform", "win_amd64"]

subprocess.run([*pip, "download", *of_windows, "--dest", folder, "panda3d==1.10.16"], check=True)
(wheel,) = folder.glob("panda3d-*.whl")
with zipfile.ZipFile(wheel) as archive:
    for name in archive.namelist():
        # The C library is Wine's own.
        if name.startswith("deploy_libs/") and "api-ms-win" not in name:
            (folder / Path(name).name).write_bytes(archive.read(name))
wheel.unlink()
left_out = shutil.ignore_patterns("site-packages", "dist-packages", "lib-dynload", "config-*", "test", "__pycache__")
shutil.copytree(sysconfig.get_path("stdlib"), folder / "Lib", ignore=left_out)
target = folder / "Lib" / "site-packages"
subprocess.run([*pip, "install", *of_windows, "--target", target, "-r", packages], check=True)

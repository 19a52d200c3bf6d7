"""What the examples share: FMUs made from a changed scene. What drives them is the module `brinell`.

Nothing here is needed to use an FMU; it only keeps scene files out of the examples' way.
"""

import argparse
import os
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

try:
    import tomllib
except ModuleNotFoundError:  # Python 3.9 and 3.10
    import tomli as tomllib

ROOT = Path(__file__).resolve().parent.parent
SCENES = ROOT / "scenes"
# Where the wheel is not installed.
sys.path.append(str(ROOT / "fmu-build/module"))
from brinell.figures import whole  # noqa: E402
from brinell.host import Bearing, Instance, Numbers, unzipped  # noqa: E402, F401


def parser(about):
    """The command line of an example: the first line of its text, and the folder that it writes to."""
    found = argparse.ArgumentParser(description=about.splitlines()[0])
    found.add_argument("-o", "--output", type=Path, default=Path("target/examples"))
    return found


def changed_scene(base, name, changes, folder):
    """Writes the scene `base` under a new name with `changes`, as {"defect.length_deg": 5.0, "defect": None}.

    None takes a table or a key away. Gives the new file.
    """
    base, folder = Path(base), Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    scene = tomllib.loads(base.read_text(encoding="utf-8"))
    scene["name"] = name
    for key, value in changes.items():
        *tables, last = key.split(".")
        table = scene
        for part in tables:
            table = table.setdefault(part, {})
        if value is None:
            table.pop(last, None)
        else:
            table[last] = value
    lines, heads = [], []
    for key, value in scene.items():
        if isinstance(value, dict):
            heads.append((f"[{key}]", value))
        elif isinstance(value, list) and value and isinstance(value[0], dict):
            heads += [(f"[[{key}]]", table) for table in value]
        else:
            lines.append(f"{key} = {toml(value)}")
    for head, table in heads:
        lines += ["", head, *(f"{key} = {toml(value)}" for key, value in table.items())]
        # A scene names a file beside it: that of the base scene, or one that is in the folder already.
        if "defect" in head and "profile" in table and (base.parent / table["profile"]).is_file():
            shutil.copyfile(base.parent / table["profile"], folder / table["profile"])
    path = folder / f"{name}.toml"
    with whole(path) as part:
        part.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return path


def toml(value):
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml, value)) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {toml(part)}" for key, part in value.items()) + "}"
    return repr(value.item() if isinstance(value, np.generic) else value)


def program():
    """The words that call this project's program: what BRINELL_FMU says, else `brinell` if it is installed, else
    `cargo fmu`, which compiles it."""
    if "BRINELL_FMU" in os.environ:
        return shlex.split(os.environ["BRINELL_FMU"])
    installed = shutil.which("brinell")
    return [installed] if installed else ["cargo", "fmu"]


def healthy_and_spalled(folder):
    """Scenes of an ER16K whose shaft the host moves."""
    base = SCENES / "er16k-tb1-hosted-shaft.toml"
    healthy = changed_scene(base, "er16k-hosted-shaft", {"defect": None, "contact": None}, folder)
    return [healthy, changed_scene(base, "er16k-tb1-hosted-shaft", {}, folder)]


def build(scenes, folder, *options):
    """Builds the FMUs of scene files. Gives their paths: each has its scene's name, whatever the file's is.

    `options` are words of `brinell build`, as "--fmi", "3".
    """
    files = [str(Path(scene).resolve()) for scene in scenes]
    command = [*program(), "build", *files, "-o", str(Path(folder).resolve()), *options]
    subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    names = [tomllib.loads(Path(scene).read_text(encoding="utf-8"))["name"] for scene in scenes]
    return [Path(folder) / f"{name}.fmu" for name in names]


def percent(error):
    """An error as a cell of a table; above the motion itself it says no more than that."""
    if not error <= 1.0:
        return "> 100 %"
    return "100 %" if error >= 0.995 else f"{100 * error:.2g} %"

"""Rolling bearings with a real surface defect: FMUs, runs without a host, lengths of spalls from recordings.

    import brinell
    run = brinell.run("6205-epps", stop=0.1)
    run["sensor.acceleration"]

Everything is computed by the program ``brinell``, which this package brings along; ``brinell --help`` has more. A
scene is the path of a TOML file, or the name of a shipped scene (:func:`scenes`). All signals are in SI units. What
goes wrong is a :class:`BrinellError` with the program's own words; what it remarks is a :class:`BrinellWarning`.
"""

from __future__ import annotations

import contextlib
import importlib
import json
import os
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import warnings
from collections.abc import Iterable, Iterator
from importlib import metadata
from pathlib import Path
from typing import Any, Union

import numpy as np

from . import figures
from .results import Answer, Catalogue, Columns, Run, Sweep

__all__ = [
    "Answer",
    "BrinellError",
    "BrinellWarning",
    "Catalogue",
    "Columns",
    "Run",
    "Sweep",
    "build",
    "catalogue",
    "contact",
    "modes",
    "new",
    "program",
    "run",
    "scenes",
    "size",
    "stiffness",
    "sweep",
]

try:
    __version__ = metadata.version("brinell")
except metadata.PackageNotFoundError:
    # Imported from its source.
    __version__ = "0+source"

PathLike = Union[str, "os.PathLike[str]"]


def __getattr__(name: str) -> Any:
    """``brinell.ross`` without an import of its own: what it needs is loaded when it is asked for."""
    if name == "ross":
        return importlib.import_module(".ross", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


class BrinellError(RuntimeError):
    """The program refused or failed; the text is what it said."""


class BrinellWarning(UserWarning):
    """What the program remarks, as a value that was probably meant in another unit; the result is there."""


def program() -> str:
    """Path of the program: what the environment's ``BRINELL_PROGRAM`` names, else the one installed with this package,
    else one in the path."""
    if "BRINELL_PROGRAM" in os.environ:
        return os.environ["BRINELL_PROGRAM"]
    name = "brinell.exe" if os.name == "nt" else "brinell"
    folders = [sysconfig.get_path("scripts"), sysconfig.get_path("scripts", os.name + "_user")]
    for folder in [*folders, str(Path(sys.executable).parent)]:
        if folder and (Path(folder) / name).is_file():
            return str(Path(folder) / name)
    found = shutil.which(name)
    if found is None:
        raise BrinellError(f"the program {name} is not installed; it comes with the wheel of this package")
    return found


def build(
    scene: PathLike,
    output: PathLike = ".",
    *,
    platforms: str | Iterable[str] = (),
    fmi: int = 2,
    kind: str | None = None,
    names: str | None = None,
    scalars: bool = False,
    reference: bool = False,
) -> Path:
    """Builds the FMU of a scene into the folder ``output`` and gives its path.

    ``platforms``: "all", or any of linux64, win64, darwin64 and aarch64-linux; without it, all that the program holds.
    ``fmi``: version of the FMI standard, 2 or 3. ``kind``: "cs", the FMU integrates; "me", the host does; or "both".
    ``names``: "structured", as ``element[3].path``, or "flat", as ``element_3_path``. ``scalars``: FMI 3.0 without
    arrays. With ``reference`` the inputs, outputs and options of a reference run are written beside the FMU, and it holds
    them.
    """
    chosen = _options(
        fmi=fmi, platforms=_listed(platforms), kind=kind, names=names, scalars=scalars, reference=reference
    )
    said = _ask("build", os.fspath(scene), "--output", os.fspath(output), *chosen)
    return Path(said.splitlines()[-1])


def run(
    scene: PathLike | None = None,
    *,
    bearing: str | None = None,
    defect: str | None = None,
    stop: float | None = None,
    step: float | None = None,
    columns: str | Iterable[str] = (),
    speed_profile: PathLike | None = None,
    noise_db: float | None = None,
    noise_seed: int = 1,
) -> Run:
    """Runs a scene without a host, its inputs at their start values, and gives all inputs and outputs.

    Instead of a scene ``bearing`` names one of the catalogue, which is run as :func:`new` writes it, and ``defect`` its
    spall, as ``"inner:1.2mm"``. ``stop`` and ``step`` are the stop time and the communication step [s]; without them, the
    scene's. ``columns`` are the names wanted beside the time, of the recording, too, in which ``*`` stands for any
    characters; ``speed_profile`` is a CSV file with time_s and speed_hz; ``noise_db`` is the signal-to-noise ratio of the
    sensors.
    """
    options = _options(
        bearing=bearing, defect=defect, stop=stop, step=step, columns=_listed(columns) or "*",
        speed_profile=speed_profile, noise_db=noise_db, noise_seed=noise_seed if noise_db is not None else None,
    )  # fmt: skip
    with _written("run", *options, *([os.fspath(scene)] if scene is not None else [])) as (said, _, folder):
        # The table is named first, spectra behind it.
        table = _table(Path(said.splitlines()[0]))
        recordings = [np.load(path) for path in folder.glob("*.npy")]
    heads = {head: head.rpartition(" [") for head in table}
    signals = {name: table[head] for head, (name, _, _) in heads.items()}
    units = {name: unit.rstrip("]") for name, _, unit in heads.values()}
    return Run(signals, units, recordings[0] if recordings else None)


def size(
    recordings: PathLike | Iterable[PathLike],
    scene: PathLike | None = None,
    *,
    bearing: str | None = None,
    load: float | None = None,
    speed: float | str | Iterable[float | str] | None = None,
    rate: float | str | None = None,
    tacho: str | None = None,
    pulses: int = 1,
    speed_column: str | None = None,
    channel: str | int | None = None,
    column: str | int | None = None,
    delimiter: str | None = None,
    decimal: str | None = None,
    output: PathLike | None = None,
) -> Answer:
    """Length of a spall from recordings of one bearing, or why there is none: .csv, .tsv, .txt, .lvm, .npy, .npz, .mat,
    .wav, or texts of any other name.

    ``scene`` describes the bearing, or ``bearing`` names one of the catalogue and ``load`` [N] what it carries. One of
    ``speed`` ([Hz], or "1797rpm"; for all recordings or for each), ``tacho`` and ``speed_column`` says how the shaft
    turns; ``rate`` ([Hz], or "51.2kHz"), ``channel`` (or by its older name ``column``), ``delimiter`` and ``decimal``
    say what a file does not. Gives what ``brinell size`` prints as JSON; averaged passages are kept where ``output``
    names a folder.
    """
    files = [recordings] if isinstance(recordings, (str, os.PathLike)) else list(recordings)
    options = _options(
        scene=scene, bearing=bearing, load=load, speed=speed if isinstance(speed, (int, float)) else _listed([] if speed is None else speed),
        rate=rate, tacho=tacho, pulses=pulses if tacho is not None else None, speed_column=speed_column,
        channel=column if channel is None else channel, delimiter=delimiter, decimal=decimal,
    )  # fmt: skip
    with _written("size", *options, "--", *map(os.fspath, files), output=output) as (said, told, _):
        # What was written is named, in the order of the recordings.
        written = (Path(line) for line in told.splitlines() if line.endswith(".csv"))
        tables = {path.stem: _table(path) for path in written if path.is_file()}
    report: dict[str, Any] = json.loads(said)
    return Answer(report, report["recordings"], figures.passages, tables)


def new(
    name: str | None = None,
    output: PathLike = ".",
    *,
    bearing: str = "6205",
    defect: str | None = None,
    load: float | None = None,
    axial: float | None = None,
    degrees_of_freedom: int | None = None,
    hosted: bool = False,
) -> Path:
    """Writes a commented scene of a bearing of the catalogue that runs as it is, and gives its path.

    ``bearing`` is its name as its maker writes it (``"SKF 6205-2Z/C3"``). Without ``name`` the scene is called after
    bearing and defect. ``defect`` is a spall as ``"inner:1.2mm"``; ``load`` [N] acts downwards and ``axial`` [N] along
    the axis, with which rings have three ``degrees_of_freedom``, or five; with ``hosted`` an FMU's host moves the shaft.
    """
    words = [name] if name is not None else []
    words += _options(
        bearing=bearing, defect=defect, load=load, axial=axial, degrees_of_freedom=degrees_of_freedom, hosted=hosted,
        output=output,
    )
    said = _ask("new", *words)
    return Path(said.splitlines()[0])


def catalogue(begins: str = "") -> Catalogue:
    """Bearings that a scene can name, those whose names begin so; of a single one also its frequencies, as multiples of
    the shaft's, and load ratings [N]."""
    return Catalogue(json.loads(_ask("catalogue", begins, "--json")))


def stiffness(scene: PathLike, *, load: float | None = None) -> Columns:
    """Static stiffness [N/m], load zone and load distribution over the cage angle, by column names with units."""
    with _written("stiffness", os.fspath(scene), *_options(load=load)) as (_, _, folder):
        (table,) = folder.glob("*-stiffness.csv")
        return Columns(_table(table))


def modes(scene: PathLike, *, load: float | None = None) -> Answer:
    """Natural frequencies, damping ratios and mode shapes over the cage angle, as ``brinell modes`` writes them."""
    with _written("modes", os.fspath(scene), *_options(load=load)) as (_, _, folder):
        (file,) = folder.glob("*-modes.json")
        found: dict[str, Any] = json.loads(file.read_text(encoding="utf-8"))
    rows = [{"cage_angle_deg": one["cage_angle_deg"], **mode} for one in found["angles"] for mode in one["modes"]]
    return Answer(found, rows, figures.modes, shown="lines")


def contact(scene: PathLike, *, on: str, angle: float, force: float, pressure_limit: float | None = None) -> Answer:
    """Pressure of one ball on the raceway ``on`` as measured, ``angle`` [degrees] from the middle of its defect, under
    a force [N], and the stresses below: what ``brinell contact`` prints. ``pressure_limit`` [GPa] is the pressure at
    which the surface yields and stays dented."""
    words = _options(on=on, angle=angle, force=force, **{"yield": pressure_limit})
    with _written("contact", os.fspath(scene), *words) as (said, _, folder):
        found: dict[str, Any] = json.loads(said)
        tables = {name: _table(next(folder.glob(f"*-{name}.csv"))) for name in ("pressure", "depth")}
    rows = [{"contact": which, **found[which]} for which in ("found", "hertz")]
    return Answer(found, rows, figures.pressure, tables)


def sweep(file: PathLike, output: PathLike, *, jobs: int | None = None, signals: bool | str = False) -> Sweep:
    """Runs a sweep into the folder ``output`` and gives its table, a Parquet file.

    With ``signals`` those of all runs are written, too: a file for each, or with ``"array"`` one of all, ``signals.npy``.
    """
    said = _ask("sweep", os.fspath(file), *_options(output=output, jobs=jobs, signals=signals))
    return Sweep(Path(said.splitlines()[0]))


def scenes() -> list[str]:
    """Names of the shipped scenes."""
    return [line.split()[0] for line in _ask("scenes").splitlines()]


def _listed(names: str | Iterable[float | str]) -> str:
    return names if isinstance(names, str) else ",".join(map(str, names))


def _options(**given: Any) -> list[str]:
    """Words for the program: what is given of its options, one that is True without a value."""
    words = []
    for name, value in given.items():
        if value is not None and value is not False and value != "":
            word = os.fspath(value) if isinstance(value, os.PathLike) else value
            words.append(f"--{name.replace('_', '-')}" + ("" if word is True else f"={word}"))
    return words


def _table(path: Path) -> dict[str, figures.Signal]:
    """Columns of a CSV file by their heads."""
    with open(path, encoding="utf-8") as file:
        heads = file.readline().strip().split(",")
        values = np.loadtxt(file, delimiter=",", ndmin=2)
    return {head: np.ascontiguousarray(values[:, index]) for index, head in enumerate(heads)}


def _ask(*words: str) -> str:
    """Runs the program and gives what it prints."""
    return _asked(*words, above=1)[0]


@contextlib.contextmanager
def _written(command: str, *words: str, output: PathLike | None = None) -> Iterator[tuple[str, str, Path]]:
    """What a command prints and says on standard error, and where its files are, in `output` or for this block only."""
    with tempfile.TemporaryDirectory(prefix="brinell-") as folder:
        where = os.fspath(output or folder)
        yield *_asked(command, "--no-figure", "--output", where, *words, above=2), Path(where)


def _asked(*words: str, above: int) -> tuple[str, str]:
    """What the program prints and says on standard error; remarks are `above` more calls below the user's line."""
    done = subprocess.run([program(), *words], capture_output=True, text=True, encoding="utf-8")
    if done.returncode != 0:
        # Notes may stand before it; of a scene's faults each has its line.
        _, _, said = ("\n" + done.stderr.strip()).rpartition("\nerror: ")
        raise BrinellError(said or "it said nothing")
    for line in done.stderr.splitlines():
        kind, _, said = line.partition(": ")
        if kind in ("note", "warning"):
            # Of the line that called this package: the caller of whoever asks here.
            warnings.warn(said, BrinellWarning, stacklevel=3 + above)
    return done.stdout, done.stderr

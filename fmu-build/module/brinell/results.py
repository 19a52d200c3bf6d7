"""What the package's functions give: signals of a run, columns over an angle, answers as the program prints them."""

from __future__ import annotations

import difflib
import html
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, Callable, Optional

import numpy as np
import numpy.typing as npt

from . import figures
from .figures import Signal, Table

Draw = Callable[[Mapping[str, Any], Mapping[str, Table]], Any]


def _summary(caption: str, columns: Mapping[str, Signal], units: Mapping[str, str] | None = None) -> str:
    """An HTML table of the least, the mean and the greatest of each column."""
    unit = "<th>unit</th>" if units is not None else ""
    rows = "".join(
        f"<tr><td>{html.escape(name)}</td>"
        + (f"<td>{html.escape(units[name])}</td>" if units is not None else "")
        + "".join(f"<td>{value:.4g}</td>" for value in (np.nanmin(of), np.nanmean(of), np.nanmax(of)))
        + "</tr>"
        for name, of in columns.items()
        if not np.all(np.isnan(of))
    )
    what = "signal" if units is not None else "column"
    head = f"<tr><th>{what}</th>{unit}<th>least</th><th>mean</th><th>greatest</th></tr>"
    return f"<p>{html.escape(caption)}</p><table>{head}{rows}</table>"


def _chosen(names: str | Iterable[str] | None) -> list[str]:
    if names is None:
        return []
    return [names] if isinstance(names, str) else list(names)


def _pandas() -> Any:
    """The package pandas, which is no requirement of this one."""
    try:
        import pandas
    except ModuleNotFoundError as error:
        if error.name != "pandas":
            raise
        raise ImportError("to_pandas() needs pandas, which is not installed: pip install pandas") from None
    return pandas


class UnknownName(KeyError):
    """A name that a result does not have; the text says which it has."""

    def __str__(self) -> str:
        return str(self.args[0])


def _unknown(what: str, name: Any, names: Iterable[str]) -> UnknownName:
    """What the program answers to ``--columns``: the nearest name, and those that begin alike."""

    def head(name: str) -> str:
        return name.replace("[", ".").partition(".")[0].strip()

    names = list(names)
    begun = sorted((known for known in names if str(name) and known.startswith(str(name))), key=len)
    near = (begun or difflib.get_close_matches(str(name), names, n=1))[:1]
    like = [known for known in names if head(known) == head(str(name))]
    there = f"names that begin with {head(str(name))!r} are {', '.join(like)}" if like else ""
    there = there or f"there are {', '.join(dict.fromkeys(head(known) + '*' for known in names))}"
    guess = "".join(f"did you mean {known}? " for known in near)
    return UnknownName(f"{what} {name!r}: no such name here; {guess}{there}")


class Run(Mapping[str, Signal]):
    """Signals of a run by name, each with one sample per communication point.

    ``run["time"]`` [s] is the first of them, ``run.units`` has the unit of each, and ``run.recording`` what the scene's
    recorder sampled, as a structured array, or None.
    """

    def __init__(self, signals: dict[str, Signal], units: dict[str, str], recording: npt.NDArray[Any] | None) -> None:
        self._signals = signals
        self.units = units
        self.recording = recording

    def __getitem__(self, name: str) -> Signal:
        if name not in self._signals:
            raise _unknown("signal", name, self)
        return self._signals[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._signals)

    def __len__(self) -> int:
        return len(self._signals)

    def __repr__(self) -> str:
        time = self["time"]
        return f"<brinell.Run: {len(self)} signals, {time.size} points until {time[-1]:g} s>"

    def _repr_html_(self) -> str:
        return _summary(repr(self), self, self.units)

    def to_pandas(self) -> Any:
        """The signals as a ``pandas.DataFrame`` over the time [s]; its ``attrs["units"]`` has their units."""
        pandas = _pandas()
        frame = pandas.DataFrame({name: of for name, of in self.items() if name != "time"})
        frame.index = pandas.Index(self["time"], name="time [s]")
        frame.attrs["units"] = dict(self.units)
        return frame

    def plot(self, names: str | Iterable[str] | None = None) -> Any:
        """Draws signals over the time, a panel for each unit, and gives the ``matplotlib`` figure; without ``names``
        what the sensors show, or the housing's acceleration."""
        chosen = _chosen(names) or [name for name in self if name.startswith("sensor")] or ["housing.ay"]
        return figures.panels("time (s)", self["time"], [(name, self.units.get(name, ""), self[name]) for name in chosen])


class Columns(dict[str, Signal]):
    """Columns over the cage angle, a dictionary by their names with units."""

    def __missing__(self, name: str) -> Signal:
        raise _unknown("column", name, self)

    def _repr_html_(self) -> str:
        return _summary(f"{len(self)} columns, {len(next(iter(self.values())))} cage angles", self)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` over the first column, the cage angle."""
        pandas = _pandas()
        frame = pandas.DataFrame(dict(self))
        return frame.set_index(frame.columns[0])

    def plot(self, names: str | Iterable[str] | None = None) -> Any:
        """Draws columns over the cage angle, a panel for each unit, and gives the ``matplotlib`` figure; without
        ``names`` the stiffness along the load as the command ``brinell stiffness`` draws it.
        A name is that of a column with or without its unit."""
        heads = {head.rpartition(" [")[0]: head for head in self}
        drawn = [heads.get(name, name) for name in _chosen(names)]
        if not drawn:
            return figures.stiffness_alone({name: self[head] for name, head in heads.items()})
        columns = [(head.rpartition(" [")[0], head.rpartition(" [")[2].rstrip("]"), self[head]) for head in drawn]
        cage = figures.from_middle(next(iter(self.values())))
        return figures.panels("cage angle from the middle (degrees)", cage, columns)


class Answer(dict[str, Any]):
    """What the program writes as JSON, a dictionary. Its rows are those of :meth:`to_pandas`: one for a recording, a mode
    at a cage angle, or a contact.

    ``tables`` are what it writes beside that, by name and by column with unit: of ``size`` the averaged passage of each
    recording, of ``contact`` ``"pressure"`` of the cells and stresses over ``"depth"``.
    """

    def __init__(
        self,
        answer: dict[str, Any],
        rows: list[dict[str, Any]],
        draw: Draw,
        tables: Optional[Mapping[str, Table]] = None,
        shown: str = "",
    ) -> None:
        super().__init__(answer)
        self.tables = tables or {}
        self._rows = rows
        self._draw = draw
        # The list that is shown below numbers and words.
        self._shown = shown

    def __missing__(self, name: str) -> Any:
        raise _unknown("answer", name, self)

    def _repr_html_(self) -> str:
        tables: list[list[tuple[Any, ...]]] = [[("what", "value"), *_flat(self)]]
        listed = [dict(_flat(row)) for row in self.get(self._shown, [])]
        tables += [[tuple(listed[0]), *(tuple(row.values()) for row in listed)]] if listed else []
        return "".join(_table(rows) for rows in tables)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` of the rows' numbers and words."""
        pandas = _pandas()
        return pandas.DataFrame([dict(_flat(row)) for row in self._rows])

    def plot(self) -> Any:
        """Draws the answer and gives the ``matplotlib`` figure: averaged passages with what was found in them, natural
        frequencies and damping over the cage angle, or pressure and stress beside Hertz's."""
        return self._draw(self, self.tables)


class Catalogue(list[dict[str, Any]]):
    """Bearings of the catalogue, a dictionary each."""

    def _repr_html_(self) -> str:
        rows = [dict(_flat(bearing)) for bearing in self]
        return _table([tuple(rows[0]), *(tuple(row.get(name, "") for name in rows[0]) for row in rows)]) if rows else ""

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each bearing."""
        return _pandas().DataFrame([dict(_flat(bearing)) for bearing in self])


class Sweep:
    """The table of a sweep, a Parquet file at ``path``, whose methods it has, and for which it stands in calls."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __fspath__(self) -> str:
        return str(self.path)

    def __getattr__(self, name: str) -> Any:
        if name == "path":  # Not there yet, where a copy is made.
            raise AttributeError(name)
        return getattr(self.path, name)

    def __repr__(self) -> str:
        return f"<brinell.Sweep: {self.path}>"

    def _repr_html_(self) -> str:
        frame = self.to_pandas()
        numbers = {str(name): np.asarray(frame[name], dtype=float) for name in frame.select_dtypes("number")}
        return _summary(f"{len(frame)} runs in {self.path}", numbers)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each run."""
        return _pandas().read_parquet(self.path)

    def plot(self, over: str | None = None, names: str | Iterable[str] = ("rms_m_s2", "kurtosis")) -> Any:
        """Draws columns of the runs over another, a colour for each kind, and gives the ``matplotlib`` figure; without
        ``over`` over the first input that changes."""
        return figures.runs(self.to_pandas(), over, _chosen(names))


def _table(rows: list[tuple[Any, ...]]) -> str:
    """An HTML table below its first row."""
    cell = lambda value: f"{value:.6g}" if isinstance(value, float) else html.escape(str(value))  # noqa: E731
    tags = ["th"] + ["td"] * (len(rows) - 1)
    lines = ("".join(f"<{tag}>{cell(value)}</{tag}>" for value in row) for tag, row in zip(tags, rows))
    return "<table>" + "".join(f"<tr>{line}</tr>" for line in lines) + "</table>"


def _flat(answer: Mapping[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Numbers and words by their names, those within others behind a point; of a list what is short."""
    for name, value in answer.items():
        if isinstance(value, dict):
            yield from _flat(value, f"{before}{name}.")
        elif not isinstance(value, list):
            yield before + name, value
        elif len(value) <= 4 and not any(isinstance(one, (dict, list)) for one in value):
            yield before + name, ", ".join(f"{one:.6g}" if isinstance(one, float) else str(one) for one in value)

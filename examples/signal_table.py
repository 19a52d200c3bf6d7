"""Signals of a run that were asked for, as a table: CSV, NumPy or Parquet."""

import re

import numpy as np
from bearing import whole

FORMATS = ("parquet", "npy", "csv")


def chosen(patterns, known):
    """The names that patterns stand for, in the order asked; `*` for any characters. A ValueError names one without
    any."""
    found = []
    for pattern in patterns:
        fits = re.compile(re.escape(pattern).replace(r"\*", ".*"))
        names = [name for name in known if fits.fullmatch(name)]
        if not names:
            raise ValueError(f"no signal is called {pattern!r}; there are {', '.join(known)}")
        found += names
    return list(dict.fromkeys(found))


def write(stem, kind, columns):
    """Writes {name: values} as `stem`.kind and gives its path; all columns have one length."""
    path = f"{stem}.{kind}"
    with whole(path) as part:
        if kind == "parquet":
            import pyarrow
            import pyarrow.parquet

            pyarrow.parquet.write_table(pyarrow.table(columns), part)
        elif kind == "npy":
            rows = np.empty(len(next(iter(columns.values()))), dtype=[(name, "<f8") for name in columns])
            for name, values in columns.items():
                rows[name] = values
            with open(part, "wb") as file:
                np.save(file, rows)
        else:
            with open(part, "w", encoding="utf-8", newline="\n") as file:
                file.write(",".join(columns) + "\n")
                file.writelines(
                    ",".join(map(repr, row)) + "\n" for row in zip(*(list(map(float, v)) for v in columns.values()))
                )
    return path

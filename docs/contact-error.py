"""Draws contact-error.svg from contact-error.csv beside it: error of one contact against its time. Needs matplotlib.

    cargo run --release --example contact_error > docs/contact-error.csv && python3 docs/contact-error.py
"""

import csv
import pathlib

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

FOLDER = pathlib.Path(__file__).resolve().parent


def main():
    rows = list(csv.DictReader((FOLDER / "contact-error.csv").read_text().splitlines()))
    # Equal bits for equal numbers.
    plt.rcParams.update({"svg.hashsalt": "contact-error", "svg.fonttype": "none"})
    figure, axes = plt.subplots(figsize=(7, 4.5), layout="constrained")
    for law, marker, name in (("love", "o", "grid against finer grid"), ("map", "s", "map against its grid")):
        own = [row for row in rows if row["law"] == law]
        seconds = [float(row["seconds_per_contact"]) for row in own]
        for column, filled in (("max_normal", True), ("rms_normal", False)):
            kind = "largest" if filled else "root mean square"
            axes.loglog(seconds, [float(row[column]) for row in own], marker, label=f"{name}, {kind}", color="C0" if law == "love" else "C1",
                        markerfacecolor=None if filled else "none")
        for row, x in zip(own, seconds):
            label = f"{row['columns']}×{row['rows']}" if law == "love" else f"{row['nodes']}"
            axes.annotate(label, (x, float(row["max_normal"])), textcoords="offset points", xytext=(6, 3), fontsize=7)
    axes.set_xlabel("time of one contact / s")
    axes.set_ylabel("error of the normal force / full scale")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.savefig(FOLDER / "contact-error.svg", metadata={"Date": None})


if __name__ == "__main__":
    main()

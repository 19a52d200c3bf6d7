"""Checks what a labelled sweep of eight runs has written."""

import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet

rows = [
    row for part in sorted(Path(sys.argv[1]).glob("part-*.parquet")) for row in parquet.read_table(part).to_pylist()
]
rows.sort(key=lambda row: row["run"])
assert [row["label_kind"] for row in rows] == 2 * ["healthy", "outer", "inner", "element"], rows
for row in rows:
    signal = np.array(row["signal"])
    assert len(signal) > 4000 and np.isfinite(signal).all() and signal.std() > 0, row["run"]
    assert 300 <= row["label_load_n"] <= 1500 and 8 <= row["label_speed_hz"] <= 40
    assert row["label_load_n"] == row["shaft.load_n"] and row["label_speed_hz"] == row["shaft.speed_hz"]
    if row["label_kind"] == "healthy":
        assert row["label_length_mm"] is None and row["label_angle_deg"] is None
    else:
        assert row["label_length_mm"] == row["defect.length_mm"] and row["label_depth_um"] == row["defect.depth_um"]
        assert -120 <= row["label_angle_deg"] <= -60
    # Only a defect of a ring at rest has known passages.
    assert (row["unloaded_s"] is not None) <= (row["label_kind"] == "outer")
# A spall shakes the sensor more than its healthy twin, whose load and speed are other draws of the same ranges.
healthy = max(row["rms_m_s2"] for row in rows if row["label_kind"] == "healthy")
assert any(row["rms_m_s2"] > 2 * healthy for row in rows if row["label_kind"] == "outer"), rows
print(len(rows), "labelled")

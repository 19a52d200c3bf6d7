"""Checks what a sweep with noise, a filter and a speed that changes has written."""

import sys
from pathlib import Path

import numpy as np
import pyarrow.parquet as parquet
from scipy.io import wavfile

folder = Path(sys.argv[1])
rows = [row for part in sorted(folder.glob("part-*.parquet")) for row in parquet.read_table(part).to_pylist()]
rows.sort(key=lambda row: row["run"])
assert [row["label_kind"] for row in rows] == 4 * ["healthy", "outer", "inner"], rows
assert [row["bearing.element_count"] for row in rows[:6]] == [8, 8, 8, 9, 9, 9]
for row in rows:
    signal = np.array(row["signal"], dtype=np.float32)
    # Later than 20 ms, without the 15 rows at the end that the filter reaches over and the end itself.
    assert len(signal) == round(0.18 * 12800) - 15 - 1, len(signal)
    assert np.array_equal(np.load(folder / f"run-{row['run']:07d}.npy"), signal)
    rate, heard = wavfile.read(folder / f"run-{row['run']:07d}.wav")
    assert rate == 12800 and heard.dtype == np.float32 and np.array_equal(heard, signal)
    assert (
        row["label_speed_profile"] == "up"
        and 10 <= row["label_noise_db"] <= 30
        and row["noise_db"] == row["label_noise_db"]
    )
    # 10 to 30 Hz in 0.1 s, then 30 Hz: from 20 ms on 26.4 Hz in the mean.
    assert abs(row["label_speed_hz"] - (0.08 * 22 + 0.1 * 30) / 0.18) < 0.02, row["label_speed_hz"]
    ratio = 0.5 * (1 - 7.94 / 39.32) * row["bearing.element_count"]
    assert abs(row["bpfo_hz"] / (ratio * row["label_speed_hz"]) - 1) < 1e-3, row["bpfo_hz"]
# Runs i and i + 6 differ by their noise alone: its level follows from the ratios and the clean signal's own.
for one, other in zip(rows[:6], rows[6:]):
    shares = [10 ** (-row["noise_db"] / 10) for row in (one, other)]
    clean = one["rms_m_s2"] / np.sqrt(1 + shares[0])
    found = np.std(np.array(one["signal"]) - np.array(other["signal"]))
    # Four standard errors of 2288 draws are 6 %.
    assert abs(found / (clean * np.sqrt(sum(shares))) - 1) < 0.06, (one["run"], found)
# A spall's envelope follows its passages though their frequency changes threefold.
lines = {
    kind: [row["envelope_1_bpfo_m_s2"] for row in rows if row["label_kind"] == kind] for kind in ("healthy", "outer")
}
assert min(lines["outer"]) > 100 * max(lines["healthy"]), lines
print(len(rows), "measured")

"""A run of a sweep: what it is told, how it is stepped, and what is made of its signal: noise, features, files.

Nothing here knows of dask: workers get this file beside `bearing.py`.
"""

import csv
from ctypes import c_double, c_int, c_uint
from pathlib import Path

import numpy as np
from bearing import Numbers

# What an instance is told: scene key → variable, factor.
TOLD = {
    "shaft.load_n": ("shaft.load.y", -1.0),  # downwards
    "shaft.speed_hz": ("shaft.speed", 2 * np.pi),
    "bearing.radial_clearance_um": ("bearing.radial_clearance", 1e-6),
    "cage.slip": ("cage.slip", 1.0),
    "cage.initial_angle_deg": ("cage.initial_angle", np.pi / 180),
    "defect.angle_deg": ("defect.angle", np.pi / 180),
}
HARMONICS = 5
FEATURES = ["bpfo_hz", "rms_m_s2", "kurtosis", *(f"envelope_{k}_bpfo_m_s2" for k in range(1, HARMONICS + 1))]
FEATURES += ["unloaded_s", "loaded_again_s", "unloaded_deg"]
# Rates from which the sensor's own resonance, at 15 kHz in the shipped scenes, lies well inside the band.
ENOUGH_WITHOUT_FILTER = 51200.0


def speed_profile(path, stop):
    """Times [s] and speeds [Hz] of a CSV file with the columns time_s and speed_hz. A ValueError says what is wrong."""
    with open(path, encoding="utf-8-sig", newline="") as file:
        lines = [(number, row) for number, row in enumerate(csv.reader(file), 1) if row and not row[0].startswith("#")]
    if not lines or [cell.strip() for cell in lines[0][1]] != ["time_s", "speed_hz"]:
        raise ValueError(f"{path}: a speed profile begins with the heading time_s,speed_hz")
    points = []
    for number, row in lines[1:]:
        try:
            time, speed = map(float, row)
        except ValueError:
            raise ValueError(f"{path} line {number}: {','.join(row)!r} must be two numbers") from None
        if not (np.isfinite(time) and abs(speed) <= 1e4):
            raise ValueError(
                f"{path} line {number}: time_s is {time}, speed_hz {speed}: it must be at most 10000 either way"
            )
        if time != 0 if not points else time <= points[-1][0]:
            raise ValueError(f"{path} line {number}: time_s is {time}: times must begin with 0 and ascend")
        points.append((time, speed))
    if len(points) < 2 or points[-1][0] < stop * (1 - 1e-9):
        end = points[-1][0] if points else 0.0
        raise ValueError(f"{path}: it ends at {end} s: it must go to {stop} s, the end of the runs")
    times, speeds = map(list, zip(*points))
    return times, speeds


def run_one(instance, values, options, index=0, folder=None):
    """Steps an instance that is reset, and gives the features of what the sensor shows."""
    told = {TOLD[key][0]: TOLD[key][1] * value for key, value in values.items() if key in TOLD}
    told = {name: value for name, value in told.items() if name in instance.reference}
    if options.get("filter"):
        told["recorder.folder"] = str(folder)
    profile = options.get("profiles", {}).get(values.get("speed_profile"))
    if profile:
        told["shaft.speed"] = 2 * np.pi * profile[1][0]
    instance.enter(told)
    instance.run()
    table, count = stepped(instance, options, profile)
    t = np.arange(1, len(table) + 1) / options["rate"]
    late = t > options["settle"]
    # How many elements have passed a point of the outer raceway.
    # An outer ring that turns goes along with the cage, or towards it.
    outer = instance.read(["housing.speed"])[0] if "housing.speed" in instance.reference else 0.0
    past = table[:, 1] - outer
    passages = count / (2 * np.pi * options["rate"]) * np.cumsum(past)
    signal, at = table[late, 0], t[late]
    if options.get("filter"):
        recorded = recording(instance, folder)
        recorded = recorded[recorded["time"] > options["settle"]]
        signal, at = recorded["sensor.acceleration"], recorded["time"]
    if values.get("noise_db") is not None:
        signal = with_noise(signal, values["noise_db"], options["seed"], index)
    bpfo = count * float(np.mean(np.abs(past[late]))) / (2 * np.pi)
    row = features(signal, np.interp(at, t, passages), bpfo)
    # Where elements pass a defect of the outer raceway is known from their angles alone.
    outer = "defect.angle" in instance.reference and not {"shaft.angle", "housing.angle"} & set(instance.reference)
    outer = outer and not any(name.endswith(".spin_angle") for name in instance.reference)
    if outer:
        defect = instance.read(["defect.angle"])[0]
        row.update(passage(t, table[:, 2 : 2 + count], table[:, 2 + count :], defect, options["settle"]))
    if profile:
        row["label_speed_hz"] = float(np.mean(np.interp(t[late], *profile)))
    row["signal"] = signal.astype(np.float32)
    return row


def stepped(instance, options, profile):
    """What the sensor, the cage and the elements do at each sample: sensor, cage's speed, angles, outer forces; and the
    number of elements."""
    count = sum(name.endswith(".path") for name in instance.reference)
    elements = [f"element[{j}].{what}" for what in ("angle", "force.outer") for j in range(1, count + 1)]
    seen = Numbers(instance, ["sensor.acceleration", "cage.speed", *elements])
    slave, h = instance.slave, 1.0 / options["rate"]
    table = np.empty((round(options["stop"] * options["rate"]), len(seen.array)))
    if profile:
        # The speed goes straight from each sample to the next.
        speeds = 2 * np.pi * np.interp(h * np.arange(len(table) + 1), *profile)
        speed, first = (c_uint * 1)(instance.reference["shaft.speed"]), (c_int * 1)(1)
    for index in range(len(table)):
        if profile:
            slave.fmi2SetReal(slave.component, speed, 1, (c_double * 1)(speeds[index]))
            rate = (c_double * 1)((speeds[index + 1] - speeds[index]) / h)
            slave.fmi2SetRealInputDerivatives(slave.component, speed, 1, first, rate)
        instance.step(h)
        slave.fmi2GetReal(*seen.arguments)
        table[index] = seen.array
    return table, count


def recording(instance, folder):
    """What the FMU's recorder has written; the end of a run closes it."""
    instance.slave.terminate()
    path = Path(folder) / f"{instance.name}.npy"
    found = np.load(path)
    path.unlink()
    return found


def with_noise(signal, ratio, seed, index):
    """The signal with white noise so many decibels below it; the same for the same seed and run."""
    noise = np.random.Generator(np.random.PCG64(np.random.SeedSequence([seed, index, 1]))).standard_normal(len(signal))
    return signal + signal.std() * 10 ** (-ratio / 20) * noise


def features(signal, passages, bpfo):
    """RMS [m/s²], kurtosis, and the envelope's amplitudes at multiples of the passage frequency [m/s²].

    `passages` is how many elements have passed a point of the outer raceway at each sample: with a speed that changes
    the lines stay where they are.
    """
    signal = signal - signal.mean()
    rms = float(np.sqrt(np.mean(signal**2)))
    spectrum = np.fft.fft(signal)
    spectrum[1 : (len(signal) + 1) // 2] *= 2
    spectrum[len(signal) // 2 + 1 :] = 0
    envelope = np.abs(np.fft.ifft(spectrum))
    window = np.hanning(len(signal))
    row = {"bpfo_hz": bpfo, "rms_m_s2": rms, "kurtosis": float(np.mean(signal**4) / rms**4)}
    weighed = window * (envelope - envelope.mean()) * 2 / window.sum()
    # A signal shorter than a passage has no lines.
    passed = np.abs(np.diff(passages)).sum() >= 1.0
    for k in range(1, HARMONICS + 1):
        line = float(np.abs(weighed @ np.exp(-2j * np.pi * k * passages))) if passed else None
        row[f"envelope_{k}_bpfo_m_s2"] = line
    return row


def passage(t, angles, forces, defect, settle):
    """The first passage after settling: when an element loses and regains half its force over the defect [s].

    `unloaded_deg` is how far it goes in between: a lower bound of a line spall's length.
    """
    for j in range(angles.shape[1]):
        normal = np.median(forces[:, j][forces[:, j] > 0]) if np.any(forces[:, j] > 0) else 0.0
        away = (angles[:, j] - defect + np.pi) % (2 * np.pi) - np.pi
        near = np.abs(away) < 0.75 * np.pi / angles.shape[1] + 0.3
        light = near & (forces[:, j] < 0.5 * normal) & (t > settle)
        begins = np.flatnonzero(light[1:] & ~light[:-1] & near[:-1]) + 1
        for first in begins:
            again = first + np.flatnonzero(~light[first:])
            if again.size and near[again[0]] and t[first] - settle < 0.5 * (t[-1] - settle):
                turned = angles[again[0], j] - angles[first, j]
                return {
                    "unloaded_s": float(t[first]), "loaded_again_s": float(t[again[0]]),
                    "unloaded_deg": float(np.degrees(turned)),
                }
    return {"unloaded_s": None, "loaded_again_s": None, "unloaded_deg": None}


def write(signal, rate, path, kinds):
    """The signal as 32-bit floats in m/s²: `.npy`, `.wav`."""
    if "npy" in kinds:
        np.save(Path(path).with_suffix(".npy"), signal)
    if "wav" in kinds:
        from scipy.io import wavfile

        wavfile.write(Path(path).with_suffix(".wav"), round(rate), signal)

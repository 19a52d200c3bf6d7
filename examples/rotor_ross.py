#!/usr/bin/env python3
"""A ROSS rotor with one bearing computed by an FMU, healthy and spalled: motion and order spectra.

    python examples/rotor_ross.py [--passes 2] [--step 5e-5] [--stop 4] [-o target/examples]

The rotor: a steel shaft of 25 mm, 0.6 m long, a disk of 4.4 kg in the middle with unbalance, a light damper beside
it, a linear bearing on the left, and the ER16K under study on the right, pressed down with 300 N. The FMU moves the
bearing's elements and its housing, and `brinell.ross` with ROSS's matrices the shaft: any rotor, in any number of
bearings. examples/notebooks/rotor.ipynb has one of your own.
"""

import json
import time

import numpy as np
from bearing import build, healthy_and_spalled, parser
from brinell.ross import ross, simulate, unbalance

LEFT, DAMPER, DISK, BEARING = 0, 5, 6, 12  # nodes


def shown():
    """The rotor described above, in 12 elements of 50 mm; the loads and forces on it by node."""
    # beta: damping over stiffness of the shaft, assumed; 8 % of critical at 5 kHz, 0.1 % at the first critical speed
    steel = ross.Material("steel", rho=7810, E=211e9, G_s=81.2e9)
    elements = [ross.ShaftElement(L=0.05, idl=0.0, odl=0.025, material=steel, beta=5e-6) for _ in range(BEARING)]
    disks = [ross.DiskElement.from_geometry(n=DISK, material=steel, width=0.04, i_d=0.025, o_d=0.135)]
    bearings = [
        ross.BearingElement(n=LEFT, kxx=5e7, cxx=100.0, kzz=1e6),
        ross.BearingElement(n=DAMPER, kxx=0.0, cxx=60.0),
    ]
    # 5e-4 kg m: a disk that should be balanced; grade G 36 at 50 Hz
    return ross.Rotor(elements, disks, bearings), {BEARING: (0.0, -300.0)}, {DISK: unbalance(5e-4)}


def spectrum(signal, h, turns):
    """Orders of shaft speed, and amplitudes."""
    window = np.hanning(len(signal))
    amplitudes = np.abs(np.fft.rfft((signal - signal.mean()) * window)) * 2 / window.sum()
    return np.fft.rfftfreq(len(signal), h) / turns, amplitudes


def summary(runs, passage, h, turns, settle):
    """Amplitudes of the shaft's position in the bearing [µm] at shaft speed, multiples of BPFO, and their sidebands."""
    found = {"bpfo_order": passage}
    for name, run in runs.items():
        order, amplitude = spectrum(run.at(BEARING)[run.time >= settle, 1] * 1e6, h, turns)
        lines = [1.0, *(k * passage + side for k in (1, 2) for side in (-1, 0, 1))]
        near = max(0.06, order[1])
        found[f"position_um_{name}"] = {f"{x:.3f}": float(amplitude[np.abs(order - x) <= near].max()) for x in lines}
        # What lies between the lines n BPFO + m shaft speed.
        apart = [np.abs((order - n * passage + 0.5) % 1 - 0.5) > 0.1 for n in (0, 1, 2)]
        found[f"floor_um_{name}"] = float(np.median(amplitude[np.all(apart, axis=0) & (order < 2 * passage)]))
    return found


def draw(runs, passage, h, turns, settle, stem):
    from figures import BLACK, BLUE, ORANGE, curve, legend, plots, save

    figure, axes = plots(6, 15)
    whole, axes = dict(zip(("spalled", "healthy"), axes)), axes[2:]
    for name, colour in (("spalled", ORANGE), ("healthy", BLUE)):
        t, shaft, middle = runs[name].time, runs[name].at(BEARING)[:, 1] * 1e6, runs[name].at(DISK)[:, 1] * 1e6
        curve(whole[name], t, shaft, colour, name, turns)
        part = t >= max(t[-1] - 4 / turns, settle)
        axes[0].plot((t[part] - t[-1]) * turns, shaft[part], color=colour, label=name)
        axes[1].plot((t[part] - t[-1]) * turns, middle[part], color=colour, label=name)
        late = t >= settle
        for axis, signal in ((axes[2], shaft[late]), (axes[3], runs[name].outputs[BEARING]["housing.ay"][late])):
            order, amplitude = spectrum(signal, h, turns)
            axis.semilogy(order[order < 11], amplitude[order < 11], color=colour, linewidth=0.8)
    for axis in axes[2:]:
        top = axis.get_xaxis_transform()
        for multiple in (1, 2, 3):
            axis.plot(multiple * passage, 1.03, "v", color=BLACK, transform=top, clip_on=False, markersize=6)
            axis.text(multiple * passage, 1.07, f"{multiple} BPFO", transform=top, ha="center", fontsize=8)
            for side in (-1, 1) if multiple < 3 else (-1,):
                at = multiple * passage + side
                axis.plot(at, 1.03, "v", color="#999999", transform=top, clip_on=False, markersize=4)
        axis.set_xlim(0, 11)
    turned, marks = "turns of the shaft from the end", "; grey marks: sidebands, BPFO ± shaft speed"
    axes[0].set(ylabel="shaft in the bearing,\ny from rest (µm)", xlabel=turned)
    axes[1].set(ylabel="disk, y from rest\n(µm)", xlabel=turned)
    axes[2].set(ylabel="shaft in the bearing,\ny (µm)", xlabel="order of shaft speed" + marks, ylim=(1e-4, None))
    axes[3].set(ylabel="housing, y (m/s²)", xlabel="order of shaft speed", ylim=(1e-4, None))
    whole["healthy"].sharey(whole["spalled"])
    for axis in whole.values():
        axis.set(ylabel="shaft in the bearing,\ny from rest (µm)", xlabel="time (s)", xlim=(0, t[-1]))
    for axis in (*whole.values(), *axes[:2]):
        legend(axis)
    whole["spalled"].set_title(f"ROSS rotor at {turns:g} Hz, ER16K with a spall of 15.8°", loc="left")
    save(figure, stem)


def main():
    words = parser(__doc__)
    words.add_argument("--passes", type=int, default=2, help="of each step")
    words.add_argument("--speed", type=float, default=50.0, help="shaft speed [Hz]")
    words.add_argument("--step", type=float, default=5e-5, help="communication step [s]")
    words.add_argument("--stop", type=float, default=4.0, help="end [s]")
    options = words.parse_args()
    rotor, loads, forces = shown()
    speed, settle, h = 2 * np.pi * options.speed, min(0.3, 0.4 * options.stop), options.step
    fmus = build(healthy_and_spalled(options.output), options.output)
    stem = options.output / "rotor_ross"
    runs, took = {}, {}
    for name, fmu in zip(("healthy", "spalled"), fmus):
        begin = time.perf_counter()
        runs[name] = simulate(
            rotor, {BEARING: fmu}, speed, options.stop, h, loads=loads, forces=forces, passes=options.passes,
            seen=("housing.ay", "cage.speed"),
        )  # fmt: skip
        took[name] = round(time.perf_counter() - begin, 2)
    # Of an element over a point on the outer ring, per shaft turn.
    passage = 9 * runs["spalled"].outputs[BEARING]["cage.speed"][0] / speed
    draw(runs, passage, h, options.speed, settle, stem)
    found = summary(runs, passage, h, options.speed, settle)
    print(json.dumps({**found, "seconds": took, "files": [f"{stem}.svg", f"{stem}.png"]}))


if __name__ == "__main__":
    main()

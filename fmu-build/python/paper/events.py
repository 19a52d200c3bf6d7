"""Events of one passage over a spall, by the numbers of the paper behind the model."""

import numpy as np


def find_events(signals, entry, leave):
    """What happens to the outer force, from the signals: name → (time [s], outer force [N])."""
    time, force = signals["time"], signals["force.outer"]
    at = lambda when: (when, float(np.interp(when, time, force)))  # noqa: E731
    normal = float(np.median(force[time < entry]))
    inside = (time >= entry) & (time <= leave + 0.2e-3)
    low = np.flatnonzero(inside & (force < 0.5 * normal))
    events = {"entry": at(entry)}
    if low.size:
        first = low[0]
        again = first + np.flatnonzero(force[first:] > 0.5 * normal)[0]
        least = first + int(np.argmin(force[first:again]))
        events["unloading"] = (float(time[first]), float(force[first]))
        if force[least] == 0.0:
            free = first + int(np.flatnonzero(force[first:again] == 0.0)[0])
            events["free"] = (float(time[free]), 0.0)
            # What touches later than that may be the trailing edge.
            struck = np.flatnonzero((force > 0.0) & (time > time[free]) & (time < entry + 0.7 * (leave - entry)))
            if struck.size:
                events["floor"] = at(float(time[struck[0]]))
        events["least"] = (float(time[least]), float(force[least]))
        events["reload"] = (float(time[again]), float(force[again]))
    peak = np.flatnonzero(inside)[int(np.argmax(force[inside]))]
    events["peak"] = (float(time[peak]), float(force[peak]))
    events["exit"] = at(leave)
    return normal, events


# Events by the paper's numbers (floor and load's return: its section 5.2), as `brinell paper fig1` has them.
NUMBERED = {
    "entry": (1, "enters: its centre passes the leading edge"),
    "free": (2, "free of load"),
    "floor": (3, "strikes the floor"),
    "reload": (4, "has half its force again, at the trailing edge"),
}
# Why an event does not come.
ABSENT = {"free": "the element never gets free", "floor": "the floor is out of reach"}


def listed(events, start, of=""):
    """A line for each of the paper's events, `of` what; of one that does not come, why."""
    yield "events by the paper's numbers" + (f": {of}" if of else "")
    for name, (number, words) in NUMBERED.items():
        if name in events:
            yield f"{number}  {(events[name][0] - start) * 1e3:5.2f} ms  {words}"
        elif name in ABSENT:
            yield f"{number}   does not come: {ABSENT[name]}"

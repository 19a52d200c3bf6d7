"""What the moving bearing of a run's page is drawn from: dimensions, and where everything is at even times."""

import base64

import numpy as np

# Numbers of all motions together, 5.3 bytes each in the page.
MOST_NUMBERS = 260_000


def packed(values):
    return base64.b64encode(np.ascontiguousarray(values, dtype="<f4").tobytes()).decode("ascii")


def wrapped(angle):
    return (angle + np.pi) % (2 * np.pi) - np.pi


def turning(run, name, speed, every):
    """An angle that grows without a jump; where the run has none, from the speed."""
    time = np.asarray(run.table["time"])
    if run.has(name):
        return np.unwrap(np.asarray(run.table[name]))[::every]
    rates = np.asarray(run.table[speed]) if run.has(speed) else np.zeros(len(time))
    steps = np.append(0.0, np.cumsum(0.5 * (rates[1:] + rates[:-1]) * np.diff(time)))
    return steps[::every]


def crossing(angles, about, shaft, housing, time, spins, force):
    """A time in the second half of the run at which an element is over the middle of the first defect: of all passages
    that of the greatest force on the defect, and where elements are free over the middle the instant of that force."""
    if not about["defects"]:
        return float(time[len(time) // 2])
    defect = about["defects"][0]
    elements, radius, middle = range(len(angles)), defect["radius"], defect["angle"]
    if defect["on"] == "element":
        # Its own defect faces the outer raceway.
        elements, radius, middle, angles = [defect["element"] - 1], about["element_radius"], 0.0, {}
        angles[elements[0]] = spins[defect["element"]]
    turned = {"outer": housing, "inner": shaft}.get(defect["on"], np.zeros(len(time)))
    half = max(abs(defect["surface"][0][0]), abs(defect["surface"][-1][0])) / radius
    late = np.arange(len(time)) >= len(time) // 2
    passages, closest = [], (np.inf, 0)
    for j in elements:
        away = np.where(late, np.abs(wrapped(angles[j] - turned - middle)), np.inf)
        k = int(np.argmin(away))
        closest = min(closest, (away[k], k))
        within = np.flatnonzero(away <= half)
        for piece in np.split(within, np.flatnonzero(np.diff(within) > 1) + 1) if within.size else ():
            over, most = piece[np.argmin(away[piece])], piece[np.argmax(force[j][piece])]
            passages.append((force[j][over], force[j][most], int(over), int(most)))
    if not passages:
        return float(time[closest[1]])
    at_middle, greatest, over, most = max(passages)
    return float(time[over if at_middle > 0 or greatest == 0 else most])


def gaps(run, about, j, time, path):
    """How far (m) an element is from the smooth outer and inner raceway, along the contact's normal; negative where they
    press each other. `path` is the element's at these times."""
    angle = run.at(f"element[{j}].angle", time)
    cos, sin = np.cos(angle), np.sin(angle)
    moved = {axis: run.at(f"shaft.{axis}", time) - run.at(f"housing.{axis}", time) for axis in "xyz"}
    if not about["section"]:
        return -path, path + (about["clearance"] - moved["x"] * cos - moved["y"] * sin)
    found = []
    for side, ring, sign in (("outer", "housing", 0.0), ("inner", "shaft", 1.0)):
        groove = about["section"][side]
        # The ball from the ring's centre outwards, around and along z; then along the ring's axis, and away from it.
        outwards = about["outer_radius"] - about["element_radius"] + path - sign * (moved["x"] * cos + moved["y"] * sin)
        around = sign * (moved["x"] * sin - moved["y"] * cos)
        along = run.at(f"element[{j}].axial", time) - sign * moved["z"]
        tilt_x, tilt_y = (run.at(f"{ring}.tilt.{axis}", time) for axis in "xy")
        lean, turn = tilt_y * cos - tilt_x * sin, -(tilt_y * sin + tilt_x * cos)
        height = (outwards * lean + around * turn + along) / np.sqrt(1 + tilt_x**2 + tilt_y**2)
        distance = np.sqrt(outwards**2 + around**2 + along**2 - height**2)
        centres = np.hypot(distance - groove["centre_radius"], height - groove["shift"])
        found.append(groove["radius"] - about["element_radius"] - centres)
    return tuple(found)


def motion(run, about):
    """All of it, or None where the table lacks an element's motion."""
    count = about["count"]
    if not all(run.has(f"element[{j}].path") for j in range(1, count + 1)):
        return None
    of_each = 9 if about["section"] else 5
    every = max(1, -(-len(run.table["time"]) * (of_each * count + 15) // MOST_NUMBERS))
    of = lambda name: np.asarray(run.table[name])[::every] if run.has(name) else None  # noqa: E731
    each = lambda what: [packed(of(f"element[{j}].{what}")) for j in range(1, count + 1)]  # noqa: E731
    ring = lambda name: {  # noqa: E731
        axis: packed(of(f"{name}.{axis}"))
        for axis in ("x", "y", "z", "tilt.x", "tilt.y", "force.x", "force.y")
        if run.has(f"{name}.{axis}")
    }
    sides = lambda what: {side: each(f"{what}.{side}") for side in ("outer", "inner")}  # noqa: E731
    # Balls that move across their grooves.
    across = {name: each(name) for name in ("path", "axial")} if about["section"] else {}
    across.update({"contact": sides("contact_angle")} if across else {})
    time = of("time")
    shaft, housing = (turning(run, f"{name}.angle", f"{name}.speed", every) for name in ("shaft", "housing"))
    angles = [np.unwrap(of(f"element[{j}].angle")) for j in range(1, count + 1)]
    spins = {
        defect["element"]: np.unwrap(of(f"element[{defect['element']}].spin_angle"))
        for defect in about["defects"]
        if defect["on"] == "element"
    }
    side = "inner" if about["defects"] and about["defects"][0]["on"] == "inner" else "outer"
    on_defect = [of(f"element[{j}].force.{side}") for j in range(1, count + 1)]
    apart = [gaps(run, about, j, time, of(f"element[{j}].path")) for j in range(1, count + 1)]
    return {
        "count": count,
        "radius": about["element_radius"],
        "outer": about["outer_radius"],
        "inner": about["inner_radius"],
        "defects": about["defects"],
        "start": float(time[0]),
        "step": float(time[1] - time[0]),
        "every": every,
        "opens": crossing(angles, about, shaft, housing, time, spins, on_defect),
        "passage": about["passage"],
        "sensor": about["sensor"],
        "shaft": {**ring("shaft"), "angle": packed(shaft)},
        "housing": {**ring("housing"), "angle": packed(housing)},
        "angle": [packed(angle) for angle in angles],
        "gap": {"outer": [packed(out) for out, _ in apart], "inner": [packed(inside) for _, inside in apart]},
        "section": about["section"],
        **across,
        "force": sides("force"),
        "spin": {j: packed(spin) for j, spin in spins.items()},
    }

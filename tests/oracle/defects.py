"""Rectangular spalls with 90° edges on a raceway or an element: where they are, and the rigid paths over them.

Written from the equations, without looking at the Rust code. Radii are positive where a surface is convex and negative
where it is concave, as the outer raceway is. So one expression is the path of all four contacts, at an angle d past an
edge: P = own + other - own cos d - √(other² - own² sin²d), the root with the sign of `other`.
"""

import numpy as np


class Path:
    """Rigid path over a spall: P ≥ 0 opens the gap. `own` is the radius of the body that has the spall."""

    def __init__(self, own, other, half_length, depth):
        self.own, self.other, self.half_length, self.depth = own, other, half_length, depth
        # Past an edge by this angle the floor is touched: a triangle of the two radii and the distance of the centres.
        centres = own + other - depth
        self.roll_in = np.arccos((centres**2 + own**2 - other**2) / (2 * centres * own))
        inner = max(half_length - self.roll_in, 0.0)
        self.corners = np.array(sorted({-half_length, -inner, inner, half_length}))

    def __call__(self, psi):
        """P and dP/dψ at angles from the spall's middle, seen from the centre of the spalled body."""
        p, slope = np.zeros_like(psi), np.zeros_like(psi)
        d = self.half_length - np.abs(psi)  # angle past the nearer edge
        p[d > 0], rolling = self.depth, (d > 0) & (d < self.roll_in)
        if rolling.any():
            c, s = np.cos(d[rolling]), np.sin(d[rolling])
            root = np.copysign(np.sqrt(self.other**2 - (self.own * s) ** 2), self.other)
            # own (1 - cos d) and other - root, both differences of nearly equal numbers written out.
            p[rolling] = 2 * self.own * np.sin(d[rolling] / 2) ** 2 + (self.own * s) ** 2 / (self.other + root)
            slope[rolling] = -np.sign(psi[rolling]) * (self.own * s + self.own**2 * s * c / root)
        return p, slope


class Spall:
    """The spall of a scene: a path for each side it meets, on a body that turns evenly with `omega`.

    A contact's direction points from the ring's centre to the element's, θ outside and φ inside. Its angle ψ from the
    spall's middle is ψ of the equations on a ring and -χ on an element: dP/dψ here is dP_ring/dψ - dP_el/dχ there.
    """

    def __init__(self, table, bearing):
        assert table.get("edge_slope_deg", 90.0) == 90.0 and "profile" not in table, "only rectangular spalls"
        assert table.get("tilt_deg", 0.0) == 0.0, "only spalls across the whole track"
        self.on, r, r_o, r_i = table.get("on", "outer"), bearing.r, bearing.r_o, bearing.r_i
        self.elements = np.ones(bearing.z, bool)  # that meet it
        if self.on == "element":
            self.elements = np.arange(bearing.z) + 1 == table.get("element", 1)
            assert self.elements.any(), "no such element"
            body_angle, self.omega = bearing.angles(0.0)[self.elements][0], bearing.omega_b
            radii = {"outer": (r, -r_o), "inner": (r, r_i)}
        elif self.on == "inner":
            body_angle, self.omega, radii = bearing.alpha_i, bearing.omega_i, {"inner": (r_i, r)}
        else:
            body_angle, self.omega, radii = bearing.alpha_o, bearing.omega_o, {"outer": (-r_o, r)}
        self.angle_0 = np.radians(table.get("angle_deg", 0.0 if self.on == "element" else -90.0))
        self.middle = self.angle_0 + body_angle  # absolute, at the start
        radius = abs(next(iter(radii.values()))[0])
        length = np.radians(table["length_deg"]) if "length_deg" in table else table["length_mm"] * 1e-3 / radius
        self.half_length, depth = length / 2, table["depth_um"] * 1e-6
        self.paths = {side: Path(*pair, self.half_length, depth) for side, pair in radii.items()}

    def angle(self, side, direction, t):
        """Angle of contacts from the middle of the spall, in (-π, π]."""
        if self.on == "element" and side == "inner":
            direction = direction + np.pi  # the element's other side
        return -np.remainder(self.middle + self.omega * t - direction + np.pi, 2 * np.pi) + np.pi

    def path(self, side, direction, t):
        """P and dP/dψ of all contacts on one side."""
        if side not in self.paths:
            return np.zeros_like(direction), np.zeros_like(direction)
        p, slope = self.paths[side](self.angle(side, direction, t))
        return p * self.elements, slope * self.elements

    def past_corners(self, side, direction, t):
        """Numbers that change sign where a contact passes a corner of its path (and half a turn away from there)."""
        if side not in self.paths:
            return np.empty(0)
        return np.sin(self.angle(side, direction, t)[self.elements] - self.paths[side].corners[:, None]).ravel()

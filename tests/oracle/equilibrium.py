"""Static equilibrium of elements and rings at one cage angle, and the condensed stiffness around it.

Rings at rest or moving as given; elements carried round by the cage (centrifugal force counts), u' = 0. The contacts'
damping at these rates belongs to the balance, so that nothing accelerates at the start. An element without a net
outward push rests at u = 0, or on the inner ring if that is near. Given the rings, each element's balance falls
monotonically with u, so bisection finds it to rounding; Newton moves the rings.
"""

import numpy as np

ZERO = np.zeros(2)


def static_contacts(bearing, t, u, x_i, x_o):
    """Contacts with u' = 0, free rings at rest and given rings at their velocity."""
    v_i, v_o = (
        ZERO if ring.motion == "internal" else ring.given_motion(t)[1] for ring in (bearing.shaft, bearing.housing)
    )
    return bearing.contacts(t, u, 0 * u, x_i, v_i, x_o, v_o)


def element_positions(bearing, t, x_i, x_o, upper=5e-3):
    """u of all elements between given rings."""
    def push(u):
        c = static_contacts(bearing, t, u, x_i, x_o)
        body = bearing.gravity @ c.e_r + bearing.omega_c**2 * (bearing.rho0 + u)
        return c.on_elements() + bearing.mass * body

    low, high = np.zeros(bearing.z), np.full(bearing.z, upper)
    loose = push(low) <= 0
    while np.any(high - low > 4e-16 * high):
        middle = np.where(low > 0, np.sqrt(low * high), high * 1e-3)
        middle = np.where((low > 0.5 * high) | (high < 1e-30), 0.5 * (low + high), middle)
        outward = push(middle) > 0
        if np.all((middle <= low) | (middle >= high)):
            break
        low, high = np.where(outward, middle, low), np.where(outward, high, middle)
        high = np.where(loose, 0.0, high)
    u = np.where(loose, 0.0, 0.5 * (low + high))
    # What gravity pulls inwards lies on the inner ring, if that is within reach.
    low, high = np.full(bearing.z, -0.5e-3), np.zeros(bearing.z)
    inward = loose & (push(high) < 0) & (push(low) > 0)
    for _ in range(200 if np.any(inward) else 0):
        middle = 0.5 * (low + high)
        outward = push(np.where(inward, middle, u)) > 0
        low, high = np.where(outward, middle, low), np.where(outward, high, middle)
    return np.where(inward, 0.5 * (low + high), u)


class Equilibrium:
    """Positions of rings and elements at time t (that is, at the cage angle of time t)."""

    def __init__(self, bearing, t=0.0, start=None):
        self.bearing, self.t = bearing, t
        self.free = [ring.motion == "internal" for ring in (bearing.shaft, bearing.housing)]
        x = self.first_guess() if start is None else np.array(start, float)
        self.solve(x)

    def rings(self, x):
        b, parts, at = self.bearing, [], 0
        for ring, free in zip((b.shaft, b.housing), self.free):
            parts.append(x[at:at + 2] if free else ring.given_motion(self.t)[0])
            at += 2 * free
        return parts

    def residual(self, x):
        """External plus contact plus support force on each free ring."""
        b = self.bearing
        x_i, x_o = self.rings(x)
        u = element_positions(b, self.t, x_i, x_o)
        c = static_contacts(b, self.t, u, x_i, x_o)
        forces = [c.on_shaft() + b.shaft.load - b.shaft.stiffness * x_i,
                  c.on_housing() + b.housing.load - b.housing.stiffness * x_o]
        return np.concatenate([f for f, free in zip(forces, self.free) if free] or [np.empty(0)])

    def first_guess(self):
        b, guess = self.bearing, []
        at_rest = np.zeros(2 * sum(self.free))
        if np.linalg.norm(self.residual(at_rest)) < 1e-12:
            return at_rest
        total = b.shaft.load + b.housing.load
        x_o = total / b.housing.stiffness if self.free[1] and b.housing.stiffness else self.rings(at_rest)[1]
        way = b.shaft.load / max(np.linalg.norm(b.shaft.load), 1e-300)
        approach = 2 * b.growth_i.approach(np.linalg.norm(b.shaft.load)) + b.clearance + 1e-6
        guess += [x_o + way * approach] if self.free[0] else []
        guess += [x_o] if self.free[1] else []
        return np.concatenate(guess or [at_rest])

    def jacobian(self, x, step=1e-10):
        columns = [(self.residual(x + d) - self.residual(x - d)) / (2 * step) for d in np.eye(len(x)) * step]
        return np.array(columns).T.reshape(len(x), len(x))

    def solve(self, x):
        load = np.linalg.norm(np.concatenate([self.bearing.shaft.load, self.bearing.housing.load]))
        for _ in range(200 if len(x) else 0):
            r = self.residual(x)
            if np.linalg.norm(r) <= 1e-13 * load + 1e-15:
                break
            move, scale = -np.linalg.lstsq(self.jacobian(x), r, rcond=1e-12)[0], 1.0
            while scale > 1e-6 and np.linalg.norm(self.residual(x + scale * move)) > (
                1 - 1e-4 * scale
            ) * np.linalg.norm(r):
                scale /= 2
            if scale <= 1e-6:  # no descent left: rounding, or a kink
                break
            x = x + scale * move
        self.x, self.error = x, np.linalg.norm(self.residual(x)) / max(load, 1e-300)
        self.x_i, self.x_o = self.rings(x)
        self.u = element_positions(self.bearing, self.t, self.x_i, self.x_o)
        self.contacts = static_contacts(self.bearing, self.t, self.u, self.x_i, self.x_o)

    def state(self):
        """State vector of the equations of motion: at rest, u' = 0."""
        b, y = self.bearing, []
        for x, free in zip((self.x_i, self.x_o), self.free):
            y += [*x, 0.0, 0.0] if free else []
        v_o = ZERO if self.free[1] else b.housing.given_motion(self.t)[1]
        if b.sensor:
            y += [self.x_o[1], v_o[1]]
        return np.concatenate([y, self.u, v_o @ self.contacts.e_r])

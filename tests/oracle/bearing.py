"""Equations of motion of a rolling bearing with one rectangular spall, contact law `hertz`: the other side of a
cross-check.

Written from the equations, without looking at the Rust code. SI units, y up, angles counter-clockwise from +x.

Assumed: rigid rings that translate, turn evenly and do not tilt; a kinematic cage (every element has the cage's angle);
elements that spin as if they rolled on both raceways; no friction, lubricant or axial motion. Invalid beside a spall's
edge, where Hertz's paraboloids are not what touches.

States: shaft x y vx vy | housing x y vx vy (each only if that ring is `internal`) | resonator y vy (if any) | u[Z] |
w[Z]. u is how far an element's centre lies outside its path on the smooth outer raceway, w its absolute radial
velocity.
"""

from dataclasses import dataclass, field

import numpy as np
from defects import Spall
from scipy.optimize import brentq
from scipy.special import ellipe, ellipkm1

try:
    import tomllib
except ImportError:  # before Python 3.11
    import tomli as tomllib

MICRO = 1e-6


def hertz_constant(curvature_rolling, curvature_axial, e_star):
    """K of Q = K δ^1.5 of an elliptical contact, exact; Johnson (1985) eqs. 4.25-4.28 with 1 - e² = (b/a)²."""
    small, large = sorted((curvature_rolling / 2, curvature_axial / 2))  # A and B of z = A x² + B y²

    def ratio_error(log_k):
        m1 = np.exp(2 * log_k)
        k_int, e_int = ellipkm1(m1), ellipe(1 - m1)
        return np.log((e_int / m1 - k_int) / (k_int - e_int)) - np.log(large / small)

    m1 = np.exp(2 * brentq(ratio_error, np.log(1e-6), np.log(0.9999), xtol=1e-15, rtol=1e-15))
    e2, k_int, e_int = 1 - m1, ellipkm1(m1), ellipe(1 - m1)
    return 2 * np.pi * e_star / (3 * k_int) * np.sqrt((k_int - e_int) / (small * e2 * k_int))


class Point:
    """Contact of a ball: Q = K δ^1.5."""

    def __init__(self, constant):
        self.constant = constant

    def force(self, d):
        """Q and dQ/dδ at approaches d ≥ 0."""
        root = self.constant * np.sqrt(d)
        return root * d, 1.5 * root

    def approach(self, force):
        return (force / self.constant) ** (2 / 3)


class Line:
    """Contact of a roller, cut into laminae: Q = K/n Σ max(0, δ - P_k)^(10/9), ISO/TS 16281 for one of its two
    contacts."""

    def __init__(self, bearing):
        length, d_w = bearing["roller_length_mm"], bearing["element_diameter_mm"]
        n, profile = bearing.get("roller_laminae", 40), bearing.get("roller_profile", "log")
        assert profile in ("log", "straight") and length <= 2.5 * d_w, "only the standard's crown of short rollers"
        # 2^(10/9) 35948 L^(8/9) N/mm^(10/9), L in mm.
        self.constant = 2 ** (10 / 9) * 35948 * length ** (8 / 9) * 1000 ** (10 / 9)
        x = 2 * ((np.arange(n) + 0.5) / n - 0.5)
        self.depths = -0.00035 * d_w * 1e-3 * np.log(1 - x**2) if profile == "log" else np.zeros(1)

    def force(self, d):
        """As of a ball, by the sum itself."""
        ninths = np.cbrt(np.cbrt(over := np.maximum(np.asarray(d)[..., None] - self.depths, 0.0)))
        return self.constant * (over * ninths).mean(-1), 10 / 9 * self.constant * ninths.mean(-1)

    def approach(self, force):
        """No less than the true one."""
        return (force / self.constant) ** 0.9 + self.depths.mean()


@dataclass
class Ring:
    """One ring: moved by its forces, held, or following a given motion x0 + A sin(2πft)."""

    motion: str
    mass: float
    damping: float
    stiffness: float
    load: np.ndarray = field(default_factory=lambda: np.zeros(2))
    centre: np.ndarray = field(default_factory=lambda: np.zeros(2))
    amplitude: np.ndarray = field(default_factory=lambda: np.zeros(2))
    frequency: float = 0.0

    @classmethod
    def from_scene(cls, table, mass, damping, stiffness):
        """The last three hold where the scene leaves them out."""
        return cls(table.get("motion", "internal"), table.get("mass_kg", mass), table.get("damping_n_s_m", damping),
                   table.get("stiffness_n_m", stiffness), np.array(table.get("load_n", [0.0, 0.0]), float))

    def given_motion(self, t):
        """Position and velocity of a ring that is not moved by its forces."""
        angular = 2 * np.pi * self.frequency
        return self.centre + self.amplitude * np.sin(angular * t), self.amplitude * angular * np.cos(angular * t)


class Bearing:
    """Parameters of one scene and its right-hand side."""

    def __init__(self, scene):
        b, contact, cage = scene["bearing"], scene.get("contact", {}), scene.get("cage", {})
        d_w, d_pw = b["element_diameter_mm"] * 1e-3, b["pitch_diameter_mm"] * 1e-3
        self.z = b["element_count"]
        self.clearance = (
            b["radial_clearance_um"] * MICRO if "radial_clearance_um" in b else b["internal_clearance_um"] * MICRO / 2
        )
        self.r, self.r_o, self.r_i = d_w / 2, (d_pw + d_w + self.clearance) / 2, (d_pw - d_w - self.clearance) / 2
        self.rho0 = self.r_o - self.r  # radius of an element's centre at u = 0

        if b.get("element", "ball") == "cylindrical-roller":
            self.growth_i = self.growth_o = Line(b)
            volume = np.pi * d_w**2 / 4 * b["roller_length_mm"] * 1e-3
        else:
            groove = b.get("groove_diameter_mm", 0.0) * 1e-3 / (2 * d_w)
            e_star = b["youngs_modulus_gpa"] * 1e9 / (2 * (1 - b["poissons_ratio"] ** 2))
            axial_i = 1 / self.r - 1 / (b.get("conformity_inner", groove) * d_w)
            axial_o = 1 / self.r - 1 / (b.get("conformity_outer", groove) * d_w)
            k_i = b.get("hertz_inner_n_m1_5") or hertz_constant(1 / self.r + 1 / self.r_i, axial_i, e_star)
            k_o = b.get("hertz_outer_n_m1_5") or hertz_constant(1 / self.r - 1 / self.r_o, axial_o, e_star)
            self.growth_i, self.growth_o = Point(k_i), Point(k_o)
            volume = np.pi * d_w**3 / 6
        self.mass = b["element_mass_g"] * 1e-3 if "element_mass_g" in b else volume * b["density_kg_m3"]
        self.gravity = np.array(scene.get("gravity_m_s2", [0.0, -9.81]), float)
        self.law = contact.get("damping", "hunt-crossley")
        self.chi, self.tau = contact.get("damping_chi_s_m", 0.5), contact.get("damping_tau_s", 0.0)

        shaft, housing, gamma = scene["shaft"], scene.get("housing", {"motion": "fixed"}), d_w / d_pw
        self.omega_i, self.omega_o = (2 * np.pi * ring.get("speed_hz", 0.0) for ring in (shaft, housing))
        self.alpha_i, self.alpha_o = (np.radians(ring.get("initial_angle_deg", 0.0)) for ring in (shaft, housing))
        inner, outer = self.omega_i * (1 - gamma), self.omega_o * (1 + gamma)
        self.omega_c = 0.5 * (inner + outer) * (1 - cage.get("slip", 0.0))
        self.omega_b = (outer - inner) / (2 * gamma)  # absolute
        self.theta0 = np.radians(cage.get("initial_angle_deg", -90.0))
        self.spall = Spall(scene["defect"], self) if "defect" in scene else None

        self.shaft = Ring.from_scene(shaft, 3.2638, 1376.8, 0.0)
        self.housing = Ring.from_scene(housing, 6.638, 2210.7, 1.51056e7)
        sensor = scene.get("sensor")
        self.sensor = (sensor["mass_kg"], sensor["stiffness_n_m"], sensor["damping_n_s_m"]) if sensor else None
        self.n_rings = 4 * (self.shaft.motion == "internal") + 4 * (self.housing.motion == "internal")
        self.n_front = self.n_rings + 2 * bool(self.sensor)
        self.removed = []  # elements taken out, for what-if measurements

    @classmethod
    def load(cls, path):
        with open(path, "rb") as f:
            return cls(tomllib.load(f))

    # --- kinematics ---------------------------------------------------------------------------------------------
    def angles(self, t):
        return self.theta0 + self.omega_c * t + 2 * np.pi * np.arange(self.z) / self.z

    def knots(self, start, stop):
        """Times at which some element passes a corner of the outer path; the inner's depend on the rings' motion."""
        if not self.spall or "outer" not in self.spall.paths or self.omega_c == self.spall.omega:
            return []
        rate, times = self.omega_c - self.spall.omega, []
        for corner in self.spall.paths["outer"].corners:
            phase = self.spall.angle("outer", self.angles(0.0), 0.0)[self.spall.elements] - corner
            for turn in range(int(-2 - abs(rate) * stop), int(3 + abs(rate) * stop)):
                times.extend((2 * np.pi * turn - phase) / rate)
        return sorted(t for t in times if start < t < stop)

    # --- forces -------------------------------------------------------------------------------------------------
    def contact_force(self, growth, approach, rate):
        """Q ≥ 0, and a number that is positive exactly where Q is (for locating contact changes)."""
        d = np.maximum(approach, 0.0)
        elastic, slope = growth.force(d)
        if self.law == "proportional":
            if isinstance(growth, Point):
                damped = approach + 1.5 * self.tau * rate
            else:  # by Q over its secant; where nothing carries it is of a straight roller's order
                damped = approach + self.tau * rate * np.where(
                    d > 0, slope * d / np.where(elastic > 0, elastic, 1.0), 10 / 9
                )
            secant = np.where(d > 0, elastic / np.where(d > 0, d, 1.0), 0.0)
            return secant * np.maximum(damped * (d > 0), 0.0), np.minimum(approach, damped) / MICRO
        factor = 1 + self.chi * rate
        return elastic * np.maximum(factor, 0.0), np.minimum(approach / MICRO, factor)

    def contacts(self, t, u, u_dot, x_i, v_i, x_o, v_o):
        """All contact forces and directions at one moment."""
        theta = self.angles(t)
        e_r, e_t = np.array([np.cos(theta), np.sin(theta)]), np.array([-np.sin(theta), np.cos(theta)])
        rho = self.rho0 + u
        s = (x_o - x_i)[:, None] + u * e_r  # q = ρ0 e_r + s
        q = self.rho0 * e_r + s
        q_length = np.sqrt((q * q).sum(0))
        n = q / q_length
        t_i = np.array([-n[1], n[0]])
        # R_i + r - |q| without cancellation: R_i + r = ρ0 - G_r, and ρ0 - |q| = (ρ0² - |q|²)/(ρ0 + |q|).
        inner = -self.clearance - (2 * self.rho0 * (e_r * s).sum(0) + (s * s).sum(0)) / (self.rho0 + q_length)
        inner_rate = -(
            (n * ((v_o - v_i)[:, None] + u_dot * e_r)).sum(0) + rho * self.omega_c * (s * e_t).sum(0) / q_length
        )
        outer, outer_rate, slope_i, slope_o, corners = u, u_dot, 0.0, 0.0, np.empty(0)
        if self.spall:
            phi = np.arctan2(q[1], q[0])
            phi_dot = (t_i * ((v_o - v_i)[:, None] + u_dot * e_r + rho * self.omega_c * e_t)).sum(0) / q_length
            (p_i, slope_i), (p_o, slope_o) = self.spall.path("inner", phi, t), self.spall.path("outer", theta, t)
            inner, inner_rate = inner - p_i, inner_rate - slope_i * (phi_dot - self.spall.omega)
            outer, outer_rate = outer - p_o, outer_rate - slope_o * (self.omega_c - self.spall.omega)
            corners = self.spall.past_corners("inner", phi, t)
        q_i, switch_i = self.contact_force(self.growth_i, inner, inner_rate)
        q_o, switch_o = self.contact_force(self.growth_o, outer, outer_rate)
        for j in self.removed:
            q_i[j] = q_o[j] = 0.0
        tan_i, tan_o = slope_i / q_length, slope_o / rho
        cos_i, cos_o = 1 / np.sqrt(1 + tan_i * tan_i), 1 / np.sqrt(1 + tan_o * tan_o)
        return Contacts(e_r, e_t, n, t_i, q_length, q_i, q_o, q_i * cos_i, q_i * cos_i * tan_i, q_o * cos_o,
                        q_o * cos_o * tan_o, inner, outer, switch_i, switch_o, corners)

    def split(self, t, y):
        """x_i, v_i, x_o, v_o, u, w of a state."""
        parts, at = [], 0
        for ring in (self.shaft, self.housing):
            if ring.motion == "internal":
                parts += [y[at:at + 2], y[at + 2:at + 4]]
                at += 4
            else:
                parts += ring.given_motion(t)
        return *parts, y[self.n_front:self.n_front + self.z], y[self.n_front + self.z:]

    def contacts_at(self, t, y):
        x_i, v_i, x_o, v_o, u, w = self.split(t, y)
        theta = self.angles(t)
        return self.contacts(t, u, w - np.cos(theta) * v_o[0] - np.sin(theta) * v_o[1], x_i, v_i, x_o, v_o)

    def rhs(self, t, y):
        x_i, v_i, x_o, v_o, u, w = self.split(t, y)
        dy, c = np.empty_like(y), self.contacts_at(t, y)
        at = 0
        if self.shaft.motion == "internal":
            dy[0:2] = v_i
            dy[2:4] = (
                c.on_shaft() + self.shaft.load - self.shaft.damping * v_i - self.shaft.stiffness * x_i
            ) / self.shaft.mass
            at = 4
        resonator = np.zeros(2)
        if self.sensor:
            m, k, d = self.sensor
            y_r, v_r = y[self.n_rings:self.n_front]
            resonator[1] = k * (y_r - x_o[1]) + d * (v_r - v_o[1])
            dy[self.n_rings:self.n_front] = v_r, -resonator[1] / m
        if self.housing.motion == "internal":
            own = self.housing.load - self.housing.damping * v_o - self.housing.stiffness * x_o
            dy[at:at + 2] = v_o
            dy[at + 2:at + 4] = (c.on_housing() + own + resonator) / self.housing.mass
        radial = c.on_elements() / self.mass + self.gravity @ c.e_r
        dy[self.n_front:self.n_front + self.z] = w - v_o @ c.e_r
        dy[self.n_front + self.z:] = radial + self.omega_c * (v_o @ c.e_t + (self.rho0 + u) * self.omega_c)
        return dy


@dataclass
class Contacts:
    """Contact forces of all elements; arrays over elements, directions as 2 × Z.

    Components are those of the force on the element, `q_o_radial` inwards.
    """

    e_r: np.ndarray
    e_t: np.ndarray
    n: np.ndarray
    t: np.ndarray
    length: np.ndarray
    q_i: np.ndarray
    q_o: np.ndarray
    q_i_normal: np.ndarray
    q_i_tangential: np.ndarray
    q_o_radial: np.ndarray
    q_o_tangential: np.ndarray
    inner: np.ndarray
    outer: np.ndarray
    switch_i: np.ndarray
    switch_o: np.ndarray
    corners: np.ndarray

    def on_elements(self):
        """Net force of each element's contacts, radially outwards."""
        inner = self.q_i_normal * (self.n * self.e_r).sum(0) + self.q_i_tangential * (self.t * self.e_r).sum(0)
        return inner - self.q_o_radial

    def on_shaft(self):
        return -(self.n * self.q_i_normal + self.t * self.q_i_tangential).sum(1)

    def torque_on_shaft(self):
        """About the shaft's centre, counter-clockwise: the tilted forces pass through the elements' centres."""
        return -(self.q_i_tangential * self.length).sum()

    def on_housing(self):
        return (self.e_r * self.q_o_radial - self.e_t * self.q_o_tangential).sum(1)

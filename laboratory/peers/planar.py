"""Peers on a ball bearing whose rings move in a plane, healthy or with a rectangular spall of a standing outer ring.

    python laboratory/peers/planar.py SCENE.toml … [--stop 0.02] [--step 1e-5] [--repeat 3] [--peers NAME …] [--csv F]

Contact law `hertz`, damping of Hunt and Crossley, both rings moved by their forces. States: shaft x y vx vy, housing
the same, sensor y vy if there is one, then of all elements the distance u from the smooth outer path and its absolute
rate w. What is compared is said in integrators.py.
"""

import math

import numba
import numpy as np
from integrators import Problem, hertz_constant, main
from scipy.optimize import root


def geometry(b, clearance):
    """Hertz's constants of both contacts, an element's radius, the raceways' and that of the path (m)."""
    d_w, d_pw = b["element_diameter_mm"] / 1e3, b["pitch_diameter_mm"] / 1e3
    r, r_i, r_o = d_w / 2, (d_pw - d_w - clearance) / 2, (d_pw + d_w + clearance) / 2
    groove = b.get("groove_diameter_mm", 0.0) / 1e3 / (2 * d_w)
    e_star = b["youngs_modulus_gpa"] * 1e9 / (2 * (1 - b["poissons_ratio"] ** 2))
    axial = [1 / r - 1 / (b.get(f"conformity_{side}", groove) * d_w) for side in ("inner", "outer")]
    k_i = hertz_constant(1 / r + 1 / r_i, axial[0], e_star)
    return k_i, hertz_constant(1 / r - 1 / r_o, axial[1], e_star), r, r_o, r_o - r


def compile_inner(rho0, clearance, k_i, chi, omega):
    """Contact of an element and the inner ring as machine code: inner(c, s, u, u_dot, x, y, vx, vy), the last four of
    the outer ring's centre against the inner ring's. Force, direction times length (x and y), length."""

    @numba.njit
    def inner(c, s, u, u_dot, x, y, vx, vy):
        sx, sy = x + u * c, y + u * s
        qx, qy = rho0 * c + sx, rho0 * s + sy
        length = math.sqrt(qx * qx + qy * qy)
        depth = -clearance - (2 * rho0 * (c * sx + s * sy) + sx * sx + sy * sy) / (rho0 + length)
        if depth > 0:
            approach = qx * (vx + u_dot * c) + qy * (vy + u_dot * s)
            rate = -(approach + (rho0 + u) * omega * (c * sy - s * sx)) / length
            return k_i * depth * math.sqrt(depth) * max(0.0, 1 + chi * rate), qx, qy, length
        return 0.0, qx, qy, length

    return inner


def compile_path(defect, r, r_o):
    """The rigid path over the spall as machine code: path(theta), P and dP/dψ."""
    if defect is None:
        return numba.njit(lambda theta: (0.0, 0.0))
    assert defect.get("on", "outer") == "outer" and defect.get("edge_slope_deg", 90.0) == 90.0, "a rectangular spall"
    middle, depth, tau = math.radians(defect["angle_deg"]), defect["depth_um"] / 1e6, 2 * math.pi
    half = (math.radians(defect["length_deg"]) if "length_deg" in defect else defect["length_mm"] / 1e3 / r_o) / 2
    # Past an edge by this angle the floor is touched: a triangle of the two radii and the distance of the centres.
    centres = r_o - r + depth
    roll_in = math.acos((centres**2 + r_o**2 - r**2) / (2 * centres * r_o))

    @numba.njit
    def path(theta):
        psi = -((middle - theta + math.pi) % tau) + math.pi
        d = half - abs(psi)
        if d >= roll_in:
            return depth, 0.0
        if d > 0:
            cd, sd = math.cos(d), math.sin(d)
            root = math.sqrt(r * r - (r_o * sd) ** 2)
            p = -2 * r_o * math.sin(d / 2) ** 2 + (r_o * sd) ** 2 / (r + root)
            return p, -math.copysign(1.0, psi) * (-r_o * sd + r_o**2 * sd * cd / root)
        return 0.0, 0.0

    return path


def compile_outer(rho0, k_o, chi, omega, path):
    """Contact of an element and the outer ring as machine code: outer(theta, u, u_dot), the force's radial and
    tangential part."""

    @numba.njit
    def outer(theta, u, u_dot):
        p, slope = path(theta)
        depth = u - p
        if depth > 0:
            tan = slope / (rho0 + u)
            damping = max(0.0, 1 + chi * (u_dot - slope * omega))
            radial = k_o * depth * math.sqrt(depth) * damping / math.sqrt(1 + tan * tan)
            return radial, radial * tan
        return 0.0, 0.0

    return outer


def compile_rings(shaft, housing, sensor):
    """Motion of both rings and of the sensor as machine code: rings(y, shx, shy, hox, hoy, dy) under the contacts'
    forces on shaft and housing."""
    m_s, c_s, k_s, m_h, c_h, k_h = (
        ring[key] for ring in (shaft, housing) for key in ("mass_kg", "damping_n_s_m", "stiffness_n_m")
    )
    (fsx, fsy), (fhx, fhy) = (ring.get("load_n", [0.0, 0.0]) for ring in (shaft, housing))
    sensor = sensor or {"mass_kg": 1.0, "stiffness_n_m": 0.0, "damping_n_s_m": 0.0}
    m_r, k_r, c_r = (sensor[key] for key in ("mass_kg", "stiffness_n_m", "damping_n_s_m"))

    @numba.njit
    def rings(y, shx, shy, hox, hoy, dy):
        dy[0], dy[1], dy[4], dy[5] = y[2], y[3], y[6], y[7]
        dy[2] = (shx + fsx - c_s * y[2] - k_s * y[0]) / m_s
        dy[3] = (shy + fsy - c_s * y[3] - k_s * y[1]) / m_s
        resonator = 0.0
        if k_r > 0:
            resonator = k_r * (y[8] - y[5]) + c_r * (y[9] - y[7])
            dy[8], dy[9] = y[9], -resonator / m_r
        dy[6] = (hox + fhx - c_h * y[6] - k_h * y[4]) / m_h
        dy[7] = (hoy + fhy - c_h * y[7] - k_h * y[5] + resonator) / m_h

    return rings


def compile_rhs(scene):
    """rhs(t, y, dy) as machine code."""
    b, contact, shaft, housing = scene["bearing"], scene["contact"], scene["shaft"], scene["housing"]
    assert b.get("element", "ball") == "ball" and contact["damping"] == "hunt-crossley", "balls, Hunt-Crossley"
    assert shaft["motion"] == housing["motion"] == "internal" and "speed_hz" not in housing, "rings under forces"
    clearance, chi, z = b["radial_clearance_um"] / 1e6, contact["damping_chi_s_m"], b["element_count"]
    k_i, k_o, r, r_o, rho0 = geometry(b, clearance)
    m = b["density_kg_m3"] * math.pi / 6 * (2 * r) ** 3
    gamma, (gx, gy) = b["element_diameter_mm"] / b["pitch_diameter_mm"], scene["gravity_m_s2"]
    omega = math.pi * shaft["speed_hz"] * (1 - gamma) * (1 - scene["cage"]["slip"])
    theta0, n_f, tau = math.radians(scene["cage"]["initial_angle_deg"]), 8 + 2 * ("sensor" in scene), 2 * math.pi
    inner = compile_inner(rho0, clearance, k_i, chi, omega)
    outer = compile_outer(rho0, k_o, chi, omega, compile_path(scene.get("defect"), r, r_o))
    rings = compile_rings(shaft, housing, scene.get("sensor"))

    @numba.njit
    def rhs(t, y, dy):
        shx = shy = hox = hoy = 0.0
        v_ox, v_oy = y[6], y[7]
        for j in range(z):
            theta = theta0 + omega * t + tau * j / z
            c, s = math.cos(theta), math.sin(theta)
            u, w = y[n_f + j], y[n_f + z + j]
            u_dot = w - c * v_ox - s * v_oy
            q_i, qx, qy, length = inner(c, s, u, u_dot, y[4] - y[0], y[5] - y[1], v_ox - y[2], v_oy - y[3])
            radial, tangential = outer(theta, u, u_dot)
            shx -= q_i * qx / length
            shy -= q_i * qy / length
            hox += c * radial + s * tangential
            hoy += s * radial - c * tangential
            push = (q_i * (qx * c + qy * s) / length - radial) / m + gx * c + gy * s
            dy[n_f + j] = u_dot
            dy[n_f + z + j] = push + omega * (c * v_oy - s * v_ox + (rho0 + u) * omega)
        rings(y, shx, shy, hox, hoy, dy)

    return rhs


def balance(rhs, scene, n_f, z):
    """All in balance about the turning cage. Given the rings, what pushes an element outwards falls with its u."""
    load, stiffness = np.array(scene["shaft"]["load_n"]), scene["housing"]["stiffness_n_m"]

    def rates(y):
        dy = np.empty(len(y))
        rhs(0.0, y, dy)
        return dy

    def state(x):
        y = np.zeros(n_f + 2 * z)
        y[[0, 1, 4, 5]] = 1e-6 * x
        if n_f > 8:
            y[8] = y[5]
        low, high = np.full(z, -0.5e-3), np.full(z, 1e-3)
        for _ in range(100):
            y[n_f : n_f + z] = middle = 0.5 * (low + high)
            outward = rates(y)[n_f + z :] > 0
            low, high = np.where(outward, middle, low), np.where(outward, high, middle)
        return y

    guess = np.concatenate([load / stiffness + 2e-5 * load / np.linalg.norm(load), load / stiffness])
    solved = root(lambda x: rates(state(x))[[2, 3, 6, 7]], 1e6 * guess, tol=1e-14)
    found = state(solved.x)
    assert np.abs(rates(found)[[2, 3, 6, 7]]).max() < 1e-6, solved.message
    return found


def problem(scene):
    rhs, n_f, z = compile_rhs(scene), 8 + 2 * ("sensor" in scene), scene["bearing"]["element_count"]
    scale = np.full(n_f + 2 * z, 1e-6)  # positions count against 1 µm, velocities against 1 mm/s
    scale[[2, 3, 6, 7, *range(9, n_f)]] = scale[n_f + z :] = 1e-3
    return Problem(rhs, balance(rhs, scene, n_f, z), scale, 7, slice(n_f, n_f + z))


if __name__ == "__main__":
    main(__doc__, problem, [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8])

"""Peers on a healthy bearing with three degrees of freedom.

    python laboratory/peers/in_space.py scenes/7205-preloaded.toml [--stop 0.02] [--step 1e-5] [--repeat 3]

The equations are those of docs/explanation/axial.md, written from the page: balls between two grooves whose rings move
along x, y and z under forces, law of Hunt and Crossley, a sensor along z. No defect, no tilt. What is compared is said
in integrators.py.
"""

import math

import numba
import numpy as np
from integrators import Problem, hertz_constant, main
from scipy.optimize import least_squares

# Shaft x y z and rates, housing the same, sensor s s'; then u, v, w and w_z of all balls.
BODIES = 14


def geometry(b):
    """Radii of the circles of groove centres, their places, reaches and Hertz's constants, inside and outside."""
    d, d_pw, free = b["element_diameter_mm"] / 1e3, b["pitch_diameter_mm"] / 1e3, math.radians(b["contact_angle_deg"])
    r, grooves = d / 2, [b["conformity_inner"] * d, b["conformity_outer"] * d]
    reach = [groove - r for groove in grooves]
    clearance = sum(reach) * (1 - math.cos(free))
    r_i, r_o = (d_pw - d - clearance) / 2, (d_pw + d + clearance) / 2
    e_star = b["youngs_modulus_gpa"] * 1e9 / (2 * (1 - b["poissons_ratio"] ** 2))
    rolled = [math.cos(free) / (d_pw / 2 - r * math.cos(free)), -math.cos(free) / (d_pw / 2 + r * math.cos(free))]
    k = [hertz_constant(1 / r + along, 1 / r - 1 / groove, e_star) for along, groove in zip(rolled, grooves)]
    places = [reach[0] * math.sin(free), -reach[1] * math.sin(free)]
    return [r_i + grooves[0], r_o - grooves[1]], places, reach, k, r_o - r


def compile_contact(centre, place, reach, k, chi):
    """Force of one groove on a ball along e_r, e_t and z, seen from the groove's ring at q and moving at v."""

    @numba.njit
    def contact(q_r, q_t, h, v_r, v_t, v_z):
        g = math.sqrt(q_r * q_r + q_t * q_t)
        e_r, e_t = q_r / g, q_t / g
        inwards, along = centre - g, place - h
        d = math.sqrt(inwards * inwards + along * along)
        depth = d - reach
        if depth <= 0.0:
            return 0.0, 0.0, 0.0
        n_e, n_z = inwards / d, along / d
        radial = v_r * e_r + v_t * e_t
        rate, creep = -(n_e * radial + n_z * v_z), n_e * v_z - n_z * radial
        force = k * depth * math.sqrt(depth) * max(0.0, 1 + chi * rate)
        outwards = force * (n_e + chi * creep * n_z)
        return outwards * e_r, outwards * e_t, force * (n_z - chi * creep * n_e)

    return contact


def compile_rhs(scene):
    """rhs(t, y, dy) as machine code, the number of balls, and the masses of shaft, housing, sensor and ball."""
    b, contact, shaft, housing = scene["bearing"], scene["contact"], scene["shaft"], scene["housing"]
    assert b["degrees_of_freedom"] == 3 and "defect" not in scene and contact["damping"] == "hunt-crossley"
    centres, places, reaches, k, rho0 = geometry(b)
    chi, z, gravity = contact["damping_chi_s_m"], b["element_count"], scene["gravity_m_s2"]
    inner, outer = (compile_contact(*of, chi) for of in zip(centres, places, reaches, k))
    m = b["density_kg_m3"] * math.pi / 6 * (b["element_diameter_mm"] / 1e3) ** 3
    gamma = b["element_diameter_mm"] / b["pitch_diameter_mm"] * math.cos(math.radians(b["contact_angle_deg"]))
    omega = math.pi * shaft["speed_hz"] * (1 - gamma) * (1 - scene["cage"]["slip"])
    theta0, (gx, gy, gz) = math.radians(scene["cage"]["initial_angle_deg"]), gravity
    load = np.array(shaft["load_n"]) + [0.0, 0.0, shaft["preload_n"]]
    m_s, c_s, k_s = (shaft[key] for key in ("mass_kg", "damping_n_s_m", "stiffness_n_m"))
    m_h, c_h, k_h = (housing[key] for key in ("mass_kg", "damping_n_s_m", "stiffness_n_m"))
    assert scene["sensor"]["direction"] == [0.0, 0.0, 1.0]
    m_r, k_r, c_r = (scene["sensor"][key] for key in ("mass_kg", "stiffness_n_m", "damping_n_s_m"))
    us, vs, ws, zs = (BODIES + i * z for i in range(4))

    @numba.njit
    def rhs(t, y, dy):
        on_shaft, on_housing = np.zeros(3), np.zeros(3)
        for j in range(z):
            theta = theta0 + omega * t + 2 * math.pi * j / z
            c, s = math.cos(theta), math.sin(theta)
            u, v, w, w_z = y[us + j], y[vs + j], y[ws + j], y[zs + j]
            rho = rho0 + u
            u_dot, v_dot = w - c * y[9] - s * y[10], w_z - y[11]
            off_x, off_y, off_vx, off_vy = y[6] - y[0], y[7] - y[1], y[9] - y[3], y[10] - y[4]
            o_r, o_t, o_z = outer(rho, 0.0, v, u_dot, rho * omega, v_dot)
            i_r, i_t, i_z = inner(rho + c * off_x + s * off_y, c * off_y - s * off_x, v + y[8] - y[2],
                                  u_dot + c * off_vx + s * off_vy, rho * omega + c * off_vy - s * off_vx,
                                  v_dot + y[11] - y[5])
            on_shaft[0] -= i_r * c - i_t * s
            on_shaft[1] -= i_r * s + i_t * c
            on_shaft[2] -= i_z
            on_housing[0] -= o_r * c - o_t * s
            on_housing[1] -= o_r * s + o_t * c
            on_housing[2] -= o_z
            dy[us + j], dy[vs + j] = u_dot, v_dot
            dy[ws + j] = (i_r + o_r) / m + gx * c + gy * s + omega * (c * y[10] - s * y[9] + rho * omega)
            dy[zs + j] = (i_z + o_z) / m + gz
        sensor = k_r * (y[12] - y[8]) + c_r * (y[13] - y[11])
        on_housing[2] += sensor
        dy[12], dy[13] = y[13], -sensor / m_r
        for i in range(3):
            dy[i], dy[6 + i] = y[3 + i], y[9 + i]
            dy[3 + i] = (on_shaft[i] + load[i] - c_s * y[3 + i] - k_s * y[i]) / m_s
            dy[9 + i] = (on_housing[i] - c_h * y[9 + i] - k_h * y[6 + i]) / m_h

    return rhs, z, [m_s, m_h, m_r, m]


def balance(rhs, rates, masses):
    """All in balance about the turning cage: forces vanish, looked for from 10 µm of displacement along z on."""
    n, count = len(rates), (len(rates) - BODIES) // 4
    found = np.zeros(n)
    found[2], found[BODIES + count : BODIES + 2 * count] = 10e-6, 5e-6

    def forces(x):
        y, dy = np.zeros(n), np.empty(n)
        y[~rates] = 1e-6 * x
        rhs(0.0, y, dy)
        return masses * dy[rates]

    solved = least_squares(forces, 1e6 * found[~rates], method="lm", xtol=1e-15, ftol=1e-15, gtol=1e-15)
    found[~rates] = 1e-6 * solved.x
    assert np.abs(forces(solved.x)).max() < 1e-6, solved.message
    return found


def problem(scene):
    rhs, count, (shaft, housing, sensor, ball) = compile_rhs(scene)
    rates = np.zeros(BODIES + 4 * count, bool)
    rates[3:6] = rates[9:12] = rates[13] = True
    rates[BODIES + 2 * count :] = True
    masses = np.array([shaft] * 3 + [housing] * 3 + [sensor] + [ball] * 2 * count)
    # Some 5 µm of approach, and that at the balls' 2e5 rad/s.
    scale = np.where(rates, 1.0, 5e-6)
    return Problem(rhs, balance(rhs, rates, masses), scale, 10, slice(BODIES, BODIES + count))


if __name__ == "__main__":
    main(__doc__, problem, [1e-8, 1e-9, 1e-10, 1e-11])

/* The shaft of examples/pair_of_bearings.py: a rigid body in two bearings, as an FMI 2.0 co-simulation unit.

       m x'' = F,   I_t tilt.x'' + I_p w tilt.y' = M_x,   I_t tilt.y'' - I_p w tilt.x' = M_y

   in x, y, z and about x and y, at the speed w. A bearing at the place b on the axis is moved by x + b tilt.y,
   y - b tilt.x, z + offset, and its force and moment act there. Forces that grow evenly leave nothing to the steps of
   Runge and Kutta but the gyroscopic coupling. */

/* Value references: forces and moments of the left and the right bearing, then for each what moves it, then the shaft
   itself, then parameters, in the order of variables() in pair_of_bearings.py. */
enum { FORCE, END = 10, POSITION = END + 30, VELOCITY = POSITION + 5, MASS = VELOCITY + 5, TRANSVERSE, POLAR, SPEED };
enum { LOAD = SPEED + 1, PLACE = LOAD + 5, OFFSET = PLACE + 2, START = OFFSET + 2, COUNT = START + 5 };
enum { INPUTS = END, PARAMETERS = MASS };

#include "unit.h"

static void fresh(double p[COUNT]) {
    p[MASS] = 3.0;
    p[TRANSVERSE] = 8e-3;
    p[POLAR] = 2e-3;
    p[SPEED] = 314.159265358979;
    p[PLACE] = -0.03;
    p[PLACE + 1] = 0.03;
}

static int is_possible(unsigned reference, double value) {
    return reference > POLAR || value > 0.0;
}

static void start(double p[COUNT]) {
    memcpy(p + POSITION, p + START, 5 * sizeof *p);
}

/* Accelerations of x, y, z and both tilts, the forces having grown for so long. */
static void accelerations(const double p[COUNT], const double *rate, double t, const double v[5], double a[5]) {
    memcpy(a, p + LOAD, 5 * sizeof *a);
    for (int k = 0; k < 2; k++) {
        double f[5];
        for (int i = 0; i < 5; i++) {
            f[i] = p[FORCE + 5 * k + i] + (rate ? rate[5 * k + i] * t : 0.0);
            a[i] += f[i];
        }
        a[3] -= p[PLACE + k] * f[1];
        a[4] += p[PLACE + k] * f[0];
    }
    double gyroscopic = p[POLAR] * p[SPEED];
    a[3] -= gyroscopic * v[4];
    a[4] += gyroscopic * v[3];
    for (int i = 0; i < 5; i++) {
        a[i] /= p[i < 3 ? MASS : TRANSVERSE];
    }
}

static void show(double p[COUNT]) {
    double a[5];
    accelerations(p, NULL, 0.0, p + VELOCITY, a);
    const double *orders[3] = {p + POSITION, p + VELOCITY, a};
    for (int k = 0; k < 2; k++) {
        for (int order = 0; order < 3; order++) {
            const double *q = orders[order];
            double *end = p + END + 15 * k, b = p[PLACE + k];
            end[3 * order] = q[0] + b * q[4];
            end[3 * order + 1] = q[1] - b * q[3];
            end[3 * order + 2] = q[2] + (order ? 0.0 : p[OFFSET + k]);
            end[9 + 2 * order] = q[3];
            end[10 + 2 * order] = q[4];
        }
    }
}

static void step(double p[COUNT], const double rate[INPUTS], double length) {
    double count = fmax(1.0, ceil(20.0 * fabs(p[SPEED]) * p[POLAR] / p[TRANSVERSE] * length));
    double h = length / count, *x = p + POSITION, *v = p + VELOCITY;
    for (double n = 0.0; n < count; n += 1.0) {
        double a[4][5], w[4][5];
        for (int stage = 0; stage < 4; stage++) {
            double share = stage == 0 ? 0.0 : stage == 3 ? 1.0 : 0.5;
            for (int i = 0; i < 5; i++) {
                w[stage][i] = v[i] + (stage ? share * h * a[stage - 1][i] : 0.0);
            }
            accelerations(p, rate, (n + share) * h, w[stage], a[stage]);
        }
        for (int i = 0; i < 5; i++) {
            x[i] += h / 6.0 * (w[0][i] + 2.0 * w[1][i] + 2.0 * w[2][i] + w[3][i]);
            v[i] += h / 6.0 * (a[0][i] + 2.0 * a[1][i] + 2.0 * a[2][i] + a[3][i]);
        }
    }
}

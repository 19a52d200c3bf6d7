/* The rotor of examples/run_up.py: a disk with unbalance in the middle of an elastic shaft, run up, as an FMI 2.0
   co-simulation unit.

       m z'' + c z' + k s = W + m e (w^2 + i w') exp(i phi),   m_j z_j'' = F_j + k s/2,   s = z - (z_l + z_r)/2

   with z = x + i y of the disk, z_l and z_r of the journals in the left and the right bearing, the speed w = w_0 + w' t
   and its angle phi. Runge and Kutta's steps of fourth order, 50 in the fastest 1/sqrt(k/m) or 1/w. */

/* Value references: forces of the left and the right bearing, speed, motion of both journals and of the disk, angle,
   then parameters, in the order of variables() in run_up.py. */
enum { FORCE, SPEED = 4, JOURNAL, X = JOURNAL + 12, V = X + 2, ANGLE = V + 2, MASS, JOURNAL_MASS, STIFFNESS, DAMPING };
enum { ECCENTRICITY = DAMPING + 1, RATE, LOAD, START_SPEED, START, COUNT = START + 2 };
enum { INPUTS = SPEED, PARAMETERS = MASS };

#include "unit.h"

static void fresh(double p[COUNT]) {
    p[MASS] = 10.0;
    p[JOURNAL_MASS] = 1.0;
    p[STIFFNESS] = 2e7;
}

static int is_possible(unsigned reference, double value) {
    return reference > DAMPING || (reference == DAMPING ? value >= 0.0 : value > 0.0);
}

static void start(double p[COUNT]) {
    p[SPEED] = p[START_SPEED];
    for (int axis = 0; axis < 2; axis++) {
        p[JOURNAL + axis] = p[JOURNAL + 6 + axis] = p[X + axis] = p[START + axis];
    }
    p[X + 1] += p[LOAD] / p[STIFFNESS];
}

/* Accelerations along an axis of the left and the right journal and the disk, the forces having grown for so long. */
static void accelerations(const double p[COUNT], const double *rate, double t, int axis, const double x[3], double v,
                          double a[3]) {
    double speed = p[SPEED] + p[RATE] * t, angle = p[ANGLE] + (p[SPEED] + 0.5 * p[RATE] * t) * t;
    double pull = p[STIFFNESS] * (x[2] - 0.5 * (x[0] + x[1])), out = speed * speed;
    for (int k = 0; k < 2; k++) {
        double force = p[FORCE + 2 * k + axis] + (rate ? rate[2 * k + axis] * t : 0.0);
        a[k] = (force + 0.5 * pull) / p[JOURNAL_MASS];
    }
    double turning = axis ? out * sin(angle) + p[RATE] * cos(angle) : out * cos(angle) - p[RATE] * sin(angle);
    a[2] = ((axis ? p[LOAD] : 0.0) - pull - p[DAMPING] * v) / p[MASS] + p[ECCENTRICITY] * turning;
}

static void show(double p[COUNT]) {
    for (int axis = 0; axis < 2; axis++) {
        double x[3] = {p[JOURNAL + axis], p[JOURNAL + 6 + axis], p[X + axis]}, a[3];
        accelerations(p, NULL, 0.0, axis, x, p[V + axis], a);
        p[JOURNAL + 4 + axis] = a[0];
        p[JOURNAL + 10 + axis] = a[1];
    }
}

static void step(double p[COUNT], const double rate[INPUTS], double length) {
    double lightest = fmin(p[MASS], p[JOURNAL_MASS]);
    double fastest = fmax(sqrt(2.0 * p[STIFFNESS] / lightest), fabs(p[SPEED]) + fabs(p[RATE]) * length);
    double count = fmax(1.0, ceil(50.0 * fastest * length)), h = length / count;
    for (int axis = 0; axis < 2; axis++) {
        /* Velocities stand two places behind positions. */
        const int place[3] = {JOURNAL + axis, JOURNAL + 6 + axis, X + axis};
        for (double n = 0.0; n < count; n += 1.0) {
            double a[4][3], w[4][3];
            for (int stage = 0; stage < 4; stage++) {
                double share = stage == 0 ? 0.0 : stage == 3 ? 1.0 : 0.5, x[3];
                for (int i = 0; i < 3; i++) {
                    x[i] = p[place[i]] + (stage ? share * h * w[stage - 1][i] : 0.0);
                    w[stage][i] = p[place[i] + 2] + (stage ? share * h * a[stage - 1][i] : 0.0);
                }
                accelerations(p, rate, (n + share) * h, axis, x, w[stage][2], a[stage]);
            }
            for (int i = 0; i < 3; i++) {
                p[place[i]] += h / 6.0 * (w[0][i] + 2.0 * w[1][i] + 2.0 * w[2][i] + w[3][i]);
                p[place[i] + 2] += h / 6.0 * (a[0][i] + 2.0 * a[1][i] + 2.0 * a[2][i] + a[3][i]);
            }
        }
    }
    p[ANGLE] += (p[SPEED] + 0.5 * p[RATE] * length) * length;
    p[SPEED] += p[RATE] * length;
}

/* The rotor of examples/system_of_fmus.py: an overhung mass on its elastic shaft, as an FMI 2.0 co-simulation unit.

       m z'' + c z' + k z = F(t) + W        in x and in y

   The shaft, clamped on its other side, holds the mass by its bending stiffness k and damps with c; W is a load, F what
   a bearing does to it. Runge and Kutta's steps of fourth order, 200 in 1/sqrt(k/m) or m/c, leave some 1e-12 of the
   motion. */

/* Value references, in the order of rotor.xml. */
enum { FORCE, X = 2, V = 4, A = 6, MASS = 8, STIFFNESS, DAMPING, LOAD, START = LOAD + 2, COUNT = START + 2 };
enum { INPUTS = X, PARAMETERS = MASS };

#include "unit.h"

static void fresh(double p[COUNT]) {
    p[MASS] = 3.0;
    p[STIFFNESS] = 1e7;
}

static int is_possible(unsigned reference, double value) {
    return reference == MASS ? value > 0.0 : (reference != STIFFNESS && reference != DAMPING) || value >= 0.0;
}

static void start(double p[COUNT]) {
    for (int i = 0; i < 2; i++) {
        p[X + i] = p[START + i];
    }
}

/* Acceleration along axis i, at this force. */
static double acceleration(const double p[COUNT], int i, double force, double x, double v) {
    return (force + p[LOAD + i] - p[DAMPING] * v - p[STIFFNESS] * x) / p[MASS];
}

static void show(double p[COUNT]) {
    for (int i = 0; i < 2; i++) {
        p[A + i] = acceleration(p, i, p[FORCE + i], p[X + i], p[V + i]);
    }
}

static void step(double p[COUNT], const double rate[INPUTS], double length) {
    double fastest = fmax(sqrt(p[STIFFNESS] / p[MASS]), p[DAMPING] / p[MASS]);
    double count = fmax(1.0, ceil(200.0 * fastest * length));
    double h = length / count;
    for (int i = 0; i < 2; i++) {
        double x = p[X + i], v = p[V + i];
        for (double n = 0.0; n < count; n += 1.0) {
            double f0 = p[FORCE + i] + rate[i] * n * h, f1 = f0 + rate[i] * 0.5 * h;
            double f2 = f0 + rate[i] * h;
            double a1 = acceleration(p, i, f0, x, v), v2 = v + 0.5 * h * a1;
            double a2 = acceleration(p, i, f1, x + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
            double a3 = acceleration(p, i, f1, x + 0.5 * h * v2, v3), v4 = v + h * a3;
            double a4 = acceleration(p, i, f2, x + h * v3, v4);
            x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
            v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        }
        p[X + i] = x;
        p[V + i] = v;
    }
}

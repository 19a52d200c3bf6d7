/* The rotor of examples/system_of_fmus.py: an overhung mass on its elastic shaft, as an FMI 2.0 co-simulation unit.

       m z'' + c z' + k z = F(t) + W        in x and in y

   The shaft, clamped on its other side, holds the mass by its bending stiffness k and damps with c; W is a load, F what
   a bearing does to it. F stands still over a step, or goes on evenly as fmi2SetRealInputDerivatives says for it.
   Runge and Kutta's steps of fourth order, 200 in 1/sqrt(k/m) or m/c, leave some 1e-12 of the motion. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

/* Value references, in the order of rotor.xml. */
enum { FORCE, X = 2, V = 4, A = 6, MASS = 8, STIFFNESS, DAMPING, LOAD, START = LOAD + 2, COUNT = START + 2 };

typedef struct {
    double value[COUNT];
    double rate[2]; /* of the force, for the next step [N/s] */
    int initialized;
} Rotor;

static const Rotor FRESH = {.value = {[MASS] = 3.0, [STIFFNESS] = 1e7}};

/* Acceleration along axis i, at this force. */
static double acceleration(const Rotor *rotor, int i, double force, double x, double v) {
    const double *p = rotor->value;
    return (force + p[LOAD + i] - p[DAMPING] * v - p[STIFFNESS] * x) / p[MASS];
}

static void show(Rotor *rotor) {
    double *p = rotor->value;
    for (int i = 0; i < 2; i++) {
        p[A + i] = acceleration(rotor, i, p[FORCE + i], p[X + i], p[V + i]);
    }
}

static void step(Rotor *rotor, double length) {
    double *p = rotor->value;
    double fastest = fmax(sqrt(p[STIFFNESS] / p[MASS]), p[DAMPING] / p[MASS]);
    double count = fmax(1.0, ceil(200.0 * fastest * length));
    double h = length / count;
    for (int i = 0; i < 2; i++) {
        double x = p[X + i], v = p[V + i];
        for (double n = 0.0; n < count; n += 1.0) {
            double f0 = p[FORCE + i] + rotor->rate[i] * n * h, f1 = f0 + rotor->rate[i] * 0.5 * h;
            double f2 = f0 + rotor->rate[i] * h;
            double a1 = acceleration(rotor, i, f0, x, v), v2 = v + 0.5 * h * a1;
            double a2 = acceleration(rotor, i, f1, x + 0.5 * h * v, v2), v3 = v + 0.5 * h * a2;
            double a3 = acceleration(rotor, i, f1, x + 0.5 * h * v2, v3), v4 = v + h * a3;
            double a4 = acceleration(rotor, i, f2, x + h * v3, v4);
            x += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
            v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        }
        p[X + i] = x;
        p[V + i] = v;
        p[FORCE + i] += rotor->rate[i] * length;
        rotor->rate[i] = 0.0;
    }
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]) {
    return fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging) {
    if (type != fmi2CoSimulation || !guid || strcmp(guid, ROTOR_GUID)) {
        return NULL;
    }
    Rotor *rotor = malloc(sizeof *rotor);
    if (rotor) {
        *rotor = FRESH;
    }
    return rotor;
}

void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean given, fmi2Real tolerance, fmi2Real start, fmi2Boolean ends,
                               fmi2Real stop) {
    return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    ((Rotor *)c)->initialized = 1;
    return fmi2OK;
}
fmi2Status fmi2Terminate(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) {
    *(Rotor *)c = FRESH;
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[]) {
    Rotor *rotor = c;
    show(rotor);
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= COUNT) {
            return fmi2Error;
        }
        value[i] = rotor->value[vr[i]];
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[]) {
    Rotor *rotor = c;
    for (size_t i = 0; i < n; i++) {
        int input = vr[i] < X, parameter = vr[i] >= MASS && vr[i] < COUNT && !rotor->initialized;
        int possible = isfinite(value[i]) && (vr[i] != MASS || value[i] > 0.0) &&
                       ((vr[i] != STIFFNESS && vr[i] != DAMPING) || value[i] >= 0.0);
        if (!(input || parameter) || !possible) {
            return fmi2Error;
        }
        rotor->value[vr[i]] = value[i];
        if (vr[i] >= START) {
            rotor->value[X + vr[i] - START] = value[i];
        }
    }
    return fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= X || order[i] != 1) {
            return fmi2Error;
        }
        ((Rotor *)c)->rate[vr[i]] = value[i];
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real length, fmi2Boolean done) {
    Rotor *rotor = c;
    if (!rotor->initialized || !(length > 0.0) || !isfinite(length)) {
        return fmi2Error;
    }
    step(rotor, length);
    return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    if (!*state && !(*state = malloc(sizeof(Rotor)))) {
        return fmi2Error;
    }
    memcpy(*state, c, sizeof(Rotor));
    return fmi2OK;
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    memcpy(c, state, sizeof(Rotor));
    return fmi2OK;
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    free(*state);
    *state = NULL;
    return fmi2OK;
}

/* What this unit has none of. */
#define NONE(...) (__VA_ARGS__) { return n ? fmi2Error : fmi2OK; }
#define REFERENCES fmi2Component c, const fmi2ValueReference vr[], size_t n
fmi2Status fmi2GetInteger NONE(REFERENCES, fmi2Integer value[])
fmi2Status fmi2GetBoolean NONE(REFERENCES, fmi2Boolean value[])
fmi2Status fmi2GetString NONE(REFERENCES, fmi2String value[])
fmi2Status fmi2SetInteger NONE(REFERENCES, const fmi2Integer value[])
fmi2Status fmi2SetBoolean NONE(REFERENCES, const fmi2Boolean value[])
fmi2Status fmi2SetString NONE(REFERENCES, const fmi2String value[])
fmi2Status fmi2GetRealOutputDerivatives NONE(REFERENCES, const fmi2Integer order[], fmi2Real value[])
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference of[], size_t m,
                                        const fmi2ValueReference by[], size_t n, const fmi2Real seed[],
                                        fmi2Real value[]) {
    return fmi2Error;
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size) { return fmi2Error; }
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t n) { return fmi2Error; }
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t n, fmi2FMUstate *state) {
    return fmi2Error;
}
fmi2Status fmi2CancelStep(fmi2Component c) { return fmi2Error; }
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value) { return fmi2Discard; }
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value) { return fmi2Discard; }
fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value) { return fmi2Discard; }
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value) { return fmi2Discard; }
fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value) { return fmi2Discard; }

/* What the units of the examples share: an FMI 2.0 co-simulation unit of real numbers.

   Value references are the places in `value`: inputs first, then outputs, then parameters. A unit includes this behind
   its constants INPUTS, PARAMETERS (where those begin), COUNT and its functions fresh, is_possible, start, show and
   step. Inputs stand still over a step, or go on evenly as fmi2SetRealInputDerivatives says for it. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

typedef struct {
    double value[COUNT];
    double rate[INPUTS]; /* of the inputs, for the next step */
    int initialized;
} Unit;

static void fresh(double value[COUNT]);                          /* what parameters are at first */
static int is_possible(unsigned reference, double value);        /* of a parameter */
static void start(double value[COUNT]);                          /* outputs of the start, by the parameters */
static void show(double value[COUNT]);                           /* outputs that follow from the others */
static void step(double value[COUNT], const double rate[INPUTS], double length);

static void renew(Unit *unit) {
    memset(unit, 0, sizeof *unit);
    fresh(unit->value);
#ifdef UNIT_START
    /* Start values of this FMU's own model description, by reference. */
    static const struct { int reference; double value; } given[] = {UNIT_START};
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) {
        unit->value[given[i].reference] = given[i].value;
    }
#endif
    start(unit->value);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String categories[]) {
    return fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible, fmi2Boolean logging) {
    if (type != fmi2CoSimulation || !guid || strcmp(guid, UNIT_GUID)) {
        return NULL;
    }
    Unit *unit = malloc(sizeof *unit);
    if (unit) {
        renew(unit);
    }
    return unit;
}

void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean given, fmi2Real tolerance, fmi2Real from, fmi2Boolean ends,
                               fmi2Real stop) {
    return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    ((Unit *)c)->initialized = 1;
    return fmi2OK;
}
fmi2Status fmi2Terminate(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) {
    renew(c);
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, fmi2Real value[]) {
    Unit *unit = c;
    show(unit->value);
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= COUNT) {
            return fmi2Error;
        }
        value[i] = unit->value[vr[i]];
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2Real value[]) {
    Unit *unit = c;
    for (size_t i = 0; i < n; i++) {
        int input = vr[i] < INPUTS, parameter = vr[i] >= PARAMETERS && vr[i] < COUNT && !unit->initialized;
        if (!(input || parameter) || !isfinite(value[i]) || (parameter && !is_possible(vr[i], value[i]))) {
            return fmi2Error;
        }
        unit->value[vr[i]] = value[i];
        if (parameter) {
            start(unit->value);
        }
    }
    return fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t n,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= INPUTS || order[i] != 1) {
            return fmi2Error;
        }
        ((Unit *)c)->rate[vr[i]] = value[i];
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real length, fmi2Boolean done) {
    Unit *unit = c;
    if (!unit->initialized || !(length > 0.0) || !isfinite(length)) {
        return fmi2Error;
    }
    step(unit->value, unit->rate, length);
    for (int i = 0; i < INPUTS; i++) {
        unit->value[i] += unit->rate[i] * length;
        unit->rate[i] = 0.0;
    }
    return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    if (!*state && !(*state = malloc(sizeof(Unit)))) {
        return fmi2Error;
    }
    memcpy(*state, c, sizeof(Unit));
    return fmi2OK;
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    memcpy(c, state, sizeof(Unit));
    return fmi2OK;
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    free(*state);
    *state = NULL;
    return fmi2OK;
}

/* What such a unit has none of. */
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

/* Steps plant and wear unit of FMI 3.0 together, their arrays connected whole, without Python:
 *     unzip -d plant dist/fmi3/RvPlant.fmu && unzip -d wear dist/fmi3/RvWear.fmu
 *     cc -std=c99 -I FMI_HEADERS examples/pair_master.c -o pair_master -ldl && ./pair_master plant wear
 * prints flank and raceway depths of each disc as "rvwear run" finds them.  The headers are those of the FMI 3.0 standard; fmpy
 * brings them in its folder c-code.  Options after the folders: scheme (gauss-seidel or jacobi), step [s], steps, acceleration. */
#include "fmi3FunctionTypes.h"
#include <ctype.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FUNCTIONS(X) \
    X(InstantiateCoSimulation) X(EnterInitializationMode) X(ExitInitializationMode) X(GetFloat64) X(SetFloat64) X(DoStep) \
    X(Terminate) X(FreeInstance)
#ifdef __aarch64__
#define PLATFORM "aarch64-linux"
#else
#define PLATFORM "x86_64-linux"
#endif

struct unit {
    const char *name;
    char *text; /* modelDescription.xml */
    void *library;
    fmi3Instance instance;
#define DECLARE(f) fmi3##f##TYPE *f;
    FUNCTIONS(DECLARE)
};

struct connection {
    struct unit *from, *to;
    fmi3ValueReference output, input;
    size_t count;
    fmi3Float64 *values;
};

static const char *TO_WEAR[][2] = {
    {"crank.angle", "crank.angle"}, {"crank.speed", "crank.speed"}, {"output.angle", "output.angle"}, {"cage.angle", "cage.angle"},
    {"crank.path", "crank.path"}, {"mesh.force_path", "mesh.force_path"}, {"roller.force_path", "roller.force_path"},
    {"heat.contact_temperature", "heat.contact_temperature"},
};
static const char *TO_PLANT[] = {
    "profile.angle", "mesh.profile_error", "roller.profile_error", "mesh.profile_slope", "roller.profile_slope",
};
#define COUNT(array) (sizeof array / sizeof *array)

static void stop(const struct unit *u, const char *what, const char *detail)
{
    fprintf(stderr, "pair_master: %s: %s%s\n", u->name, what, detail);
    exit(1);
}

static void check(const struct unit *u, const char *function, fmi3Status status)
{
    if (status > fmi3Warning)
        stop(u, function, " was refused; the unit's message stands above");
}

static void say(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)status;
    fprintf(stderr, "%s: %s: %s\n", ((const struct unit *)environment)->name, category, message);
}

static char *contents(const struct unit *u, const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END))
        stop(u, "cannot read ", path);
    long size = ftell(file);
    char *text = calloc((size_t)size + 1, 1);
    rewind(file);
    if (!text || fread(text, 1, (size_t)size, file) != (size_t)size)
        stop(u, "cannot read ", path);
    fclose(file);
    return text;
}

/* The value of an attribute of the XML element that begins at "element". */
static const char *attribute(const struct unit *u, const char *element, const char *name)
{
    size_t length = strlen(name);
    for (const char *place = element, *end = strchr(element, '>'); place && place < end; place++)
        if (isspace((unsigned char)place[-1]) && !strncmp(place, name, length) && !strncmp(place + length, "=\"", 2))
            return place + length + 2;
    stop(u, "modelDescription.xml lacks the attribute ", name);
    return NULL;
}

/* Value reference and number of elements of a variable. */
static fmi3ValueReference find(const struct unit *u, const char *name, size_t *count)
{
    char wanted[256];
    snprintf(wanted, sizeof wanted, " name=\"%s\"", name);
    const char *place = strstr(u->text, "<ModelVariables");
    if (!place || !(place = strstr(place, wanted)))
        stop(u, "has no variable ", name);
    while (*place != '<')
        place--;
    *count = 1;
    const char *end = strchr(place, '>');
    if (end[-1] != '/')
        for (const char *d = end + 1; d += strspn(d, " \r\n\t"), !strncmp(d, "<Dimension", 10); d = strchr(d, '>') + 1)
            *count *= strtoul(attribute(u, d, "start"), NULL, 10);
    return (fmi3ValueReference)strtoul(attribute(u, place, "valueReference"), NULL, 10);
}

static void load(struct unit *u, const char *name, const char *folder, const char *model)
{
    char path[4096], token[128] = "";
    u->name = name;
    snprintf(path, sizeof path, "%s/modelDescription.xml", folder);
    u->text = contents(u, path);
    const char *found = attribute(u, strstr(u->text, "<fmiModelDescription"), "instantiationToken");
    memcpy(token, found, strcspn(found, "\"") < sizeof token ? strcspn(found, "\"") : 0);
    snprintf(path, sizeof path, "%s%s/binaries/" PLATFORM "/%s.so", strchr(folder, '/') ? "" : "./", folder, model);
    u->library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!u->library)
        stop(u, "cannot load its library: ", dlerror());
#define RESOLVE(f) \
    if (!(*(void **)&u->f = dlsym(u->library, "fmi3" #f))) \
        stop(u, "its library lacks ", "fmi3" #f);
    FUNCTIONS(RESOLVE)
    u->instance = u->InstantiateCoSimulation(name, token, NULL, fmi3False, fmi3True, fmi3False, fmi3False, NULL, 0, u, say, NULL);
    if (!u->instance)
        stop(u, "fmi3InstantiateCoSimulation", " was refused; the unit's message stands above");
}

static struct connection connected(struct unit *from, const char *output, struct unit *to, const char *input)
{
    struct connection c = {from, to, 0, 0, 0, NULL};
    size_t taken;
    c.output = find(from, output, &c.count);
    c.input = find(to, input, &taken);
    if (taken != c.count)
        stop(to, "takes another number of values than it is given in ", input);
    c.values = calloc(c.count, sizeof *c.values);
    if (!c.values)
        stop(to, "out of memory for ", input);
    return c;
}

static void read_outputs(struct connection *connections, size_t count)
{
    for (struct connection *c = connections; c < connections + count; c++)
        check(c->from, "fmi3GetFloat64", c->from->GetFloat64(c->from->instance, &c->output, 1, c->values, c->count));
}

static void write_inputs(struct connection *connections, size_t count)
{
    for (struct connection *c = connections; c < connections + count; c++)
        check(c->to, "fmi3SetFloat64", c->to->SetFloat64(c->to->instance, &c->input, 1, c->values, c->count));
}

static void step(struct unit *u, double time, double duration)
{
    fmi3Boolean event, ended, early;
    fmi3Float64 reached;
    check(u, "fmi3DoStep", u->DoStep(u->instance, time, duration, fmi3True, &event, &ended, &early, &reached));
}

static void print(const struct unit *u, const char *name)
{
    size_t count;
    fmi3ValueReference reference = find(u, name, &count);
    fmi3Float64 *values = calloc(count, sizeof *values);
    if (!values)
        stop(u, "out of memory for ", name);
    check(u, "fmi3GetFloat64", u->GetFloat64(u->instance, &reference, 1, values, count));
    for (size_t i = 0; i < count; i++)
        printf("%s.%s[%lu] = %.17g m\n", u->name, name, (unsigned long)i + 1, values[i]);
    free(values);
}

static double number(const char *text, const char *what, const char *remedy)
{
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end || !(value > 0.0 && value < 1e300)) {
        fprintf(stderr, "pair_master: %s = %s: %s\n", what, text, remedy);
        exit(2);
    }
    return value;
}

int main(int count, char **arguments)
{
    if (count < 3 || count > 7)
        return fprintf(stderr, "pair_master PLANT WEAR [gauss-seidel|jacobi [STEP [STEPS [ACCELERATION]]]]\n"), 2;
    const char *scheme = count > 3 ? arguments[3] : "gauss-seidel";
    int jacobi = !strcmp(scheme, "jacobi");
    if (!jacobi && strcmp(scheme, "gauss-seidel"))
        return fprintf(stderr, "pair_master: scheme = %s: give gauss-seidel or jacobi\n", scheme), 2;

    struct unit plant, wear;
    load(&plant, "plant", arguments[1], "RvPlant");
    load(&wear, "wear", arguments[2], "RvWear");
    const char *suggested = attribute(&plant, strstr(plant.text, "<DefaultExperiment"), "stepSize");
    double duration = count > 4 ? number(arguments[4], "step", "a positive time in s is needed") : strtod(suggested, NULL);
    double wanted = count > 5 ? number(arguments[5], "steps", "a positive whole number is needed") : 72.0;
    double acceleration = count > 6 ? number(arguments[6], "acceleration", "a positive number (1: as time passes) is needed") : 1.0;

    struct connection forward[COUNT(TO_WEAR)], back[COUNT(TO_PLANT)];
    for (size_t i = 0; i < COUNT(TO_WEAR); i++)
        forward[i] = connected(&plant, TO_WEAR[i][0], &wear, TO_WEAR[i][1]);
    for (size_t i = 0; i < COUNT(TO_PLANT); i++)
        back[i] = connected(&wear, TO_PLANT[i], &plant, TO_PLANT[i]);
    size_t one;
    fmi3ValueReference counts = find(&wear, "acceleration", &one);
    check(&wear, "fmi3SetFloat64", wear.SetFloat64(wear.instance, &counts, 1, &acceleration, 1));

    check(&plant, "fmi3EnterInitializationMode", plant.EnterInitializationMode(plant.instance, fmi3False, 0.0, 0.0, fmi3False, 0.0));
    check(&wear, "fmi3EnterInitializationMode", wear.EnterInitializationMode(wear.instance, fmi3False, 0.0, 0.0, fmi3False, 0.0));
    /* What the wear unit begins with depends on nothing, so the plant's start may depend on it. */
    read_outputs(back, COUNT(back));
    write_inputs(back, COUNT(back));
    read_outputs(forward, COUNT(forward));
    write_inputs(forward, COUNT(forward));
    check(&plant, "fmi3ExitInitializationMode", plant.ExitInitializationMode(plant.instance));
    check(&wear, "fmi3ExitInitializationMode", wear.ExitInitializationMode(wear.instance));

    for (long n = 0; n < (long)wanted; n++) {
        double time = (double)n * duration;
        read_outputs(back, COUNT(back));
        write_inputs(back, COUNT(back));
        if (jacobi) {
            read_outputs(forward, COUNT(forward));
            write_inputs(forward, COUNT(forward));
        }
        step(&plant, time, duration);
        if (!jacobi) {
            read_outputs(forward, COUNT(forward));
            write_inputs(forward, COUNT(forward));
        }
        step(&wear, time, duration);
    }
    print(&wear, "flank.depth");
    print(&wear, "inner_race.depth");
    print(&wear, "outer_race.depth");

    for (size_t i = 0; i < COUNT(forward); i++)
        free(forward[i].values);
    for (size_t i = 0; i < COUNT(back); i++)
        free(back[i].values);
    struct unit *units[] = {&plant, &wear};
    for (size_t i = 0; i < COUNT(units); i++) {
        check(units[i], "fmi3Terminate", units[i]->Terminate(units[i]->instance));
        units[i]->FreeInstance(units[i]->instance);
        dlclose(units[i]->library);
        free(units[i]->text);
    }
    return 0;
}

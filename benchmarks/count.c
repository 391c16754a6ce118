/* Runs one unit's object code so that its instructions can be counted: record file, steps, duration, cell. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

int64_t initialise(void *cells);
int64_t step(void *cells, double time, double duration);

/* Sums the integer in one cell over the steps: iterations, or assemblies. */
int main(int argc, char **argv)
{
    if (argc != 5) return 2;
    FILE *file = fopen(argv[1], "rb");
    if (!file || fseek(file, 0, SEEK_END)) return 2;
    long size = ftell(file);
    void *cells = malloc((size_t)size);
    rewind(file);
    if (!cells || fread(cells, 1, (size_t)size, file) != (size_t)size) return 2;
    long steps = atol(argv[2]), cell = atol(argv[4]);
    double duration = atof(argv[3]);
    int64_t status = initialise(cells), sum = 0;
    for (long i = 0; i < steps && status == 0; i++) {
        status = step(cells, (double)i * duration, duration);
        sum += ((int64_t *)cells)[cell];
    }
    printf("%lld %lld\n", (long long)status, (long long)sum);
    return status != 0;
}

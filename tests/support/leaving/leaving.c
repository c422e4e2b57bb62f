/* SPDX-FileCopyrightText: 2026 The Hapnet authors */
/* SPDX-License-Identifier: MIT */
/* An algorithm that does what none may do: it ends the program in a tick, a second after the first
 * one, by exit(0) or, with the parameters "quick", by quick_exit(0). Each process that loads it adds
 * a line to the file that HAPNET_LOADED names. */
#include <hapnet/algorithm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct leaving {
    int is_quick;
    int ticks;
};

__attribute__((constructor)) static void tell(void)
{
    const char* name = getenv("HAPNET_LOADED");
    FILE* file = name != NULL ? fopen(name, "a") : NULL;
    if (file == NULL) return;
    fputs("loaded\n", file);
    fclose(file);
}

static const char* begin(void* state, const char* parameters)
{
    struct leaving* own = state;
    own->is_quick = strcmp(parameters, "quick") == 0;
    return NULL;
}

static void tick(void* state, const struct hapnet_world* world,
                 const struct hapnet_situation* situation, struct hapnet_outcome* outcome)
{
    struct leaving* own = state;
    (void)situation;
    (void)outcome;
    world->tick(world->handle);
    if (++own->ticks < 1000) return;
    if (own->is_quick) quick_exit(0);
    exit(0);
}

const struct hapnet_algorithm* hapnet_describe(void)
{
    static const struct hapnet_algorithm leaving = {
        .abi = HAPNET_ALGORITHM_ABI,
        .state_bytes = sizeof(struct leaving),
        .plays_with_many = 0,
        .name = "leaving",
        .begin = begin,
        .tick = tick,
    };
    return &leaving;
}

/* SPDX-FileCopyrightText: 2026 The Hapnet authors */
/* SPDX-License-Identifier: MIT */
/*
 * The paper's algorithm as a shared object: the same forces and places, bit for bit, as the `base`
 * of the programs with its default parameters. To start from for an algorithm of your own:
 *
 *   cc -std=c11 -O2 -ffp-contract=off -shared -fPIC -o base.so base.c
 *   hapnet-peer --algorithm ./base.so ...
 *
 * Without -ffp-contract=off a compiler may fuse products and sums, and the last bits differ.
 */
#include <hapnet/algorithm.h>
#include <math.h>
#include <stddef.h>

#define MILLISECOND INT64_C(1000000)

static const int64_t settle_after_ns = 200 * MILLISECOND;
static const int64_t settle_within_ns = 100 * MILLISECOND;

/* The memory: all zero at first. */
struct memory {
    int64_t untouched_since_ns;
    int64_t blend_start_ns;
    struct hapnet_vector blend_from;
    int is_untouched;
    int is_blending;
};

/* The others as if they were one. */
struct presence {
    struct hapnet_vector force;
    struct hapnet_body body;
    int touching;
    int has_body;
};

static struct hapnet_vector sum(struct hapnet_vector a, struct hapnet_vector b)
{
    return (struct hapnet_vector){a.x + b.x, a.y + b.y, a.z + b.z};
}

static struct hapnet_vector difference(struct hapnet_vector a, struct hapnet_vector b)
{
    return (struct hapnet_vector){a.x - b.x, a.y - b.y, a.z - b.z};
}

static struct hapnet_vector scaled(double s, struct hapnet_vector v)
{
    return (struct hapnet_vector){s * v.x, s * v.y, s * v.z};
}

static struct hapnet_vector limited(struct hapnet_vector v, double most)
{
    const double length = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return length > most ? scaled(most / length, v) : v;
}

/* Forces add up, each faded by its age and no stronger than a contact of the scene. */
static void add_force(struct presence* all, const struct hapnet_other* other, double force_max_n)
{
    if (!(other->freshness > 0.0) || !other->heard || !other->state.touching) return;
    const struct hapnet_vector force =
        scaled(other->freshness, limited(other->state.contact_force, force_max_n));
    all->force = all->touching ? sum(all->force, force) : force;
    all->touching = 1;
}

/* Several touch the body: it is where they have it on average. */
static int mean_body(const struct hapnet_situation* now, struct hapnet_body* body)
{
    double count = 0.0;
    struct hapnet_body all = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    for (uint32_t i = 0; i < now->others_count; ++i) {
        const struct hapnet_other* other = &now->others[i];
        if (!(other->freshness > 0.0) || !other->heard) continue;
        if (!other->state.touching || !other->state.has_body) continue;
        all.position = sum(all.position, other->state.body.position);
        all.velocity = sum(all.velocity, other->state.body.velocity);
        count += 1.0;
    }
    if (!(count > 0.0)) return 0;
    const struct hapnet_vector p = all.position, v = all.velocity;
    body->position = (struct hapnet_vector){p.x / count, p.y / count, p.z / count};
    body->velocity = (struct hapnet_vector){v.x / count, v.y / count, v.z / count};
    return 1;
}

static struct presence presence_of(const struct hapnet_situation* now)
{
    struct presence all = {{0.0, 0.0, 0.0}, {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, 0, 0};
    for (uint32_t i = 0; i < now->others_count; ++i) {
        add_force(&all, &now->others[i], now->force_max_n);
    }
    if (now->others_count > 1 && all.touching && mean_body(now, &all.body)) {
        all.has_body = 1;
        return all;
    }
    const struct hapnet_state* leader = &now->others[now->leader].state;
    all.has_body = leader->has_body;
    all.body = leader->body;
    return all;
}

/* No hand touches: some time later this copy goes to where the leader has the body. */
static void settle(struct memory* memory, const struct hapnet_world* world,
                   const struct hapnet_situation* now, const struct presence* remote)
{
    if (!memory->is_untouched) {
        memory->is_untouched = 1;
        memory->untouched_since_ns = now->now_ns;
    }
    const int waited = now->now_ns - memory->untouched_since_ns >= settle_after_ns;
    const double freshness = now->others[now->leader].freshness;
    if (!now->yields || !waited || !remote->has_body || freshness <= 0.0) {
        memory->is_blending = 0;
        return;
    }
    if (!memory->is_blending) {
        struct hapnet_body body;
        world->body(world->handle, &body);
        memory->is_blending = 1;
        memory->blend_start_ns = now->now_ns;
        memory->blend_from = body.position;
    }
    const int64_t since_ns = now->now_ns - memory->blend_start_ns;
    const double share = since_ns < settle_within_ns
                             ? ((double)since_ns / 1e9) / ((double)settle_within_ns / 1e9)
                             : 1.0;
    const struct hapnet_vector way = difference(remote->body.position, memory->blend_from);
    const struct hapnet_body there = {sum(memory->blend_from, scaled(share, way)),
                                      remote->body.velocity};
    world->place(world->handle, &there);
}

static void tick(void* state, const struct hapnet_world* world, const struct hapnet_situation* now,
                 struct hapnet_outcome* outcome)
{
    struct memory* memory = state;
    const struct presence remote = presence_of(now);
    outcome->remote_touching = remote.touching ? 1 : 0;
    if (remote.touching) {
        world->push(world->handle, &remote.force);
        outcome->remote_force = remote.force;
    }
    world->tick(world->handle);
    struct hapnet_touch own;
    world->touch(world->handle, &own);
    const struct hapnet_other* leader = &now->others[now->leader];
    outcome->has_remote_hip = leader->heard;
    outcome->remote_hip = leader->state.hip;

    if (own.touching || remote.touching) memory->is_untouched = memory->is_blending = 0;
    if (own.touching) return; /* this copy's own dynamics hold */
    if (remote.touching && remote.has_body) {
        world->place(world->handle, &remote.body);
    } else {
        settle(memory, world, now, &remote);
    }
}

const struct hapnet_algorithm* hapnet_describe(void)
{
    static const struct hapnet_algorithm base = {
        .abi = HAPNET_ALGORITHM_ABI,
        .state_bytes = sizeof(struct memory),
        .plays_with_many = 1,
        .name = "base, in C",
        .tick = tick,
    };
    return &base;
}

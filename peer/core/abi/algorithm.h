/* SPDX-FileCopyrightText: 2026 The Hapnet authors */
/* SPDX-License-Identifier: MIT */
/**
 * A collaboration algorithm of your own as a shared object, in C or in any language that can export
 * a C function: `hapnet-peer --algorithm ./FILE.so`. docs/use/libraries.md walks through one.
 *
 * The object exports hapnet_describe(), which describes the algorithm. Of each of its functions
 * the first argument is the algorithm's memory: `state_bytes` zeroed bytes, aligned for any type,
 * which the program allocates, copies as bytes, and frees. So the memory holds no pointer into
 * itself or to memory of the algorithm's own. The functions return, do no I/O, read no clock, take
 * no memory and keep no globals: the program calls them from its haptic loop, in virtual time from
 * several threads, each with a memory of its own, and plays a record again by them.
 *
 * Units: metres, m/s, newtons, nanoseconds (of the program's own clock, whose zero means nothing).
 * Axes: x right, y up, z toward the user. Truth values are 0 or 1.
 *
 * Structs grow at their end only, and only in what the program fills in; whatever else changes
 * raises HAPNET_ALGORITHM_ABI, and the program refuses another than its own.
 */
#ifndef HAPNET_ALGORITHM_H
#define HAPNET_ALGORITHM_H

#include <stdint.h> /* NOLINT(modernize-deprecated-headers): this is C */

#ifdef __cplusplus
extern "C" {
#endif

/** What the program and the shared object must agree on. */
#define HAPNET_ALGORITHM_ABI 1
/** The most memory that an algorithm may ask for, in bytes. */
#define HAPNET_STATE_BYTES_MAX (1U << 20)
/** The most peers besides this one. */
#define HAPNET_OTHERS_MAX 7

struct hapnet_vector {
    double x, y, z;
};

/** The shared body: its centre, and how fast that moves. */
struct hapnet_body {
    struct hapnet_vector position;
    struct hapnet_vector velocity;
};

/** What one state message of another peer says. */
struct hapnet_state {
    int64_t sent_ns;    /* on the sender's clock */
    int64_t arrived_ns; /* on this peer's clock, the kernel's stamp */
    struct hapnet_vector hip;
    struct hapnet_vector hip_velocity;
    struct hapnet_vector contact_force;      /* of the sender's hand on the body */
    struct hapnet_vector intention;          /* of its hand: where it wants to be, from the HIP */
    struct hapnet_vector intention_velocity; /* and how fast that moves */
    struct hapnet_body body;                 /* where the sender has it; see has_body */
    uint32_t sequence;                       /* 1, 2, 3, ... within the session */
    uint8_t touching;                        /* its hand touches the body */
    uint8_t holding;                         /* its hand holds the body */
    uint8_t has_body; /* for hear(): this message; for tick(): any message so far */
    uint8_t reserved;
};

/** A clock of another peer as it is known so far: its time minus this peer's. */
struct hapnet_clock {
    int64_t offset_ns;
    int64_t uncertainty_ns;
    uint8_t known; /* 0: the numbers mean nothing */
    uint8_t reserved[7];
};

/** A state at its arrival. */
struct hapnet_received {
    struct hapnet_state state;
    struct hapnet_clock clock; /* of its sender */
    int64_t tick_ns;
    double force_max_n; /* that a contact of the scene can exert */
    uint32_t from;      /* index of its sender among the others */
    uint8_t taken;      /* 0: older than one that was taken, or a duplicate */
    uint8_t reserved[3];
};

/** Another peer in a tick, by the newest state that was taken. */
struct hapnet_other {
    struct hapnet_state state; /* has no meaning without `heard` */
    double freshness;          /* 1: heard lately, falling to 0: silent for too long */
    uint32_t id;
    uint8_t heard; /* there was a state */
    uint8_t reserved[3];
};

/** What holds in one tick. */
struct hapnet_situation {
    int64_t now_ns;
    int64_t tick_ns;
    const struct hapnet_other* others; /* in the order of their ids */
    struct hapnet_clock clock;         /* of others[leader] */
    double force_max_n;                /* that a contact of the scene can exert */
    uint32_t others_count;             /* 1 to HAPNET_OTHERS_MAX */
    uint32_t leader;                   /* index of the lowest id of those that are heard */
    uint8_t yields;                    /* the leader's id is lower than this peer's */
    uint8_t reserved[7];
};

/** What this peer's hand did in the tick that tick() has made. */
struct hapnet_touch {
    struct hapnet_vector on_body; /* force of the hand, mean over the tick */
    struct hapnet_vector on_hand; /* force on the hand by all that it touches, likewise */
    double depth_m;               /* of the deepest contact at the start of the tick */
    uint8_t touching;
    uint8_t holding;
    uint8_t reserved[6];
};

/**
 * This peer's copy of the scene, for the length of one call. Call tick() exactly once: another is
 * ignored, and one that is missing is made up for after the algorithm's function has returned. What
 * is not finite, or out of the scene's reach, is refused, and changes nothing.
 */
struct hapnet_world {
    void* handle; /* the first argument of all functions here */
    /** Where the shared body is. */
    void (*body)(void* handle, struct hapnet_body* body);
    /** A force on the body's centre during the tick; before tick(). Pushes add up. */
    void (*push)(void* handle, const struct hapnet_vector* force);
    /** Moves the scene on by one tick, with this peer's hand in it. */
    void (*tick)(void* handle);
    /** What the hand did; after tick(). */
    void (*touch)(void* handle, struct hapnet_touch* touch);
    /** Puts the body somewhere. */
    void (*place)(void* handle, const struct hapnet_body* body);
};

/** The result of one tick, all zero before the call but on_hand: hapnet_touch.on_hand is put there
 * where the algorithm does not set `has_on_hand`. */
struct hapnet_outcome {
    struct hapnet_vector on_hand;      /* what the hand is to feel, before the governor */
    struct hapnet_vector remote_force; /* that counted as the others', for the record */
    struct hapnet_vector remote_hip;   /* of a hand of theirs, to be shown */
    uint8_t has_on_hand;
    uint8_t remote_touching; /* a hand of theirs counted as on the body, for the record */
    uint8_t has_remote_hip;
    uint8_t reserved[5];
};

/** An algorithm. Everything it points to lives as long as the shared object is loaded. */
struct hapnet_algorithm {
    uint32_t abi;             /* HAPNET_ALGORITHM_ABI */
    uint32_t state_bytes;     /* of memory, 0 to HAPNET_STATE_BYTES_MAX */
    uint32_t plays_with_many; /* 0: with one other alone; 1: with up to HAPNET_OTHERS_MAX */
    uint32_t reserved;
    const char* name; /* for people */
    /**
     * Reads the text that the user gave as `parameters`, "" without one, into zeroed memory.
     * Returns NULL, or what is wrong with them. May be NULL: then parameters are refused.
     */
    const char* (*begin)(void* state, const char* parameters);
    /** A state arrived. Called for each at once, also for those that came late. May be NULL. */
    void (*hear)(void* state, const struct hapnet_received* received);
    /** Moves the world by one tick. */
    void (*tick)(void* state, const struct hapnet_world* world,
                 const struct hapnet_situation* situation, struct hapnet_outcome* outcome);
    /** The run of others[other] has ended; its next state is of another run. May be NULL. */
    void (*forget)(void* state, uint32_t other);
};

/** What the shared object exports. The same at every call, never NULL. */
const struct hapnet_algorithm* hapnet_describe(void);

#ifdef __cplusplus
}
#endif

#endif

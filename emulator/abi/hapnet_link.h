/* SPDX-FileCopyrightText: 2026 The Hapnet authors */
/* SPDX-License-Identifier: MIT */
/**
 * A bad network inside your own program: both ways of an emulated path, as hapnet-emulator has it,
 * in C or in any language that can call C. docs/use/libraries.md walks through an example.
 *
 * A link has no thread, no socket and no clock. Hand it each packet with hapnet_link_push(), take
 * those that are due with hapnet_link_pop(), and look again at hapnet_link_next_deadline(). Equal
 * profiles, seeds, packets and times give equal fates, bit by bit, here and in the daemon, but for
 * packets during a ramp: there the daemon's conditions depend on when it woke up within 1 ms.
 *
 * Times are nanoseconds since the link began, on whatever clock you keep; 0 is time 0 of the
 * profile. A time before that of the call before counts as that one. A link is for one thread at a
 * time; different links know nothing of each other. All memory for packets is taken at the start.
 *
 * The library's number (libhapnet-link.so.0) changes when a program has to be built again.
 */
#ifndef HAPNET_LINK_H
#define HAPNET_LINK_H

#include <stddef.h> /* NOLINT(modernize-deprecated-headers): this is C */
#include <stdint.h> /* NOLINT(modernize-deprecated-headers) */

#ifdef __cplusplus
extern "C" {
#endif

#define HAPNET_LINK_API __attribute__((visibility("default")))

/** Directions: from A to B (or client to server), and from B to A. */
#define HAPNET_LINK_UP 0
#define HAPNET_LINK_DOWN 1
/** No deadline: nothing is in flight. */
#define HAPNET_LINK_NEVER INT64_MAX
/** The largest packet, in bytes: the payload of a UDP datagram over IPv4. */
#define HAPNET_LINK_PACKET_MAX 65507

struct hapnet_link;

/** What hapnet_link_pop() says of a packet. */
struct hapnet_link_packet {
    uint64_t number;    /* in its direction, from 0; a copy has its original's */
    int64_t arrived_ns; /* when it was pushed */
    int64_t due_ns;     /* when it was to leave: never before */
    size_t size;        /* in bytes */
    int direction;      /* HAPNET_LINK_UP or HAPNET_LINK_DOWN */
    int is_copy;        /* 1: a duplicate */
};

/**
 * A new link with the conditions of `profile`: a profile as text (docs/formats/profile.md), or the
 * name of a preset ("lte"). `seed` decides all that is random. NULL when it is refused: then
 * `error` has the reason, cut to `error_bytes` with its final 0. A profile may name no files.
 */
HAPNET_LINK_API struct hapnet_link* hapnet_link_create(const char* profile, uint64_t seed,
                                                       char* error, size_t error_bytes);

/** The same; the profile may name files below `folder`, which are read now. */
HAPNET_LINK_API struct hapnet_link* hapnet_link_create_in(const char* profile, const char* folder,
                                                          uint64_t seed, char* error,
                                                          size_t error_bytes);

/** Frees the link, and what is in flight on it. NULL is no link, and nothing happens. */
HAPNET_LINK_API void hapnet_link_destroy(struct hapnet_link* link);

/**
 * Sets one condition for what is pushed from `now_ns` on: "up.delay" to "200ms", as
 * `hapnet-emulator --set` takes it. Returns 0, or -1 with the reason in `error`.
 */
HAPNET_LINK_API int hapnet_link_set(struct hapnet_link* link, const char* key, const char* value,
                                    int64_t now_ns, char* error, size_t error_bytes);

/**
 * Takes a packet that arrives at `now_ns`; its bytes are copied. Returns 0 when it will leave, the
 * number of the cause when it is dropped (see hapnet_link_cause()), and -1 when nothing was done:
 * a direction that is none, or more than HAPNET_LINK_PACKET_MAX bytes.
 */
HAPNET_LINK_API int hapnet_link_push(struct hapnet_link* link, int direction, const void* bytes,
                                     size_t size, int64_t now_ns);

/**
 * Copies the packet that is due at `now_ns`, the earliest of both directions, into `buffer`, and
 * describes it in `packet`, which may be NULL. Returns 1, or 0 when none is due. When `buffer` has
 * fewer bytes than the packet, it returns -1, `packet` says how many there are, and the packet
 * stays the next one.
 */
HAPNET_LINK_API int hapnet_link_pop(struct hapnet_link* link, int64_t now_ns, void* buffer,
                                    size_t size, struct hapnet_link_packet* packet);

/** When to call hapnet_link_pop() again; HAPNET_LINK_NEVER while nothing is in flight. */
HAPNET_LINK_API int64_t hapnet_link_next_deadline(const struct hapnet_link* link);

/**
 * Writes the statistics of both directions as JSON: {"up":{...},"down":{...}}, each with the keys
 * of a direction in docs/formats/statistics.md. Lateness is how long after its due time a packet
 * was popped. Returns how many bytes the text has without its final 0; when that is `size` or
 * more, the text was cut.
 */
HAPNET_LINK_API size_t hapnet_link_statistics(const struct hapnet_link* link, char* buffer,
                                              size_t size);

/**
 * Writes the fate of the packet that was pushed last, as a line of docs/formats/fates.md with its
 * end. Returns like hapnet_link_statistics(); 0 before the first packet.
 */
HAPNET_LINK_API size_t hapnet_link_fate(const struct hapnet_link* link, char* buffer, size_t size);

/** The name of a cause that hapnet_link_push() returned, "random_loss"; NULL for any other. */
HAPNET_LINK_API const char* hapnet_link_cause(int cause);

#ifdef __cplusplus
}
#endif

#endif

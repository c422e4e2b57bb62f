/* SPDX-FileCopyrightText: 2026 The Hapnet authors */
/* SPDX-License-Identifier: MIT */
/* A second of packets over a bad network, in a moment. */
#include <hapnet_link.h>
#include <inttypes.h>
#include <stdio.h>

int main(void)
{
    const int64_t ms = 1000000;
    char text[4096];
    struct hapnet_link* link = hapnet_link_create(
        "up.delay = \"40ms\"\nup.jitter = \"5ms\"\nup.loss = \"2%\"\n", 42, text, sizeof text);
    if (link == NULL) return fprintf(stderr, "%s\n", text), 2;

    int lost = 0;
    for (int64_t now = 0; now < 1100 * ms; now += ms) {
        if (now < 1000 * ms) {
            const int cause = hapnet_link_push(link, HAPNET_LINK_UP, &now, sizeof now, now);
            if (cause > 0 && ++lost == 1) printf("first loss: %s\n", hapnet_link_cause(cause));
        }
        int64_t sent = 0;
        struct hapnet_link_packet packet;
        while (hapnet_link_pop(link, now, &sent, sizeof sent, &packet) == 1) {
            if (packet.number % 100 == 0)
                printf("packet %3" PRIu64 " took %.3f ms\n", packet.number,
                       (double)(packet.due_ns - sent) / 1e6);
        }
    }
    printf("%d of 1000 lost\n", lost);
    hapnet_link_statistics(link, text, sizeof text);
    hapnet_link_destroy(link);
    return 0;
}

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/net/real_time.hpp"

#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace hapnet::net {

namespace {

/// If memory that can still grow is locked, later allocations fail once RLIMIT_MEMLOCK is reached.
/// So memory is locked only if there is no limit.
bool lock_memory(Locking locking)
{
    rlimit limit{};
    if (getrlimit(RLIMIT_MEMLOCK, &limit) != 0) return false;
    if (limit.rlim_cur != RLIM_INFINITY) {
        limit.rlim_cur = limit.rlim_max = RLIM_INFINITY;
        if (setrlimit(RLIMIT_MEMLOCK, &limit) != 0) return false;
    }
    const int as_used = locking == Locking::as_used ? MCL_ONFAULT : 0;
    return mlockall(MCL_CURRENT | MCL_FUTURE | as_used) == 0;
}

} // namespace

RealTime request_real_time(int priority, Locking locking)
{
    RealTime granted;
    const sched_param parameters{.sched_priority = priority};
    granted.fifo = sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
    prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL); // 1 ns instead of 50 us; always allowed
    granted.locked_memory = lock_memory(locking);
    return granted;
}

void leave_real_time()
{
    const sched_param normal{};
    sched_setscheduler(0, SCHED_OTHER, &normal);
}

std::string RealTime::shortage() const
{
    if (fifo && locked_memory) return "";
    const std::string what = fifo            ? "locked memory is"
                             : locked_memory ? "SCHED_FIFO is"
                                             : "SCHED_FIFO and locked memory are";
    if (geteuid() == 0) {
        return what + " not available, even to root, in this container or virtual machine: some "
                      "wake-ups will be later";
    }
    return what + " not allowed: some wake-ups will be later; run as root, or give your user "
                  "'rtprio 50' and 'memlock unlimited' in /etc/security/limits.d";
}

} // namespace hapnet::net

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace hapnet::bench {

/// The machine on which a bench runs.
struct Host {
    std::string cpu;
    std::string kernel;
    int cores = 0;
    bool fifo = false; // SCHED_FIFO may be used
    double load = 0.0; // load average of the last minute
};
[[nodiscard]] Host host();

/// Keeps this thread on one processor, if there are two.
void pin(unsigned int processor);

/// Gives this thread SCHED_FIFO with a priority; 0 takes it away. Returns false when the machine
/// does not allow it.
bool set_fifo(int priority);

} // namespace hapnet::bench

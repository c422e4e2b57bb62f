// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace hapnet::bench {

/// The machine that is measured on.
struct Host {
    std::string cpu;
    std::string kernel;
    int cores = 0;
    bool fifo = false; // SCHED_FIFO may be used
    double load = 0.0; // of the last minute, when it was asked
};
[[nodiscard]] Host host();

/// Keeps this thread on one processor, where there are two.
void pin(unsigned int processor);

/// Gives this thread SCHED_FIFO with a priority, or with 0 takes it away; false when the machine
/// does not allow it.
bool set_fifo(int priority);

} // namespace hapnet::bench

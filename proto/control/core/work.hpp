// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace hapnet::control {

/// A little of some work: 50 us at most. True when all of it is done.
using Step = std::function<bool()>;

/// Runs work at a time when nothing else happens, and returns once the work is done.
using DoWork = std::function<void(const Step& step)>;

/// DoWork for a program with one thread.
inline void do_at_once(const Step& step)
{
    while (!step()) {}
}

} // namespace hapnet::control

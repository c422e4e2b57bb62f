// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace hapnet::control {

/// A step of some work, of at most 50 us. Returns true when all of the work is done.
using Step = std::function<bool()>;

/// Runs all steps of some work at times when nothing else happens, and returns once the work is
/// done.
using DoWork = std::function<void(const Step& step)>;

/// The DoWork of a program with one thread.
inline void do_at_once(const Step& step)
{
    while (!step()) {}
}

} // namespace hapnet::control

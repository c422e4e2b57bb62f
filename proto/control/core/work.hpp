// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace hapnet::control {

/// A little of some work: 50 us at most. True when all of it is done.
using Step = std::function<bool()>;

/// Has work done where nothing else happens meanwhile; returns once it is done.
using DoWork = std::function<void(const Step& step)>;

/// For a program of one thread.
inline void do_at_once(const Step& step)
{
    while (!step()) {}
}

} // namespace hapnet::control

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/emulation.hpp"
#include "emulator/core/director.hpp"
#include "proto/base/time.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// What decides for a path, as it was at a moment.
struct Decider {
    std::string name;
    bool is_there = false; // the path
    Director director;
};

/// What is known of all paths at a moment.
struct Moment {
    std::vector<Decider> deciders; // see AllPaths::deciders()
    std::uint64_t generation = 0;
    base::Duration elapsed{};
    std::optional<base::TimePoint> next_change;
};

/// Looks by a step of the emulation's work.
[[nodiscard]] Moment moment_of(Emulation& emulation, base::TimePoint now);

} // namespace hapnet::emulator

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

/// A copy of the director of a path.
struct Decider {
    std::string name;
    bool is_there = false; // the path exists; false: it does not exist yet
    Director director;
};

/// Copies of all directors of a run, taken at one moment.
struct Moment {
    std::vector<Decider> deciders; // see AllPaths::deciders()
    std::uint64_t generation = 0;
    base::Duration elapsed{};
    std::optional<base::TimePoint> next_change;
};

/// Returns copies of all directors, made in one step of the emulation's work after the paths have
/// caught up with `now`.
[[nodiscard]] Moment moment_of(Emulation& emulation, base::TimePoint now);

} // namespace hapnet::emulator

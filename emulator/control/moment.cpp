// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control/moment.hpp"

#include <cstddef>

namespace hapnet::emulator {

Moment moment_of(Emulation& emulation, base::TimePoint now)
{
    Moment moment;
    moment.deciders.reserve(256); // allocated here, not by the thread that relays
    emulation.work([&] {
        AllPaths& paths = emulation.paths;
        paths.catch_up(now);
        const std::size_t there = paths.all().size();
        for (const Paths::Decider& one : paths.deciders()) {
            const bool is_there = moment.deciders.size() < there;
            moment.deciders.push_back({std::string{one.name}, is_there, *one.director});
        }
        moment.generation = paths.generation();
        moment.elapsed = paths.elapsed();
        moment.next_change = paths.next_change();
        return true;
    });
    return moment;
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/control/run_statistics.hpp"
#include "emulator/core/change_log.hpp"
#include "emulator/core/conditions.hpp"
#include "emulator/core/emulated_path.hpp"
#include "emulator/core/statistics.hpp"
#include "emulator/core/stream_statistics.hpp"
#include "emulator/ports/frames.hpp"
#include "emulator/ports/links.hpp"
#include "emulator/ports/upstream.hpp"
#include "emulator/report.hpp"
#include "proto/base/time.hpp"
#include "proto/control/core/work.hpp"
#include "proto/net/endpoint.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::emulator {

/// One direction of a path at one moment.
struct WayState {
    Statistics statistics{};
    StreamTotals stream{};
    std::uint64_t strangers = 0;
    std::uint64_t overflowed = 0;
    std::uint64_t unreachable = 0;
    std::vector<RegimeCourse> regimes{}; // course of each regime until then
};

/// A path at one moment, and the changes of its conditions up to then.
struct PathState {
    std::string name;
    std::uint64_t client = 0; // number of its client; 0: not a client's path
    std::optional<net::Endpoint> end_a;
    std::optional<net::Endpoint> end_b;
    std::shared_ptr<const Path> conditions;
    base::Duration elapsed{};             // time since the run began
    std::vector<ConditionChange> changes; // the most recent changes
    std::uint64_t changes_omitted = 0;    // changes that are not in `changes`
    WayState up;                          // if there are flows: traffic that is in no flow
    WayState down;
    std::vector<PathState> flows; // states of the flows, in the profile's order
    Statistics all_up;            // if there are flows: sums of them and of the other traffic
    Statistics all_down;
    std::uint64_t unknown_fragments = 0; // see Classifier
};

/// A run at one moment: everything that its reports are made from, apart from what never changes.
/// If there are many paths, each was read on its own, some hundred microseconds apart.
struct RunState {
    base::Duration elapsed{}; // time since the sockets were bound
    std::uint64_t generation = 1;
    bool is_over = false;
    std::vector<std::string> failures; // see AnyRun
    std::size_t count = 0;             // number of valid entries in `paths`
    std::vector<PathState> paths;      // at least `count` entries: they are large and are reused

    /// The state of a server and its clients.
    struct Server {
        std::uint64_t clients_seen = 0;
        std::uint64_t refused = 0;
        std::uint64_t strangers = 0;
        std::uint64_t overflowed = 0;
        std::uint64_t unreachable = 0;
        ports::Upstream::Departed departed{};
        std::shared_ptr<const Path> newcomers; // conditions for clients to come
    };
    Server server{};
    InterfaceReports interfaces{}; // only for a run between interfaces
};

// These functions read the state of a run in steps of `work`, none of which copies more than some
// 100 KiB. `state` is an earlier state of the same run, or an empty one.

void look_at(const AnyRun& run, const ports::Links& port, const control::DoWork& work,
             RunState& state);
void look_at(const AnyRun& run, const ports::Upstream& port, const control::DoWork& work,
             RunState& state);
void look_at(const AnyRun& run, const ports::Frames& port, const control::DoWork& work,
             RunState& state);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/simulated/task.hpp"
#include "peer/cli/device_options.hpp"
#include "peer/cli/key_options.hpp"
#include "peer/core/clock_policy.hpp"
#include "peer/core/others.hpp"
#include "peer/core/send_policy.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"
#include "proto/cli/command.hpp"
#include "proto/cli/keep_options.hpp"
#include "proto/net/endpoint.hpp"
#include "scene/description.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::peer {

/// The options of the command line. Host names are not resolved yet; the scene has been read.
struct Options {
    std::uint16_t id = 1;
    net::HostPort listen{"127.0.0.1", 0};
    std::vector<NamedPeer> others; // other peers, sorted by id; with a key, their first places
    std::size_t wait_for = 0;      // number of peers needed to start, this one included; 0: all
    KeyChoice key;
    DeviceChoice device;
    std::string scene_name = "paper";
    scene::Description scene; // must be accepted by shared_bodies()
    double grip_damping_ns_per_m = 4.0;
    double force_max_n = 3.3; // greatest force on the hand
    device::Task task = device::Task::p1;
    Algorithm algorithm;
    SendPolicy send{};
    Playout playout = Playout::none;
    ClockPolicy clock{};
    base::Seed seed{1};
    base::Duration duration{std::chrono::seconds{30}};
    bool insecure = false;
    bool untested_device = false;        // allow a device that has not passed a self-test
    std::optional<std::string> dead_man; // "button", or "evdev:" and a device of the kernel
    std::optional<std::string> record;
    std::optional<std::string> stats;   // a file, or "-" for stdout
    std::optional<std::string> events;  // a file, or "-" for stdout
    std::optional<std::string> control; // path of the control socket
    std::optional<net::HostPort> plot;  // destination of frames over UDP
    cli::KeepOptions keep{};            // time span of rows to keep, and the folder to save them in

    [[nodiscard]] bool is_pair() const { return others.size() <= 1; }
    /// Returns the peers of the session. In a pair, any peer that answers at the other address is
    /// accepted.
    [[nodiscard]] Roster roster() const
    {
        Roster roster{.others = {}, .wait_for = wait_for};
        for (const NamedPeer& other : others)
            roster.others.push_back(is_pair() ? std::uint16_t{0} : std::uint16_t{other.id});
        base::ensure(std::ranges::is_sorted(roster.others)); // Roster::others is ascending
        return roster;
    }
};

/// Values that are needed only until complete() has run.
struct Asked {
    std::string printed_algorithm; // name in --print-algorithm
    net::HostPort remote;          // --remote
    std::vector<NamedPeer> named;  // --peer
};

/// Adds the options of a session, bound to `options` and `asked`.
void add_session_options(cli::Command& program, Options& options, Asked& asked);

/// Completes the options after parsing: sets the other peers, and the task's scene if no scene was
/// named. Refuses options that contradict each other.
[[nodiscard]] base::Result<void> complete(Options& options, const Asked& asked,
                                          const cli::Command& program);

/// Loads the shared object of the algorithm, if it has one, which runs code of that file. Call it
/// only for a session that is about to begin, not to print, check or refuse options.
[[nodiscard]] base::Result<void> load_code(Options& options);

} // namespace hapnet::peer

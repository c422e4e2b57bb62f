// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/virtual_time/setting.hpp"
#include "peer/core/sync/algorithm.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::test {

/// A session whose energy is watched.
struct EnergyCase {
    lab::virtual_time::Setting setting;
    base::Duration age_max{};          // of a message on these networks, bursts of loss included
    std::optional<std::size_t> liar{}; // whose messages say that its hand means to swing
    std::string words;                 // for a failure
};

/// Two to five hands of 0.1 to 0.6 kg, 1 to 16 N s/m and 50 to 1000 N/m with a task that they can
/// play. In every second session their devices have a friction of up to 0.5 N, and state another
/// one. They play over a path of 0 to 400 ms with jitter, loss or bursts of loss, and copies. One
/// session in three has a liar: its intention swings by 20 mm, 6 times a second.
[[nodiscard]] EnergyCase drawn_energy_case(std::uint64_t seed, const peer::Algorithm& algorithm,
                                           base::Duration duration);

/// The number of such cases that a test plays: HAPNET_ENERGY_SESSIONS in the environment, or as
/// usual.
[[nodiscard]] std::uint64_t energy_sessions(std::uint64_t usual);

/// What came of it.
struct EnergyPlayed {
    bool has_begun = false;   // one of the first two players has met the others within 10 s
    double least_j = 0.0;     // of the sum of all hands' work on their devices
    double withdrawn_j = 0.0; // the most that a hand got out of its device within age_max, summed
    double work_j = 0.0;      // all positive work of all hands: that something happened
    bool is_finite = true;
    std::uint64_t hash = 0; // over the bits of every body and force in every tick
};

/// What happens to the datagrams besides the network.
enum class Delivery : std::uint8_t {
    once,
    twice_and_late, // each comes again at once, and one of those before once more
};

[[nodiscard]] EnergyPlayed play_for_energy(const EnergyCase& one,
                                           Delivery delivery = Delivery::once);

/// The sum of the hands' work with remote-proxy stays above minus this: what the copies lend and
/// store, and what the hands got out of their devices while that was not known yet.
[[nodiscard]] double remote_proxy_bound_j(const EnergyCase& one, const EnergyPlayed& played);

} // namespace hapnet::test

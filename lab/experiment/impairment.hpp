// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "peer/core/send_policy.hpp"
#include "proto/base/formats.hpp"
#include "proto/base/names.hpp"
#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

namespace hapnet::lab::experiment {

/// An impairment that a search increases: one of Fig. 6 of the paper, or the interval between a
/// player's messages. A longer interval needs less of the network's rate.
enum class Impairment : std::uint8_t { delay, jitter, random_loss, burst_loss, interval };
inline constexpr std::array impairments{Impairment::delay, Impairment::jitter,
                                        Impairment::random_loss, Impairment::burst_loss,
                                        Impairment::interval};

constexpr auto names_of(base::Tag<Impairment> /*enum*/)
{
    return base::names("delay", "jitter", "random-loss", "burst-loss", "interval");
}
using base::name_of;

/// Returns the unit of an impairment's levels: "ms", "percent", "of_100" (messages lost in a row of
/// every 100) or "ticks" (from one message to the next).
[[nodiscard]] std::string_view unit_of(Impairment impairment);

/// The amount of an impairment, in thousandths of its unit. It is a whole number, so that a search
/// visits the same levels on every machine. Not negative.
struct ImpairmentLevel {
    std::int64_t thousandths = 0;

    friend constexpr auto operator<=>(const ImpairmentLevel&, const ImpairmentLevel&) = default;
};

/// Returns the level as a number in its unit: "160", "4.5".
[[nodiscard]] std::string to_text(ImpairmentLevel level);
[[nodiscard]] double in_units(ImpairmentLevel level);

/// The text of a level: "160ms", "93%", or a whole number of messages or ticks.
struct LevelFormat {
    Impairment impairment{};

    void read(const base::Node& node, ImpairmentLevel& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(ImpairmentLevel level) const;
    [[nodiscard]] std::string describe() const;
};

/// Returns the path `ground` with an impairment of this level, equal in both directions. Level 0
/// leaves `ground` as it is. Jitter of J is uniform from 0 to 2 J, with mean J, drawn for each
/// datagram on its own. Datagrams overtake one another unless `order` prevents it. The interval
/// leaves every path as it is.
[[nodiscard]] emulator::Path impaired(const emulator::Path& ground, Impairment impairment,
                                      ImpairmentLevel level,
                                      emulator::Order order = emulator::Order::free);

/// Returns the send policy of players at a level of the impairment. For the interval, the level is
/// the number of ticks from one message to the next. Other impairments, and level 0, leave `send`
/// as it is.
[[nodiscard]] peer::SendPolicy thinned(const peer::SendPolicy& send, Impairment impairment,
                                       ImpairmentLevel level);

} // namespace hapnet::lab::experiment

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace hapnet::web {

/// The place where a page wants the hand to be, m, and whether the hand grips a body within its
/// reach.
struct HandPlace {
    std::array<double, 3> at{};
    bool grips = false;
};

/// A message of a page about the hand: a place, or nullopt to release it.
struct HandMessage {
    std::optional<HandPlace> place;
};

/// Reads {"hand":{"x":0.01,"y":0,"z":0}}, which may have "grip":true, or {"hand":null}. Returns
/// nullopt for anything else, and for a coordinate farther than hand_reach_m from the origin.
[[nodiscard]] std::optional<HandMessage> hand_message_in(const nlohmann::ordered_json& message);
inline constexpr double hand_reach_m = 0.25;

/// Decides which page moves the hand: the first page that asks, until it releases the hand or sends
/// nothing for lets_go_after. Other pages watch. It reads no clock.
class HandHold {
public:
    static constexpr base::Duration lets_go_after{std::chrono::milliseconds{250}};
    /// The shortest time between two places. Places that arrive sooner are ignored.
    static constexpr base::Duration least_apart{std::chrono::milliseconds{4}};

    enum class Answer : std::uint8_t {
        taken,    // the page holds the hand from now on; its place counts
        moved,    // the page's place counts
        too_soon, // the place is ignored
        let_go,   // no page holds it any more
        watches,  // another page holds it
    };

    [[nodiscard]] Answer on_message(std::uint64_t page, const HandMessage& message,
                                    base::TimePoint now);
    [[nodiscard]] bool is_held(base::TimePoint now) const
    {
        return page_ && now - *last_ <= lets_go_after;
    }

private:
    std::optional<std::uint64_t> page_;
    std::optional<base::TimePoint> last_; // time at which a place counted
};

/// Returns the request to the peer for a place; nullopt: to release the hand.
[[nodiscard]] std::string hand_request(const std::optional<HandPlace>& place);

/// Returns the message to the page about an answer: {"type":"hand","holds":..,"says":..}. It is
/// empty if the page learns nothing new.
[[nodiscard]] std::string told_of(HandHold::Answer answer);

} // namespace hapnet::web

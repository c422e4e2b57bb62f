// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/hand_hold.hpp"

#include <cmath>

namespace hapnet::web {

namespace {

using Json = nlohmann::ordered_json;

std::string told(bool holds, const char* says)
{
    return Json{{"type", "hand"}, {"holds", holds}, {"says", says}}.dump();
}

} // namespace

std::optional<HandMessage> hand_message_in(const nlohmann::ordered_json& message)
{
    const auto hand = message.find("hand");
    if (message.size() != 1 || hand == message.end()) return std::nullopt;
    if (hand->is_null()) return HandMessage{};
    if (!hand->is_object()) return std::nullopt;
    HandPlace place;
    const auto grip = hand->find("grip");
    const bool says_grip = grip != hand->end();
    if (hand->size() != (says_grip ? 4 : 3)) return std::nullopt;
    if (says_grip && !grip->is_boolean()) return std::nullopt;
    place.grips = says_grip && grip->get<bool>();
    constexpr std::array names{"x", "y", "z"};
    for (std::size_t axis = 0; axis < names.size(); ++axis) {
        const auto value = hand->find(names.at(axis));
        if (value == hand->end() || !value->is_number()) return std::nullopt;
        place.at.at(axis) = value->get<double>();
        if (!(std::abs(place.at.at(axis)) <= hand_reach_m)) return std::nullopt;
    }
    return HandMessage{place};
}

HandHold::Answer HandHold::on_message(std::uint64_t page, const HandMessage& message,
                                      base::TimePoint now)
{
    const bool is_free = !is_held(now);
    const bool is_own = page_ == page && !is_free;
    if (!is_free && !is_own) return Answer::watches;
    // The limit applies to all pages together, so pages that take and release the hand in turn do
    // not send more often.
    if (message.place && last_ && now - *last_ < least_apart) return Answer::too_soon;
    if (!message.place) {
        page_.reset();
        return Answer::let_go;
    }
    page_ = page;
    last_ = now;
    return is_own ? Answer::moved : Answer::taken;
}

std::string hand_request(const std::optional<HandPlace>& place)
{
    if (!place) return Json{{"command", "hand"}, {"let_go", true}}.dump();
    const auto& [x, y, z] = place->at;
    return Json{{"command", "hand"}, {"x", x}, {"y", y}, {"z", z}, {"grip", place->grips}}.dump();
}

std::string told_of(HandHold::Answer answer)
{
    switch (answer) {
    case HandHold::Answer::taken: return told(true, "");
    case HandHold::Answer::let_go: return told(false, "");
    case HandHold::Answer::watches:
        return told(false, "another page holds the hand: you watch until it lets go");
    case HandHold::Answer::moved:
    case HandHold::Answer::too_soon: break;
    }
    return {};
}

} // namespace hapnet::web

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/hand_desk.hpp"

#include <utility>

namespace hapnet::web {

std::string HandDesk::on_message(std::uint64_t page, const HandMessage& message, Daemon& peer,
                                 base::TimePoint now)
{
    const auto answer = hold_.on_message(page, message, now);
    const bool counts = answer == HandHold::Answer::taken || answer == HandHold::Answer::moved;
    const auto unanswered = static_cast<std::size_t>(asked_.use_count() - 1);
    if (counts && unanswered < asked_max) ask(peer, message.place);
    return told_of(answer);
}

bool HandDesk::tick(Daemon* peer, base::TimePoint now)
{
    const bool is_held = hold_.is_held(now);
    if (has_told_ && !is_held && peer != nullptr) ask(*peer, std::nullopt);
    return std::exchange(is_held_, is_held) != is_held;
}

void HandDesk::ask(Daemon& peer, const std::optional<HandPlace>& place)
{
    has_told_ = place.has_value();
    peer.ask(hand_request(place), [asked = asked_](const auto&) {});
}

} // namespace hapnet::web

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/unit/peer/control/fake_peer_control.hpp"
#include "web/core/hand_hold.hpp"

#include <chrono>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <variant>

/// Whatever pages send about the hand, a peer accepts the resulting request, and moves its hand to
/// the place that the page has named, within reach. One page at a time holds the hand, and a
/// silence ends that.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    peer::FakePeerControl fake;
    const peer::PeerControl peer = fake.controls(/*has_page*/ true);
    web::HandHold hold;
    base::TimePoint now{std::chrono::seconds{100}};
    std::optional<std::uint64_t> holder;
    std::istringstream lines{text};
    for (std::string line; std::getline(lines, line);) {
        // The length of a line stands for the time since the one before, and for the page.
        now += std::chrono::milliseconds{line.size()};
        const std::uint64_t page = line.size() % 3;
        if (!hold.is_held(now)) holder.reset();
        const auto json = control::parse_object(line);
        const auto message = json ? web::hand_message_in(*json) : std::nullopt;
        if (!message) continue;
        const auto told = fake.hand.size();
        const auto answer = peer::answer_to(web::hand_request(message->place), peer, now);
        base::ensure(std::get<std::string>(answer) == "{\"ok\":true}");
        base::ensure(fake.hand.size() == told + 1);
        const auto& wish = fake.hand.back();
        base::ensure(wish.has_value() == message->place.has_value());
        for (const int axis : {0, 1, 2}) {
            if (!wish) break;
            const double coordinate = message->place->at.at(static_cast<std::size_t>(axis));
            base::ensure(std::abs(coordinate) <= web::hand_reach_m);
            base::ensure(wish->place.value[axis] == coordinate);
        }
        base::ensure(!wish || wish->grips == message->place->grips);
        switch (hold.on_message(page, *message, now)) {
        case web::HandHold::Answer::taken:
            base::ensure(!holder && message->place);
            holder = page;
            break;
        case web::HandHold::Answer::moved: base::ensure(holder == page && message->place); break;
        case web::HandHold::Answer::let_go:
            base::ensure((!holder || holder == page) && !message->place);
            holder.reset();
            break;
        case web::HandHold::Answer::watches: base::ensure(holder && holder != page); break;
        case web::HandHold::Answer::too_soon: base::ensure(!holder || holder == page); break;
        }
        base::ensure(hold.is_held(now) == holder.has_value());
    }
    return 0;
}

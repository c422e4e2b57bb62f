// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/fuzz/fuzz_target.hpp"
#include "tests/unit/peer/control/fake_peer_control.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

/// Every line of an answer to any client of a peer's control socket is an object that says whether
/// the request succeeded. The peer is stopped as often as it says so.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace hapnet;
    const base::TimePoint start{};
    peer::FakePeerControl fake;
    fake.subject = peer::subject_of(fake.controls(/*has_page*/ true));
    control::Conversation conversation;
    std::string text;
    for (const std::uint8_t byte : std::span{data, size}) text += static_cast<char>(byte);
    text.resize(std::min(text.size(), conversation.room()));
    conversation.on_bytes(text);
    conversation.on_end();
    std::string said;
    while (conversation.advance(fake.subject, start)) {
        said += conversation.output();
        conversation.on_written(conversation.output().size(), start);
    }
    std::istringstream lines{said};
    int stops = 0;
    for (std::string line; std::getline(lines, line);) {
        const auto reply = nlohmann::json::parse(line, nullptr, false);
        base::ensure(reply.is_object() && reply.contains("ok") && reply["ok"].is_boolean());
        stops += reply.value("stopping", false) ? 1 : 0;
    }
    base::ensure(stops == fake.stops);
    for (const auto& wish : fake.hand) {
        const base::Position place = wish.value_or(device::HandWish{}).place;
        for (const int axis : {0, 1, 2}) base::ensure(std::abs(place.value[axis]) <= 0.25);
    }
    return 0;
}

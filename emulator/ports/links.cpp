// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/links.hpp"

#include <cstdint>

namespace hapnet::emulator::ports {

Links::Links(const Places& places, Paths& paths, Recorder& recorder)
{
    if (places.size() > 1) ready_.emplace();
    for (const auto& [name, endpoints] : places) {
        const auto number = static_cast<std::uint32_t>(relays_.size());
        relays_.push_back(
            std::make_unique<Relay>(endpoints, paths, recorder, Relay::Among{name, own_, number}));
        if (!ready_) continue;
        const Relay& relay = *relays_.back();
        ready_->add(relay.a().socket.descriptor(), 2 * std::uint64_t{number}, {.to_read = true});
        ready_->add(relay.b().socket.descriptor(), 2 * std::uint64_t{number} + 1,
                    {.to_read = true});
    }
}

void Links::receive()
{
    if (!ready_) return relays_.front()->receive(); // to ask first would cost another call
    for (const net::Ready& ready : ready_->ready()) {
        Relay& relay = *relays_[ready.key / 2];
        ready.key % 2 == 0 ? relay.receive_from_a() : relay.receive_from_b();
    }
}

void Links::release(base::TimePoint now)
{
    for (const auto& relay : relays_) relay->release(now);
}

std::vector<int> Links::descriptors() const
{
    if (ready_) return {ready_->descriptor()};
    const Relay& only = *relays_.front();
    return {only.a().socket.descriptor(), only.b().socket.descriptor()};
}

std::optional<std::string> Links::next_notice()
{
    for (const auto& relay : relays_) {
        if (auto notice = relay->next_notice()) return notice;
    }
    return std::nullopt;
}

} // namespace hapnet::emulator::ports

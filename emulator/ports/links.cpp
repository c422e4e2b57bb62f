// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/links.hpp"

#include <cstdint>

namespace hapnet::emulator::ports {

Links::Links(const Places& places, const std::vector<std::unique_ptr<Paths>>& paths,
             Recorder& recorder)
{
    for (std::size_t i = 0; i < paths.size(); ++i) parts_.push_back(std::make_unique<Part>());
    const bool has_several = places.size() > 1;
    for (const auto& [name, endpoints] : places) {
        const std::size_t part = part_of(relays_.size(), paths.size());
        const Relay::Among among{name, own_, static_cast<std::uint32_t>(relays_.size()),
                                 add_to(recorder, name, paths[part]->flows()), recorder.lane(part)};
        relays_.push_back(std::make_unique<Relay>(endpoints, *paths[part], among));
        if (has_several && !parts_[part]->ready_) parts_[part]->ready_.emplace();
        parts_[part]->add(*relays_.back(), *paths[part]);
    }
}

void Links::Part::add(Relay& relay, Paths& paths)
{
    paths_ = &paths;
    put_by_number(by_path_, relay.path(), &relay);
    const auto place = static_cast<std::uint64_t>(relays_.size());
    relays_.push_back(&relay);
    if (!ready_) return;
    ready_->add(relay.a().socket.descriptor(), 2 * place, {.to_read = true});
    ready_->add(relay.b().socket.descriptor(), 2 * place + 1, {.to_read = true});
}

std::vector<net::Endpoint> Links::locals() const
{
    std::vector<net::Endpoint> all;
    for (const auto& relay : relays_) all.insert(all.end(), {relay->a().local, relay->b().local});
    return all;
}

void Links::Part::receive()
{
    if (!ready_) return relays_.front()->receive(); // asking first would cost another call
    for (const net::Ready& ready : ready_->ready()) {
        Relay& relay = *relays_[ready.key / 2];
        ready.key % 2 == 0 ? relay.receive_from_a() : relay.receive_from_b();
    }
}

void Links::Part::release(base::TimePoint now)
{
    paths_->each_due(
        now, [&](std::size_t number) { by_path_[number]->release(paths_->at(number), now); });
}

std::vector<int> Links::Part::descriptors() const
{
    if (ready_) return {ready_->descriptor()};
    const Relay& only = *relays_.front();
    return {only.a().socket.descriptor(), only.b().socket.descriptor()};
}

std::optional<std::string> Links::Part::next_notice()
{
    for (Relay* relay : relays_) {
        if (auto notice = relay->next_notice()) return notice;
    }
    return std::nullopt;
}

} // namespace hapnet::emulator::ports

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/frame_tap.hpp"

#include "device/fault.hpp"
#include "device/governor.hpp"

#include <algorithm>
#include <string>
#include <variant>

namespace hapnet::peer::monitor {

namespace {

constexpr telemetry::Names names{
    .governor =
        [](std::uint8_t state) {
            return device::name_of(static_cast<device::GovernorState>(state));
        },
    .fault = [](std::uint8_t fault) { return device::name_of(static_cast<device::Fault>(fault)); },
};

void feed(telemetry::Decimator& decimator, const loop::Entry& entry)
{
    if (const auto* row = std::get_if<record::Row>(&entry)) {
        if (const auto* tick = std::get_if<record::TickRow>(row)) decimator.take(*tick);
        if (const auto* session = std::get_if<record::SessionRow>(row)) decimator.take(*session);
        if (const auto* body = std::get_if<record::BodyRow>(row)) decimator.take(*body);
    } else if (const auto* heard = std::get_if<loop::HeardMessage>(&entry)) {
        decimator.hear(heard->from, heard->received_at, heard->message.bytes());
    }
}

} // namespace

control::FrameSource FrameTap::watch()
{
    auto decimator = std::make_shared<telemetry::Decimator>(peer_id_, names);
    for (const record::SessionRow& session : sessions_) decimator->take(session);
    watches_.push_back(decimator);
    return [decimator](std::string& text, std::uint64_t left_out) {
        if (const auto frame = decimator->next(left_out)) telemetry::append_json(text, *frame);
    };
}

void FrameTap::take(const loop::Entry& entry)
{
    if (const auto* row = std::get_if<record::Row>(&entry)) {
        if (const auto* session = std::get_if<record::SessionRow>(row)) note(*session);
    }
    if (watches_.empty()) return;
    std::erase_if(watches_, [&](const Watch& watch) {
        const auto decimator = watch.lock();
        if (decimator) feed(*decimator, entry);
        return !decimator;
    });
}

void FrameTap::note(const record::SessionRow& session)
{
    const auto known = std::ranges::find(sessions_, session.other, &record::SessionRow::other);
    if (known == sessions_.end()) {
        sessions_.push_back(session);
    } else {
        *known = session;
    }
}

} // namespace hapnet::peer::monitor

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/control/frame_tap.hpp"

#include "device/fault.hpp"
#include "device/governor.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/control/core/reply.hpp"

#include <algorithm>
#include <string>
#include <variant>

namespace hapnet::peer {

namespace {

constexpr telemetry::Names names{
    .governor =
        [](std::uint8_t state) {
            return device::name_of(static_cast<device::GovernorState>(state));
        },
    .fault = [](std::uint8_t fault) { return device::name_of(static_cast<device::Fault>(fault)); },
};

} // namespace

control::FrameSource FrameTap::watch()
{
    auto decimator = std::make_shared<telemetry::Decimator>(peer_id_, names);
    for (const record::SessionRow& session : sessions_) decimator->take(session);
    watches_.push_back(decimator);
    return [decimator](std::string& text, std::uint64_t left_out) {
        if (const auto frame = decimator->next(left_out)) {
            text += control::line_of(base::json_of(*frame));
        }
    };
}

void FrameTap::for_each_watch(const auto& visit)
{
    std::erase_if(watches_, [&](const Watch& watch) {
        const auto decimator = watch.lock();
        if (decimator) visit(*decimator);
        return !decimator;
    });
}

void FrameTap::take(const record::Row& row)
{
    if (const auto* session = std::get_if<record::SessionRow>(&row)) note(*session);
    if (watches_.empty()) return;
    if (const auto* heard = std::get_if<record::MessageRow>(&row)) {
        return hear(heard->from, heard->received_at, heard->bytes);
    }
    for_each_watch([&](telemetry::Decimator& decimator) {
        if (const auto* tick = std::get_if<record::TickRow>(&row)) decimator.take(*tick);
        if (const auto* session = std::get_if<record::SessionRow>(&row)) decimator.take(*session);
        if (const auto* body = std::get_if<record::BodyRow>(&row)) decimator.take(*body);
    });
}

void FrameTap::hear(std::uint16_t from, base::TimePoint at, std::span<const std::byte> message)
{
    for_each_watch([&](telemetry::Decimator& decimator) { decimator.hear(from, at, message); });
}

void FrameTap::begin_anew()
{
    sessions_.clear();
    skip();
}

void FrameTap::skip()
{
    for_each_watch([&](telemetry::Decimator& decimator) {
        decimator = telemetry::Decimator{peer_id_, names};
        for (const record::SessionRow& session : sessions_) decimator.take(session);
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

} // namespace hapnet::peer

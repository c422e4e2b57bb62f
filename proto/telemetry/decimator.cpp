// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/telemetry/decimator.hpp"

#include "proto/wire/message.hpp"

#include <algorithm>

namespace hapnet::telemetry {

void Decimator::take(const record::TickRow& tick)
{
    frame_.newest.row = tick;
    has_tick_ = true;
    frame_.cube_x_m.add(tick.cube.x());
    frame_.force_n.add(base::norm(tick.device));
    frame_.late_us.add(base::to_seconds(tick.late) * 1e6);
    frame_.missed += tick.missed_before;
}

void Decimator::take(const record::SessionRow& session)
{
    // With several other peers, each has a row. Their data about the session itself are the same.
    frame_.session = session;
    if (session.other == 0) return;
    HeardFrame& heard = frame_.heard[place_of(session.other)];
    heard.offset = session.remote_offset;
    heard.offset_uncertainty = session.offset_uncertainty;
}

void Decimator::take(const record::BodyRow& body)
{
    const auto known = std::find_if(frame_.bodies.begin(), frame_.bodies.end(),
                                    [&](const BodyFrame& one) { return one.body == body.body; });
    BodyFrame& place = known == frame_.bodies.end() ? frame_.bodies.emplace_back() : *known;
    place = {body.body, body.position, body.velocity, body.orientation};
}

void Decimator::hear(std::uint16_t from, base::TimePoint received_at,
                     std::span<const std::byte> message)
{
    if (from == 0) return; // the sender is not known yet
    const auto decoded = wire::decode(message);
    const auto* const state = decoded ? std::get_if<wire::State>(&*decoded) : nullptr;
    if (state == nullptr) return;
    const std::size_t place = place_of(from);
    HeardFrame& heard = frame_.heard[place];
    Other& other = others_[place];
    if (state->session != other.session) other = {.session = state->session, .sent = {}};
    ++heard.messages;
    if (state->sequence <= other.highest) {
        ++heard.late;
    } else {
        if (other.highest > 0) heard.lost += state->sequence - other.highest - 1;
        other.highest = state->sequence;
        other.sent = state->sent;
    }
    if (!heard.offset) return;
    heard.delay_ms.add(base::to_seconds((received_at + *heard.offset) - state->sent) * 1e3);
}

std::optional<Frame> Decimator::next(std::uint64_t left_out)
{
    if (!has_tick_) return std::nullopt;
    frame_.left_out = left_out > 0 ? std::optional{left_out} : std::nullopt;
    frame_.governor = names_.governor(frame_.newest.row.governor);
    frame_.fault.reset();
    if (frame_.newest.row.fault != 0) frame_.fault = names_.fault(frame_.newest.row.fault);
    for (std::size_t i = 0; i < others_.size(); ++i) {
        HeardFrame& heard = frame_.heard[i];
        heard.age.reset();
        if (!others_[i].sent || !heard.offset) continue;
        heard.age = (frame_.newest.row.at() + *heard.offset) - *others_[i].sent;
    }
    Frame frame = frame_;
    begin_anew();
    return frame;
}

std::size_t Decimator::place_of(std::uint16_t id)
{
    const auto known = std::lower_bound(
        frame_.heard.begin(), frame_.heard.end(), id,
        [](const HeardFrame& one, std::uint16_t wanted) { return one.from < wanted; });
    const auto place = known - frame_.heard.begin();
    if (known == frame_.heard.end() || known->from != id) {
        frame_.heard.insert(
            known,
            HeardFrame{
                .from = id, .delay_ms = {}, .age = {}, .offset = {}, .offset_uncertainty = {}});
        others_.insert(others_.begin() + place, Other{});
    }
    return static_cast<std::size_t>(place);
}

/// Resets the values of the time span. The newest values are kept.
void Decimator::begin_anew()
{
    ++frame_.number;
    frame_.cube_x_m = {};
    frame_.force_n = {};
    frame_.late_us = {};
    frame_.missed = 0;
    for (HeardFrame& heard : frame_.heard) {
        heard.messages = 0;
        heard.lost = 0;
        heard.late = 0;
        heard.delay_ms = {};
    }
}

} // namespace hapnet::telemetry

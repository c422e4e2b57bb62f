// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/ports/frame_batch.hpp"

#include "emulator/core/frame.hpp"
#include "proto/net/clock.hpp"

namespace hapnet::emulator::ports {

namespace {

DropCause frame_cause_of(net::SendOutcome outcome)
{
    switch (outcome) {
    case net::SendOutcome::buffer_full: return DropCause::send_buffer_full;
    case net::SendOutcome::no_route: return DropCause::no_route;
    case net::SendOutcome::too_big: return DropCause::too_big;
    case net::SendOutcome::sent:
    case net::SendOutcome::refused:
    case net::SendOutcome::failed: break;
    }
    return DropCause::send_failed;
}

} // namespace

void FrameBatch::add(const FrameWay& way, const Datagram& departure)
{
    entries_.push_back({.way = way, .departure = departure});
    add_bytes(as_it_leaves(departure));
}

void FrameBatch::add_undisturbed(std::span<const std::byte> bytes, std::uint64_t& lost)
{
    entries_.push_back({.lost = &lost});
    add_bytes(bytes);
}

void FrameBatch::add_bytes(std::span<const std::byte> bytes)
{
    bytes_.push_back(bytes);
    if (bytes_.full()) flush();
}

/// Returns its bytes, or a copy of them if they leave with a new mark or new checksums.
std::span<const std::byte> FrameBatch::as_it_leaves(const Datagram& departure)
{
    const auto bytes = departure.bytes;
    const bool is_to_be_marked =
        departure.marks.is_congested() && !read_frame(bytes).marks.is_congested();
    if (!fixes_checksums_ && !is_to_be_marked) return bytes;
    changed_.emplace_back(bytes.begin(), bytes.end());
    if (is_to_be_marked) mark_congestion(changed_.back());
    if (fixes_checksums_) fix_checksums(changed_.back());
    return changed_.back();
}

void FrameBatch::flush()
{
    if (bytes_.empty()) return;
    const auto outcomes = socket_.send_batch(bytes_.all());
    const auto at = net::monotonic_now();
    for (std::size_t i = 0; i < entries_.size(); ++i) {
        const Entry& entry = entries_[i];
        const bool is_sent = outcomes[i] == net::SendOutcome::sent;
        if (entry.way.path == nullptr) {
            if (!is_sent) ++*entry.lost;
        } else if (is_sent) {
            on_sent(entry, bytes_[i], at);
        } else {
            entry.way.path->on_failed(entry.way.direction, entry.departure,
                                      frame_cause_of(outcomes[i]));
        }
    }
    entries_.clear();
    bytes_.clear();
    changed_.clear();
}

void FrameBatch::on_sent(const Entry& entry, std::span<const std::byte> bytes, base::TimePoint at)
{
    const auto& [path, direction, pair] = entry.way;
    if (recorder_.captures()) {
        if (const auto packet = ip_packet_of(bytes); !packet.empty()) {
            recorder_.on_departure(
                {.side = direction == Direction::up ? CaptureSide::b : CaptureSide::a,
                 .is_outbound = true,
                 .at = at,
                 .payload = packet,
                 .pair = pair,
                 .is_ip = true},
                at - entry.departure.due, entry.departure.is_copy);
        }
    }
    path->on_sent(direction, entry.departure, at); // frees the bytes of the frame
}

} // namespace hapnet::emulator::ports

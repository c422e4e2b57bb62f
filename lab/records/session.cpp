// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/session.hpp"

#include "lab/records/bodies.hpp"
#include "peer/core/clock_policy.hpp"
#include "proto/base/clock_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <optional>
#include <ranges>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::lab::records {

namespace {

/// The part of a peer's configuration that the analysis needs.
struct Peer {
    std::int64_t id = 0;
    std::string boot_id;
    peer::ClockPolicy clock;
    base::Duration tick{};
    std::string task;
};

base::Result<Peer> peer_of(const record::Record& record)
{
    const auto find = [&](const char* key) {
        return record.config.value(nlohmann::json::json_pointer{key}, nlohmann::json{});
    };
    const auto id = find("/peer_id");
    const auto boot_id = find("/boot_id");
    const auto tick = find("/tick_ns");
    if (!id.is_number_integer()) return base::fail("its config has no whole number \"peer_id\"");
    if (!boot_id.is_string()) return base::fail("its config has no text \"boot_id\"");
    const bool sane = tick.is_number_integer() && tick >= 1 && tick <= 1'000'000'000;
    if (!sane) return base::fail("its config has no whole number \"tick_ns\" up to a second");
    Peer peer;
    peer.id = id.get<std::int64_t>();
    peer.boot_id = boot_id.get<std::string>();
    peer.tick = base::Duration{tick.get<std::int64_t>()};
    if (const auto clock = find("/clock"); clock.is_string())
        peer.clock = peer::parse_clock_policy(clock.get<std::string>()).value_or(peer.clock);
    if (const auto task = find("/task"); task.is_string()) peer.task = task.get<std::string>();
    return peer;
}

bool knows(const record::Record& record, std::uint32_t session)
{
    return std::ranges::find(record.sessions, session, &record::SessionRow::session) !=
           record.sessions.end();
}

std::optional<std::uint32_t> last_common_session(const record::Record& a, const record::Record& b)
{
    for (std::size_t i = a.sessions.size(); i > 0; --i) {
        if (knows(b, a.sessions[i - 1].session)) return a.sessions[i - 1].session;
    }
    return std::nullopt;
}

/// Returns the other peers by their ids, in the order of the peer's roster; empty in older records.
std::vector<std::int64_t> others_of(const record::Record& record)
{
    const auto ids = record.config.value("peers", nlohmann::json{});
    std::vector<std::int64_t> others;
    for (const auto& id : ids) {
        if (id.is_number_integer()) others.push_back(id.get<std::int64_t>());
    }
    return others;
}

/// Returns the part of a record that belongs to a session with one of the others. The newest
/// agreement counts, as the clock offset gets better with time.
Side side_of(const record::Record& record, std::uint32_t session, std::int64_t peer_id)
{
    const auto& rows = record.sessions;
    const auto is_of_it = [&](const record::SessionRow& row) { return row.session == session; };
    const auto first = std::ranges::find_if(rows, is_of_it);
    const auto next = std::find_if(first, rows.end(), [&](const record::SessionRow& row) {
        return row.other == first->other && !is_of_it(row);
    });
    const auto newest = std::find_if(std::make_reverse_iterator(next), rows.rend(), is_of_it);
    const auto ticks_before = [&](auto row) {
        return row == rows.end()
                   ? record.ticks.size()
                   : record.ticks_before_session[static_cast<std::size_t>(row - rows.begin())];
    };
    const std::size_t from = ticks_before(first);
    const auto others = others_of(record);
    return {*newest,
            std::span{record.ticks}.subspan(from, ticks_before(next) - from),
            record.messages,
            record.bodies,
            peer_id,
            others.size() <= 1 || others.front() == std::int64_t{first->other},
            record.config.value("begins_late", nlohmann::json{}) == true};
}

Clock clock_between(const Peer& a, const Peer& b, const record::SessionRow& terms_of_a)
{
    const bool are_synchronised = a.clock.synchronised_within && b.clock.synchronised_within;
    const bool is_one_boot = !a.boot_id.empty() && a.boot_id == b.boot_id;
    const auto within = are_synchronised
                            ? *a.clock.synchronised_within + *b.clock.synchronised_within
                            : base::Duration{};
    const bool is_ruled_out =
        base::are_two_clocks(terms_of_a.remote_offset, terms_of_a.offset_uncertainty + within);
    if (is_ruled_out || !(are_synchronised || is_one_boot)) return clock_of(terms_of_a);
    if (!are_synchronised) return {};
    // A peer that took the clocks for one has noted no offset at all.
    if (terms_of_a.remote_offset != base::Duration{0}) return clock_of(terms_of_a);
    return {.method = ClockMethod::synchronised, .uncertainty = within};
}

} // namespace

Clock clock_of(const record::SessionRow& row)
{
    // The clocks of real machines differ by a tenth of that: more means a damaged row.
    constexpr double skew_max_ppm = 1000.0;
    const bool is_possible = std::abs(row.remote_skew_ppm) <= skew_max_ppm;
    return {.method = ClockMethod::echo,
            .offset = row.remote_offset,
            .uncertainty = row.offset_uncertainty,
            .when = row.noted_at,
            .skew = is_possible ? 1e-6 * row.remote_skew_ppm : 0.0};
}

base::Result<Session> common_session(const record::Record& a, const record::Record& b)
{
    const auto peer_a = peer_of(a);
    if (!peer_a) return base::fail("record A: " + peer_a.error().message);
    const auto peer_b = peer_of(b);
    if (!peer_b) return base::fail("record B: " + peer_b.error().message);
    if (peer_a->id == peer_b->id) {
        return base::fail(
            fmt::format("both records were written by peer {}: give one of each peer", peer_a->id));
    }
    const auto session = last_common_session(a, b);
    if (!session)
        return base::fail("the records share no session: were they made in the same run?");

    Session common{side_of(a, *session, peer_a->id),
                   side_of(b, *session, peer_b->id),
                   {},
                   peer_a->tick,
                   peer_a->task,
                   bodies_shared_in(a, b)};
    common.clock = clock_between(*peer_a, *peer_b, common.a.terms);
    return common;
}

} // namespace hapnet::lab::records

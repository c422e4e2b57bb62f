// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/session.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <ranges>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::lab::records {

namespace {

/// What the analysis needs of the configuration of a peer.
struct Peer {
    std::int64_t id = 0;
    std::string boot_id;
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
    return Peer{id.get<std::int64_t>(), boot_id.get<std::string>(),
                base::Duration{tick.get<std::int64_t>()},
                find("/task").is_string() ? find("/task").get<std::string>() : ""};
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

/// The part of a record that belongs to a session which it knows. The newest terms count: the
/// clock offset gets better with time.
Side side_of(const record::Record& record, std::uint32_t session, std::int64_t peer_id)
{
    const auto& rows = record.sessions;
    std::size_t first = 0;
    while (rows[first].session != session) ++first;
    std::size_t end = first;
    while (end < rows.size() && rows[end].session == session) ++end;

    const std::size_t from = record.ticks_before_session[first];
    const std::size_t to =
        end < rows.size() ? record.ticks_before_session[end] : record.ticks.size();
    return {rows[end - 1], std::span{record.ticks}.subspan(from, to - from), record.messages,
            peer_id};
}

Clock clock_between(const Peer& a, const Peer& b, const record::SessionRow& terms_of_a)
{
    if (!a.boot_id.empty() && a.boot_id == b.boot_id) return {};
    return {ClockMethod::echo, terms_of_a.remote_offset, terms_of_a.offset_uncertainty};
}

} // namespace

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
                   peer_a->task};
    common.clock = clock_between(*peer_a, *peer_b, common.a.terms);
    return common;
}

} // namespace hapnet::lab::records

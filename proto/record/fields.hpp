// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/record/rows.hpp"

#include <concepts>
#include <type_traits>

namespace hapnet::record {

template <typename R, typename Of>
concept RowOf = std::same_as<std::remove_const_t<R>, Of>;

// The fields of every row, by name, in the order of their bytes. Said once: encoding, decoding,
// the schema in the header and the CSV all follow from it. `visit` takes a name and a field.

template <RowOf<TickRow> R>
constexpr void for_each_field(R& row, auto&& visit)
{
    visit("tick", row.tick);
    visit("due", row.due);
    visit("late", row.late);
    visit("missed_before", row.missed_before);
    visit("sent_sequence", row.sent_sequence);
    visit("phase", row.phase);
    visit("touching", row.touching);
    visit("remote_touching", row.remote_touching);
    visit("remote_fresh", row.remote_fresh);
    visit("hip", row.hip);
    visit("hip_velocity", row.hip_velocity);
    visit("cube", row.cube);
    visit("cube_velocity", row.cube_velocity);
    visit("contact", row.contact);
    visit("device", row.device);
    visit("remote", row.remote);
    visit("gripping", row.gripping);
    visit("docked", row.docked);
    visit("calibrated", row.calibrated);
    visit("buttons", row.buttons);
    visit("fault", row.fault);
    visit("presses", row.presses);
    visit("sample_sequence", row.sample_sequence);
    visit("governor", row.governor);
}

template <RowOf<MessageRow> R>
constexpr void for_each_field(R& row, auto&& visit)
{
    visit("tick", row.tick);
    visit("received_at", row.received_at);
    visit("size", row.size);
    visit("bytes", row.bytes);
}

template <RowOf<SessionRow> R>
constexpr void for_each_field(R& row, auto&& visit)
{
    visit("start", row.start);
    visit("length", row.length);
    visit("remote_offset", row.remote_offset);
    visit("offset_uncertainty", row.offset_uncertainty);
    visit("session", row.session);
    visit("seed", row.seed);
}

/// A row's name in the header, and the byte that it starts with. 0 is no kind, so that a
/// block of zeros, as a file system may leave behind a crash, is not a row.
template <typename R>
struct Kind;
template <>
struct Kind<TickRow> {
    static constexpr std::string_view name = "tick";
    static constexpr std::uint8_t code = 1;
};
template <>
struct Kind<MessageRow> {
    static constexpr std::string_view name = "message";
    static constexpr std::uint8_t code = 2;
};
template <>
struct Kind<SessionRow> {
    static constexpr std::string_view name = "session";
    static constexpr std::uint8_t code = 3;
};

} // namespace hapnet::record

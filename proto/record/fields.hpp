// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/fields.hpp"
#include "proto/record/rows.hpp"

#include <cstdint>
#include <type_traits>

namespace hapnet::record {

// The fields of every row, in the order of their bytes. Encoding, decoding, the schema in the
// header and the CSV all follow from it. docs/formats/record.md says what each means.

constexpr auto fields_of(base::Tag<TickRow>)
{
    return base::fields(
        "tick", base::member("tick", &TickRow::tick), base::member("due", &TickRow::due),
        base::member("late", &TickRow::late),
        base::member("missed_before", &TickRow::missed_before),
        base::member("sent_sequence", &TickRow::sent_sequence),
        base::member("phase", &TickRow::phase), base::member("touching", &TickRow::touching),
        base::member("remote_touching", &TickRow::remote_touching),
        base::member("remote_fresh", &TickRow::remote_fresh), base::member("hip", &TickRow::hip),
        base::member("hip_velocity", &TickRow::hip_velocity), base::member("cube", &TickRow::cube),
        base::member("cube_velocity", &TickRow::cube_velocity),
        base::member("contact", &TickRow::contact), base::member("device", &TickRow::device),
        base::member("remote", &TickRow::remote), base::member("gripping", &TickRow::gripping),
        base::member("docked", &TickRow::docked), base::member("calibrated", &TickRow::calibrated),
        base::member("buttons", &TickRow::buttons), base::member("fault", &TickRow::fault),
        base::member("presses", &TickRow::presses),
        base::member("sample_sequence", &TickRow::sample_sequence),
        base::member("governor", &TickRow::governor));
}

constexpr auto fields_of(base::Tag<MessageRow>)
{
    return base::fields("message", base::member("tick", &MessageRow::tick),
                        base::member("received_at", &MessageRow::received_at),
                        base::member("size", &MessageRow::size),
                        base::member("bytes", &MessageRow::bytes));
}

constexpr auto fields_of(base::Tag<SessionRow>)
{
    return base::fields("session", base::member("start", &SessionRow::start),
                        base::member("length", &SessionRow::length),
                        base::member("remote_offset", &SessionRow::remote_offset),
                        base::member("offset_uncertainty", &SessionRow::offset_uncertainty),
                        base::member("session", &SessionRow::session),
                        base::member("seed", &SessionRow::seed));
}

/// Calls visit(name, field) for every field of a row.
template <typename R>
requires base::Described<std::remove_const_t<R>>
constexpr void for_each_field(R& row, auto&& visit)
{
    base::for_each_field([&](const auto& field, auto& value) { visit(field.key, value); }, row);
}

/// The byte that a row starts with; its name in the header is that of its fields. 0 is no kind, so
/// that a block of zeros, as a file system may leave behind a crash, is not a row.
template <typename R>
inline constexpr std::uint8_t kind_code = 0;
template <>
inline constexpr std::uint8_t kind_code<TickRow> = 1;
template <>
inline constexpr std::uint8_t kind_code<MessageRow> = 2;
template <>
inline constexpr std::uint8_t kind_code<SessionRow> = 3;

} // namespace hapnet::record

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/record/rows.hpp"

#include <cstdint>
#include <type_traits>

namespace hapnet::record {

// The fields of every row, in the order of their bytes. Encoding, decoding, the schema in the
// header and the CSV are derived from these lists. docs/formats/record.md defines the meaning of
// each field.

constexpr auto fields_of(base::Tag<TickRow>)
{
    return base::fields(
        "tick", base::member("tick", &TickRow::tick, "number of the tick"),
        base::member("due", &TickRow::due, "when the loop was to wake"),
        base::member("late", &TickRow::late,
                     "how long after `due` it woke; the row's positions and forces hold at `due + "
                     "late`, when the device was read"),
        base::member("missed_before", &TickRow::missed_before,
                     "ticks skipped between the row before and this one"),
        base::member("sent_sequence", &TickRow::sent_sequence,
                     "sequence of the state message sent in this tick to the first of the others; "
                     "1 is the first of a session, 0: none sent"),
        base::member("phase", &TickRow::phase, "of the session, as this peer sees it"),
        base::member("touching", &TickRow::touching, "whether this hand touches the body"),
        base::member("remote_touching", &TickRow::remote_touching,
                     "whether the other hand touches it"),
        base::member("remote_fresh", &TickRow::remote_fresh,
                     "whether the remote state is young enough to be used"),
        base::member("hip", &TickRow::hip, "position of the hand"),
        base::member("hip_velocity", &TickRow::hip_velocity, "its velocity"),
        base::member("cube", &TickRow::cube, "position of the shared body"),
        base::member("cube_velocity", &TickRow::cube_velocity, "its velocity"),
        base::member("contact", &TickRow::contact,
                     "force of the scene on the hand, before the governor"),
        base::member("device", &TickRow::device,
                     "force that the device was told, after the governor"),
        base::member("remote", &TickRow::remote, "remote contact force as this tick used it"),
        base::member("gripping", &TickRow::gripping, "whether the hand holds the body"),
        base::member("docked", &TickRow::docked, "whether the stylus is in its holder"),
        base::member("calibrated", &TickRow::calibrated,
                     "whether the device's positions have a meaning"),
        base::member("buttons", &TickRow::buttons, "bits of the buttons that are held down"),
        base::member("fault", &TickRow::fault, "of the device"),
        base::member("presses", &TickRow::presses, "presses of the primary button, counted"),
        base::member("sample_sequence", &TickRow::sample_sequence,
                     "lowest bits of a number that grows with every sample of the device"),
        base::member("governor", &TickRow::governor, "its state after this tick"));
}

constexpr auto fields_of(base::Tag<MessageRow>)
{
    return base::fields(
        "message", base::member("tick", &MessageRow::tick, "tick that read it from the socket"),
        base::member("received_at", &MessageRow::received_at, "the kernel's receive stamp"),
        base::member("from", &MessageRow::from,
                     "id of the peer that it came from; 0: not known yet. Not in version 2"),
        base::member("bytes", &MessageRow::bytes,
                     "its length in two bytes, then the message; zeros fill the row"));
}

constexpr auto fields_of(base::Tag<SessionRow>)
{
    return base::fields(
        "session",
        base::member("start", &SessionRow::start, "start of the session on this peer's clock"),
        base::member("length", &SessionRow::length, "of the session"),
        base::member("remote_offset", &SessionRow::remote_offset,
                     "the remote's clock minus this clock"),
        base::member("offset_uncertainty", &SessionRow::offset_uncertainty,
                     "bound of the error of `remote_offset`"),
        base::member("session", &SessionRow::session, "its number, as in the messages"),
        base::member("seed", &SessionRow::seed, "the seed that counts: that of the lowest id"),
        base::member("other", &SessionRow::other, "id of the other; from here on not in version 2"),
        base::member("noted_at", &SessionRow::noted_at, "when `remote_offset` held"),
        base::member("remote_skew_ppm", &SessionRow::remote_skew_ppm,
                     "by how much the remote's clock runs faster, in parts per million"));
}

constexpr auto fields_of(base::Tag<BodyRow>)
{
    return base::fields(
        "body", base::member("tick", &BodyRow::tick, "number of the tick that it belongs to"),
        base::member("body", &BodyRow::body, "its number in the scene, from 0, as in the messages"),
        base::member("position", &BodyRow::position, "of its centre of mass"),
        base::member("velocity", &BodyRow::velocity, "of its centre of mass"),
        base::member("orientation", &BodyRow::orientation,
                     "quaternion w, x, y, z from the body's frame to the scene's; 1, 0, 0, 0 where "
                     "it cannot turn"),
        base::member("angular_velocity", &BodyRow::angular_velocity, "about the axes of the scene"),
        base::member("owner", &BodyRow::owner,
                     "id of the peer whose copy of the body counts, as this peer sees it; 0: not "
                     "known, as before the session. Not in version 4"));
}

/// Calls visit(name, field) for every field of a row.
template <typename R>
requires base::Described<std::remove_const_t<R>>
constexpr void for_each_field(R& row, auto&& visit)
{
    base::for_each_field([&](const auto& field, auto& value) { visit(field.key, value); }, row);
}

/// The first byte of a row, which tells its kind. The header calls the kind by the name in its
/// field description. 0 is not a kind, so that a block of zeros, which a file system may leave
/// after a crash, is not a row.
template <typename R>
inline constexpr std::uint8_t kind_code = 0;
template <>
inline constexpr std::uint8_t kind_code<TickRow> = 1;
template <>
inline constexpr std::uint8_t kind_code<MessageRow> = 2;
template <>
inline constexpr std::uint8_t kind_code<SessionRow> = 3;
template <>
inline constexpr std::uint8_t kind_code<BodyRow> = 4;

} // namespace hapnet::record

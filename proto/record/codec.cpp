// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/codec.hpp"

#include "proto/base/ensure.hpp"
#include "proto/record/field_types.hpp"
#include "proto/record/fields.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>

namespace hapnet::record {

namespace {

template <typename R>
consteval std::size_t used_bytes()
{
    std::size_t bytes = sizeof(kind_code<R>);
    const R row{};
    for_each_field(row,
                   [&]<typename T>(std::string_view, const T&) { bytes += FieldType<T>::bytes; });
    return bytes;
}

static_assert(used_bytes<TickRow>() <= row_bytes);
static_assert(used_bytes<SessionRow>() <= row_bytes);
static_assert(used_bytes<BodyRow>() == body_row_bytes);

/// Calls visit(name, field) for each field of a row that this layout includes.
template <typename R>
void for_each_field_of(const Layout& layout, R& row, const auto& visit)
{
    for_each_field(row, [&]<typename T>(std::string_view name, T& field) {
        if (layout.has_field(name)) visit(name, field);
    });
}

template <typename R>
base::Result<Row> decode_fields(base::ByteReader in, std::size_t size, const Layout& layout)
{
    R row;
    std::string_view refused;
    std::size_t used = sizeof(kind_code<R>);
    for_each_field_of(layout, row, [&]<typename T>(std::string_view name, T& field) {
        if (!FieldType<T>::take(in, field) && refused.empty()) refused = name;
        used += FieldType<T>::bytes;
    });
    if constexpr (std::is_same_v<R, MessageRow>) {
        if (refused == "bytes") return base::fail("a message longer than its row");
        used += row.bytes.size();
    }
    if (!refused.empty()) {
        return base::fail(
            fmt::format("impossible value of '{}' in a {} row", refused, base::described_name<R>));
    }
    const auto padding = in.raw(size - used);
    if (std::ranges::any_of(padding, [](std::byte b) { return b != std::byte{0}; })) {
        return base::fail(fmt::format("padding of a {} row is not zero", base::described_name<R>));
    }
    return row;
}

} // namespace

bool Layout::has_field(std::string_view name) const
{
    constexpr std::array<std::string_view, 4> since_3{"from", "other", "noted_at",
                                                      "remote_skew_ppm"};
    if (version < 3 && std::ranges::find(since_3, name) != since_3.end()) return false;
    return version >= 5 || name != "owner";
}

std::optional<std::size_t> Layout::bytes_of(std::byte kind) const
{
    switch (std::to_integer<std::uint8_t>(kind)) {
    case kind_code<TickRow>:
    case kind_code<SessionRow>: return row_bytes;
    case kind_code<MessageRow>: return message_row_bytes;
    case kind_code<BodyRow>: return has_bodies() ? std::optional{bytes_of_body()} : std::nullopt;
    default: return std::nullopt;
    }
}

RowBytes encode(const Row& row, const Layout& layout)
{
    RowBytes bytes;
    std::visit(
        [&]<typename R>(const R& fields) {
            if constexpr (std::is_same_v<R, MessageRow>)
                base::ensure(fields.bytes.size() <= layout.message_bytes_max());
            const auto size = layout.bytes_of(std::byte{kind_code<R>});
            base::ensure(size.has_value());
            bytes.resize(*size);
            base::ByteWriter out{bytes};
            out.u8(kind_code<R>);
            for_each_field_of(layout, fields, [&]<typename T>(std::string_view, const T& field) {
                FieldType<std::remove_const_t<T>>::put(out, field);
            });
        },
        row);
    return bytes;
}

base::Result<Row> decode(std::span<const std::byte> bytes, const Layout& layout)
{
    if (bytes.empty()) return base::fail("a row of 0 bytes");
    const auto size = layout.bytes_of(bytes.front());
    base::ByteReader in{bytes};
    const std::uint8_t kind = in.u8();
    if (!size) return base::fail(fmt::format("unknown kind of row {}", kind));
    if (bytes.size() != *size)
        return base::fail(fmt::format("a row of {} bytes instead of {}", bytes.size(), *size));
    switch (kind) {
    case kind_code<TickRow>: return decode_fields<TickRow>(in, *size, layout);
    case kind_code<MessageRow>: return decode_fields<MessageRow>(in, *size, layout);
    case kind_code<BodyRow>: return decode_fields<BodyRow>(in, *size, layout);
    default: return decode_fields<SessionRow>(in, *size, layout);
    }
}

} // namespace hapnet::record

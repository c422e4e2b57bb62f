// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/codec.hpp"

#include "proto/base/ensure.hpp"
#include "proto/record/field_types.hpp"
#include "proto/record/fields.hpp"

#include <algorithm>
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
static_assert(used_bytes<MessageRow>() <= row_bytes);
static_assert(used_bytes<SessionRow>() <= row_bytes);

bool is_consistent(const TickRow&) { return true; }
bool is_consistent(const MessageRow& row) { return row.size <= MessageRow::bytes_max; }
bool is_consistent(const SessionRow&) { return true; }

template <typename R>
base::Result<Row> decode_fields(base::ByteReader& in)
{
    R row;
    std::string_view refused;
    for_each_field(row, [&]<typename T>(std::string_view name, T& field) {
        if (!FieldType<T>::take(in, field) && refused.empty()) refused = name;
    });
    if (!refused.empty()) {
        return base::fail(
            fmt::format("impossible value of '{}' in a {} row", refused, base::described_name<R>));
    }
    if (!is_consistent(row)) return base::fail("a message longer than its row");
    const auto padding = in.raw(row_bytes - used_bytes<R>());
    if (std::ranges::any_of(padding, [](std::byte b) { return b != std::byte{0}; })) {
        return base::fail(fmt::format("padding of a {} row is not zero", base::described_name<R>));
    }
    return row;
}

} // namespace

RowBytes encode(const Row& row)
{
    RowBytes bytes{};
    base::ByteWriter out{bytes};
    std::visit(
        [&]<typename R>(const R& fields) {
            base::ensure(is_consistent(fields));
            out.u8(kind_code<R>);
            for_each_field(fields, [&]<typename T>(std::string_view, const T& field) {
                FieldType<T>::put(out, field);
            });
        },
        row);
    return bytes;
}

base::Result<Row> decode(std::span<const std::byte> bytes)
{
    if (bytes.size() != row_bytes) {
        return base::fail(fmt::format("a row of {} bytes instead of {}", bytes.size(), row_bytes));
    }
    base::ByteReader in{bytes};
    switch (const std::uint8_t kind = in.u8()) {
    case kind_code<TickRow>: return decode_fields<TickRow>(in);
    case kind_code<MessageRow>: return decode_fields<MessageRow>(in);
    case kind_code<SessionRow>: return decode_fields<SessionRow>(in);
    default: return base::fail(fmt::format("unknown kind of row {}", kind));
    }
}

} // namespace hapnet::record

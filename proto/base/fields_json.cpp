// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/fields_json.hpp"

#include "proto/base/ensure.hpp"

#include <cmath>
#include <cstdint>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <variant>

namespace hapnet::base {

namespace {

using Json = nlohmann::json;
using Ordered = nlohmann::ordered_json;
using Shape = ValueKind::Shape;

/// Rounds to a number of decimals. A number that is not finite is unchanged.
double rounded(double value, int decimals)
{
    const double scale = std::pow(10.0, decimals);
    const double scaled = std::round(value * scale);
    return std::isfinite(scaled) ? scaled / scale + 0.0 : value; // + 0.0 turns -0 into 0
}

Ordered json_of_number(double number, const JsonScale& scale)
{
    if (!std::isfinite(number)) return {};
    return scale.decimals ? rounded(number, *scale.decimals) : number;
}

Ordered json_of_leaf(const ValueKind& kind, const void* value, const JsonScale& scale)
{
    const Leaf leaf = kind.get(value);
    if (kind.shape == Shape::time) {
        ensure(scale.ns_per_unit > 0.0); // a key names the unit
        const auto ns = static_cast<double>(std::get<std::int64_t>(leaf));
        return json_of_number(ns / scale.ns_per_unit, scale);
    }
    if (const auto* number = std::get_if<double>(&leaf)) return json_of_number(*number, scale);
    return std::visit([](const auto& one) { return Ordered(one); }, leaf);
}

bool is_none(const ValueKind& kind, const void* value)
{
    return kind.size != nullptr && kind.size(value) == 0;
}

std::optional<Leaf> leaf_of(const Json& json)
{
    switch (json.type()) {
    case Json::value_t::boolean: return Leaf{json.get<bool>()};
    case Json::value_t::number_integer: return Leaf{json.get<std::int64_t>()};
    case Json::value_t::number_unsigned: return Leaf{json.get<std::uint64_t>()};
    case Json::value_t::number_float: return Leaf{json.get<double>()};
    case Json::value_t::string: return Leaf{json.get<std::string>()};
    default: return std::nullopt;
    }
}

bool read_list(const ValueKind& kind, const Json& json, void* value)
{
    if (!json.is_array()) return false;
    const bool grows = kind.add != nullptr;
    if (grows) kind.clear(value);
    if (!grows && json.size() != kind.size(value)) return false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        void* const element = grows ? kind.add(value) : kind.at(value, i);
        if (!read_json(*kind.element, json[i], element)) return false;
    }
    return true;
}

bool read_record(const FieldTable& fields, const Json& json, void* value)
{
    if (!json.is_object()) return false;
    for (const FieldRow& row : fields.rows) {
        const auto found = json.find(row.key);
        if (found == json.end() || !read_json(*row.kind, *found, row.in(value))) return false;
    }
    return true;
}

} // namespace

void add_json(Ordered& object, const FieldTable& fields, const void* value, const JsonScale& scale)
{
    for (const FieldRow& row : fields.rows) {
        JsonScale own = scale;
        if (const auto unit = time_unit_of(row.key)) own.ns_per_unit = *unit;
        if (row.telling.decimals) own.decimals = row.telling.decimals;
        own.leaves_out_zeros = row.telling.is_without_zeros;
        row.look(value, [&](const void* member) {
            if (row.telling.is_left_out_if_none && is_none(*row.kind, member)) return;
            object[std::string{row.key}] = json_of(*row.kind, member, own);
        });
    }
}

Ordered json_of(const ValueKind& kind, const void* value, const JsonScale& scale)
{
    switch (kind.shape) {
    case Shape::opaque: break;
    case Shape::maybe:
        return kind.size(value) == 0 ? Ordered{}
                                     : json_of(*kind.element, kind.element_at(value, 0), scale);
    case Shape::list: {
        auto list = Ordered::array();
        for (std::size_t i = 0; i < kind.size(value); ++i) {
            list.push_back(json_of(*kind.element, kind.element_at(value, i), scale));
        }
        return list;
    }
    case Shape::map: {
        auto object = Ordered::object();
        for (std::size_t i = 0; i < kind.size(value); ++i) {
            Ordered element = json_of(*kind.element, kind.element_at(value, i), scale);
            if (scale.leaves_out_zeros && element == 0) continue;
            object[std::string{kind.name_at(value, i)}] = std::move(element);
        }
        return object;
    }
    case Shape::record: {
        auto object = Ordered::object();
        add_json(object, kind.table(), value, scale);
        return object;
    }
    default: return json_of_leaf(kind, value, scale);
    }
    ensure(false); // a value that only its own format knows has no JSON
    return {};
}

bool read_json(const ValueKind& kind, const Json& json, void* value)
{
    switch (kind.shape) {
    case Shape::opaque:
    case Shape::time:
    case Shape::map: return false; // printed only, never read
    case Shape::maybe:
        kind.clear(value);
        return json.is_null() || read_json(*kind.element, json, kind.add(value));
    case Shape::list: return read_list(kind, json, value);
    case Shape::record: return read_record(kind.table(), json, value);
    default: {
        const auto leaf = leaf_of(json);
        return leaf && kind.set(value, *leaf);
    }
    }
}

Result<void> read_json(const FieldTable& fields, const Json& json, const std::string& source,
                       void* value)
{
    if (!json.is_object()) return fail(source + ": expected a JSON object");
    for (const FieldRow& row : fields.rows) {
        const auto found = json.find(row.key);
        if (row.kind->shape == Shape::maybe && found == json.end()) continue;
        if (found == json.end() || !read_json(*row.kind, *found, row.in(value))) {
            return fail(fmt::format("{}: missing or wrong key '{}'", source, row.key));
        }
    }
    return {};
}

} // namespace hapnet::base

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/fields_json.hpp"

#include "proto/base/ensure.hpp"

#include <cmath>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <variant>

namespace hapnet::base {

namespace {

using Json = nlohmann::json;
using Ordered = nlohmann::ordered_json;
using Shape = ValueKind::Shape;

Ordered json_of_leaf(const Leaf& leaf)
{
    const auto* number = std::get_if<double>(&leaf);
    if (number != nullptr && !std::isfinite(*number)) return {};
    return std::visit([](const auto& value) { return Ordered(value); }, leaf);
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

Ordered json_of(const ValueKind& kind, const void* value)
{
    switch (kind.shape) {
    case Shape::opaque: break;
    case Shape::maybe:
        return kind.size(value) == 0 ? Ordered{}
                                     : json_of(*kind.element, kind.element_at(value, 0));
    case Shape::list: {
        auto list = Ordered::array();
        for (std::size_t i = 0; i < kind.size(value); ++i) {
            list.push_back(json_of(*kind.element, kind.element_at(value, i)));
        }
        return list;
    }
    case Shape::record: {
        auto object = Ordered::object();
        for (const FieldRow& row : kind.table().rows) {
            object[std::string{row.key}] = json_of(*row.kind, row.in(value));
        }
        return object;
    }
    default: return json_of_leaf(kind.get(value));
    }
    ensure(false); // a value that only its own format knows has no JSON
    return {};
}

bool read_json(const ValueKind& kind, const Json& json, void* value)
{
    switch (kind.shape) {
    case Shape::opaque: return false;
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

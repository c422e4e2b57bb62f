// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/output/schema.hpp"

#include "proto/base/ensure.hpp"
#include "proto/output/plain.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace hapnet::output {

namespace {

using Json = nlohmann::ordered_json;
using Shape = base::ValueKind::Shape;

/// Collects the definitions of the structs that a struct contains.
class Definitions {
public:
    /// Returns the schema of a struct's keys, without a header.
    Json object_of(const base::FieldTable& fields)
    {
        Json properties = Json::object();
        Json required = Json::array();
        for (const base::FieldRow& row : fields.rows) {
            // The value of a field that is left out if it has no value is never null.
            const bool is_optional = row.telling.is_left_out_if_none;
            Json property = value_of(is_optional ? row.kind->plain() : *row.kind);
            if (!row.about.empty()) property["description"] = plain(row.about);
            if (row.telling.is_without_zeros) property.erase("required");
            properties[std::string{row.key}] = std::move(property);
            if (!is_optional) required.push_back(std::string{row.key});
        }
        return {{"type", "object"}, {"properties", properties}, {"required", required}};
    }

    [[nodiscard]] const Json& all() const { return all_; }

private:
    Json value_of(const base::ValueKind& kind)
    {
        switch (kind.shape) {
        case Shape::opaque: base::ensure(false); return {};
        case Shape::flag: return {{"type", "boolean"}};
        case Shape::whole: {
            Json whole{{"type", "integer"}};
            if (!kind.is_signed) whole["minimum"] = 0;
            return whole;
        }
        // A number that is not finite becomes null.
        case Shape::number: return {{"type", Json::array({"number", "null"})}};
        case Shape::time: return {{"type", "number"}};
        case Shape::text: return {{"type", "string"}};
        case Shape::choice: {
            Json names = Json::array();
            for (const std::string_view name : kind.names) names.push_back(std::string{name});
            return {{"enum", names}};
        }
        case Shape::maybe: return or_null(value_of(*kind.element));
        case Shape::list: {
            Json list{{"type", "array"}, {"items", value_of(*kind.element)}};
            if (kind.length > 0)
                list.update({{"minItems", kind.length}, {"maxItems", kind.length}});
            return list;
        }
        case Shape::map: return map_of(kind);
        case Shape::record: return reference_to(kind.table());
        }
        return {};
    }

    Json map_of(const base::ValueKind& kind)
    {
        const Json element = value_of(*kind.element);
        if (kind.names.empty()) return {{"type", "object"}, {"additionalProperties", element}};
        Json properties = Json::object();
        Json required = Json::array();
        for (const std::string_view name : kind.names) {
            properties[std::string{name}] = element;
            required.push_back(std::string{name});
        }
        return {{"type", "object"}, {"properties", properties}, {"required", required}};
    }

    static Json or_null(Json schema)
    {
        if (schema.contains("type") && schema.at("type").is_string()) {
            schema["type"] = Json::array({schema.at("type"), "null"});
            return schema;
        }
        if (schema.contains("type")) return schema; // a list, which contains null already
        return {{"anyOf", Json::array({std::move(schema), Json{{"type", "null"}}})}};
    }

    Json reference_to(const base::FieldTable& fields)
    {
        std::string name{fields.name};
        std::ranges::replace(name, ' ', '_'); // the name is part of an address
        base::ensure(!name.empty());
        const auto [known, is_new] = owners_.emplace(name, &fields);
        base::ensure(known->second == &fields); // fails if two structs have one name
        if (is_new) {
            all_[name]; // placed before the structs that it refers to
            all_[name] = object_of(fields);
        }
        return {{"$ref", "#/$defs/" + name}};
    }

    std::map<std::string, const base::FieldTable*> owners_;
    Json all_ = Json::object();
};

} // namespace

Json schema_of(const base::FieldTable& fields, std::string_view title)
{
    Definitions definitions;
    const Json object = definitions.object_of(fields);
    Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                {"$comment", "SPDX-FileCopyrightText: 2026 The Hapnet authors; "
                             "SPDX-License-Identifier: MIT"},
                {"title", std::string{title}}};
    schema.update(object);
    if (!definitions.all().empty()) schema["$defs"] = definitions.all();
    return schema;
}

} // namespace hapnet::output

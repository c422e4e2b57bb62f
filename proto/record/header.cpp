// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/header.hpp"

#include "proto/record/codec.hpp"
#include "proto/record/field_types.hpp"
#include "proto/record/fields.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::record {

namespace {

constexpr int version = 2;

template <typename R>
nlohmann::json schema_of()
{
    std::size_t offset = sizeof(kind_code<R>);
    auto fields = nlohmann::json::array();
    const R row{};
    for_each_field(row, [&]<typename T>(std::string_view name, const T&) {
        nlohmann::json field{{"name", name}, {"type", FieldType<T>::type}, {"offset", offset}};
        if (!FieldType<T>::unit.empty()) field["unit"] = FieldType<T>::unit;
        if constexpr (std::same_as<T, Phase>) field["values"] = base::names_of_enum<Phase>;
        fields.push_back(std::move(field));
        offset += FieldType<T>::bytes;
    });
    return {{"kind", unsigned{kind_code<R>}}, {"fields", std::move(fields)}};
}

/// All of the header that is the same in every record of this format.
nlohmann::json layout()
{
    return {{"format", "hapnet-record"},
            {"version", version},
            {"row_bytes", row_bytes},
            {"byte_order", "little"},
            {"schema",
             {{base::described_name<TickRow>, schema_of<TickRow>()},
              {base::described_name<MessageRow>, schema_of<MessageRow>()},
              {base::described_name<SessionRow>, schema_of<SessionRow>()}}}};
}

/// What decides how rows are read: a unit is for people, and its words may become better.
nlohmann::json without_units(nlohmann::json schema)
{
    for (auto& row : schema) {
        if (!row.is_object() || !row.contains("fields")) continue;
        for (auto& field : row["fields"])
            if (field.is_object()) field.erase("unit");
    }
    return schema;
}

} // namespace

std::string header_line(const nlohmann::json& config)
{
    const auto ours = layout();
    nlohmann::ordered_json header; // the format stands first, for whoever looks into the file
    for (const char* key : {"format", "version", "row_bytes", "byte_order", "schema"}) {
        header[key] = ours[key];
    }
    header["config"] = config;
    // Text from the command line may be no UTF-8: better a replaced letter than no record.
    return header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

base::Result<nlohmann::json> parse_header(std::string_view line)
{
    const auto header = nlohmann::json::parse(line, nullptr, false);
    const auto ours = layout();
    const bool is_record =
        header.is_object() && header.value("format", nlohmann::json{}) == ours["format"];
    const auto found = is_record ? header.value("version", nlohmann::json{}) : nlohmann::json{};
    if (found.is_number_integer() && found != version) {
        return base::fail(fmt::format("it is of version {}, and this program reads version {}: use "
                                      "the hapnet-lab of the release that wrote it",
                                      found.dump(), version));
    }
    for (const char* key : {"format", "version", "row_bytes", "byte_order"}) {
        if (!header.is_object() || !header.contains(key) || header[key] != ours[key]) {
            return base::fail(
                fmt::format("expected a JSON line with \"{}\":{}", key, ours[key].dump()));
        }
    }
    if (!header.contains("schema") ||
        without_units(header["schema"]) != without_units(ours["schema"])) {
        return base::fail(fmt::format("its schema is not that of version {}", version));
    }
    if (!header.contains("config") || !header["config"].is_object()) {
        return base::fail("expected an object \"config\" in its header");
    }
    return header["config"];
}

} // namespace hapnet::record

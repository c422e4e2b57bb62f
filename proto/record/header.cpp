// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/record/header.hpp"

#include "proto/record/codec.hpp"
#include "proto/record/field_types.hpp"
#include "proto/record/fields.hpp"

#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::record {

namespace {

template <typename R>
nlohmann::json schema_of(const Layout& layout)
{
    std::size_t offset = sizeof(kind_code<R>);
    auto fields = nlohmann::json::array();
    const R row{};
    for_each_field(row, [&]<typename T>(std::string_view name, const T&) {
        if (!layout.has_field(name)) return;
        nlohmann::json field{{"name", name}, {"type", FieldType<T>::type}, {"offset", offset}};
        if (!FieldType<T>::unit.empty()) field["unit"] = FieldType<T>::unit;
        if constexpr (std::same_as<T, Phase>) field["values"] = base::names_of_enum<Phase>;
        fields.push_back(std::move(field));
        offset += FieldType<T>::bytes;
    });
    return {{"kind", unsigned{kind_code<R>}}, {"fields", std::move(fields)}};
}

/// Returns the part of the header that is the same in every record of this layout.
nlohmann::json description_of(const Layout& layout)
{
    nlohmann::json description{
        {"format", "hapnet-record"},
        {"version", layout.version},
        {"row_bytes", row_bytes},
        {"message_row_bytes", layout.message_row_bytes},
        {"byte_order", "little"},
        {"schema",
         {{base::described_name<TickRow>, schema_of<TickRow>(layout)},
          {base::described_name<MessageRow>, schema_of<MessageRow>(layout)},
          {base::described_name<SessionRow>, schema_of<SessionRow>(layout)}}}};
    if (layout.has_bodies()) {
        description["body_row_bytes"] = layout.bytes_of_body();
        description["schema"][base::described_name<BodyRow>] = schema_of<BodyRow>(layout);
    }
    return description;
}

/// Returns the part of a schema that determines how rows are read. Units are for people, and their
/// text may change.
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

std::string header_line(const nlohmann::json& config, const Layout& layout)
{
    const auto ours = description_of(layout);
    nlohmann::ordered_json header; // the format stands first, for whoever looks into the file
    for (const char* key : {"format", "version", "row_bytes", "message_row_bytes", "body_row_bytes",
                            "byte_order", "schema"}) {
        if (ours.contains(key)) header[key] = ours[key];
    }
    header["config"] = config;
    // Text from the command line may not be UTF-8. A replaced character is better than no record.
    return header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

base::Result<Header> parse_header(std::string_view line)
{
    const auto header = nlohmann::json::parse(line, nullptr, false);
    auto layout = Layout::for_messages_of(MessageRow::bytes_max);
    const auto found = [&header](const char* key) {
        return header.is_object() ? header.value(key, nlohmann::json{}) : nlohmann::json{};
    };
    const bool is_record = found("format") == "hapnet-record";
    if (const auto version = found("version"); is_record && version.is_number_integer()) {
        if (version < Layout::version_min || version > Layout::version_max) {
            return base::fail(fmt::format("it is of version {}, and this program reads versions {} "
                                          "to {}: use the hapnet-lab of the release that wrote it",
                                          version.dump(), Layout::version_min,
                                          Layout::version_max));
        }
        if (version == 2) layout = Layout::of_version_2();
        if (version == 4) layout = Layout::of_version_4();
        if (version == 5) layout = layout.with_bodies();
    }
    if (const auto bytes = found("message_row_bytes"); bytes.is_number_unsigned()) {
        const auto most = layout.message_row_bytes;
        if (bytes < message_head_bytes || bytes > most)
            return base::fail(fmt::format("\"message_row_bytes\" is not from {} to {}",
                                          message_head_bytes, most));
        layout.message_row_bytes = bytes.get<std::size_t>();
    }
    const auto ours = description_of(layout);
    std::vector<const char*> keys{"format", "version", "row_bytes", "byte_order"};
    if (layout.version > 2) keys.push_back("message_row_bytes");
    if (layout.has_bodies()) keys.push_back("body_row_bytes");
    for (const char* key : keys) {
        if (found(key) != ours[key]) {
            return base::fail(
                fmt::format("expected a JSON line with \"{}\":{}", key, ours[key].dump()));
        }
    }
    if (layout.version > 2 && without_units(found("schema")) != without_units(ours["schema"]))
        return base::fail(fmt::format("its schema is not that of version {}", layout.version));
    if (!found("config").is_object())
        return base::fail("expected an object \"config\" in its header");
    return Header{header["config"], layout};
}

} // namespace hapnet::record

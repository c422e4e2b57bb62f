// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hapnet::web {

// Readers of members of the JSON that pages and daemons send. A member may be missing or of another
// type.

/// Returns a text member; "" if there is none.
[[nodiscard]] inline std::string text_member(const nlohmann::ordered_json& json, const char* key)
{
    const auto found = json.is_object() ? json.find(key) : json.end();
    return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Returns the generation of the conditions; 0 if there is none.
[[nodiscard]] inline std::uint64_t generation_in(const nlohmann::ordered_json& reply)
{
    const auto found = reply.find("generation");
    return found != reply.end() && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

/// Returns the number of characters of a text in UTF-8.
[[nodiscard]] inline std::size_t characters_in(std::string_view text)
{
    return static_cast<std::size_t>(std::ranges::count_if(
        text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

} // namespace hapnet::web

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/visible.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <spdlog/fmt/fmt.h>

namespace hapnet::base {

namespace {

struct Character {
    std::uint32_t code = 0;
    std::size_t bytes = 0; // 0: not UTF-8
};

/// Returns the first character of a text, which must not be empty (RFC 3629).
Character first_of(std::string_view text)
{
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = at(0);
    if (lead < 0x80) return {lead, 1};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || text.size() < bytes) return {};
    std::uint32_t code = lead & (0x7fU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((at(i) & 0xc0U) != 0x80U) return {};
        code = code << 6 | (at(i) & 0x3fU);
    }
    constexpr std::array<std::uint32_t, 3> least{0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < least.at(bytes - 2) || code > 0x10ffff || is_surrogate) return {};
    return {code, bytes};
}

/// True for a character that moves the cursor or, as Unicode's bidirectional controls do (UAX #9),
/// changes the order in which a terminal shows the others.
bool is_control(std::uint32_t code)
{
    const bool is_of_direction = code == 0x061c || code == 0x200e || code == 0x200f ||
                                 (code >= 0x202a && code <= 0x202e) ||
                                 (code >= 0x2066 && code <= 0x2069);
    return code < 0x20 || (code >= 0x7f && code < 0xa0) || is_of_direction;
}

std::string visible_but(std::string_view kept, std::string_view text)
{
    const bool is_plain = std::ranges::all_of(
        text, [](char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\t'; });
    if (is_plain && !kept.empty()) return std::string{text}; // fast path for millions of plain rows
    std::string out;
    while (!text.empty()) {
        const Character character = first_of(text);
        if (character.bytes == 0) {
            out += fmt::format("\\x{:02X}", static_cast<unsigned char>(text.front()));
            text.remove_prefix(1);
            continue;
        }
        const bool is_kept = kept.find(text.front()) != std::string_view::npos;
        if (is_control(character.code) && !is_kept) {
            out += fmt::format("\\u{:04X}", character.code);
        } else {
            out += text.substr(0, character.bytes);
        }
        text.remove_prefix(character.bytes);
    }
    return out;
}

} // namespace

std::string visible(std::string_view text) { return visible_but("", text); }
std::string visible_lines(std::string_view text) { return visible_but("\n\t", text); }

} // namespace hapnet::base

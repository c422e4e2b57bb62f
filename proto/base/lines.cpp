// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/lines.hpp"

#include "proto/base/visible.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::base {

namespace {

constexpr std::string_view blanks = " \t\r\f\v";

/// A compressed format, recognised by its first bytes.
struct Packing {
    std::string_view begins_with;
    std::string_view name;
    std::string_view cure;
};
constexpr std::array<Packing, 6> packings{{{"\x1f\x8b", "gzip", "gunzip -k"},
                                           {"BZh", "bzip2", "bunzip2 -k"},
                                           {"\xfd"
                                            "7zXZ",
                                            "xz", "unxz -k"},
                                           {"\x28\xb5\x2f\xfd", "zstd", "unzstd"},
                                           {"\x04\x22\x4d\x18", "lz4", "unlz4"},
                                           {"PK\x03\x04", "zip", "unzip"}}};

void append_utf8(std::string& text, std::uint32_t code)
{
    const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
    if (code < 0x80) return add(code);
    if (code < 0x800) {
        add(0xc0U | code >> 6U);
    } else if (code < 0x10000) {
        add(0xe0U | code >> 12U);
        add(0x80U | (code >> 6U & 0x3fU));
    } else {
        add(0xf0U | code >> 18U);
        add(0x80U | (code >> 12U & 0x3fU));
        add(0x80U | (code >> 6U & 0x3fU));
    }
    add(0x80U | (code & 0x3fU));
}

/// Converts UTF-16 to UTF-8 (RFC 2781). An unpaired surrogate becomes the replacement character.
std::string from_utf16(std::string_view bytes, bool is_big_endian)
{
    const auto unit = [&](std::size_t i) {
        const auto at = [&](std::size_t place) {
            return std::uint32_t{static_cast<unsigned char>(bytes[place])};
        };
        return is_big_endian ? at(i) << 8U | at(i + 1) : at(i + 1) << 8U | at(i);
    };
    constexpr std::uint32_t replacement = 0xfffd;
    std::string text;
    text.reserve(bytes.size() / 2);
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        std::uint32_t code = unit(i);
        const bool is_high = code >= 0xd800 && code < 0xdc00;
        if (is_high && i + 3 < bytes.size() && unit(i + 2) >= 0xdc00 && unit(i + 2) < 0xe000) {
            code = 0x10000 + ((code - 0xd800) << 10U) + (unit(i + 2) - 0xdc00);
            i += 2;
        } else if (code >= 0xd800 && code < 0xe000) {
            code = replacement;
        }
        append_utf8(text, code);
    }
    return text;
}

} // namespace

Result<std::string> plain_text(std::string bytes)
{
    const std::string_view text = bytes;
    for (const Packing& packing : packings) {
        if (!text.starts_with(packing.begins_with)) continue;
        return fail(fmt::format("the file is compressed ({}): unpack it first, for example "
                                "with {}",
                                packing.name, packing.cure));
    }
    if (text.starts_with("\xff\xfe")) return from_utf16(text.substr(2), false);
    if (text.starts_with("\xfe\xff")) return from_utf16(text.substr(2), true);
    return bytes;
}

Result<std::string> open_measured(const Reading& reading, const std::string& file)
{
    auto bytes = reading.open(file);
    if (!bytes) return bytes;
    auto text = plain_text(*std::move(bytes));
    if (!text) return tl::unexpected{reading.trouble_in(file, text.error().message)};
    return text;
}

LineReader::LineReader(std::string_view text) : rest_{text}
{
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
}

/// Advances to the next line with content, so that the rest of the text begins with it.
bool LineReader::find_next()
{
    skipped_empty_ = 0;
    while (!rest_.empty()) {
        const auto end = std::min(rest_.find('\n'), rest_.size());
        const auto first = std::min(rest_.find_first_not_of(blanks), end);
        ++number_;
        begun_ = number_;
        if (first < end && rest_[first] != '#') return true;
        if (first == end) ++skipped_empty_;
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
    }
    return false;
}

std::optional<std::string_view> LineReader::next()
{
    if (!find_next()) return std::nullopt;
    const auto end = rest_.find('\n');
    const auto line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    return line;
}

Result<std::optional<std::span<const std::string_view>>> LineReader::next_cells(Cells& cells)
{
    if (!find_next()) return std::nullopt;
    if (!cells.take_line(rest_)) {
        return fail("a quote is open or stands inside a cell: write \"\" for a quote in quotes");
    }
    number_ += cells.lines() - 1;
    return std::optional{cells.all()};
}

std::size_t LineReader::number() const { return std::max<std::size_t>(begun_, 1); }

tl::unexpected<Error> LineReader::fail(std::string_view why) const
{
    return hapnet::base::fail(fmt::format("line {}: {}", number(), why));
}

std::size_t line_number_at(std::string_view text, std::size_t place)
{
    const auto before = text.substr(0, place);
    return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::string_view trimmed(std::string_view text)
{
    text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::string shortened(std::string_view text)
{
    constexpr std::size_t most = 40;
    std::size_t bytes = std::min(text.size(), most);
    const auto continues = [&](std::size_t i) {
        return (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U;
    };
    while (bytes > 0 && bytes < text.size() && continues(bytes)) --bytes;
    auto out = visible(text.substr(0, bytes));
    if (text.size() > bytes) out += "...";
    return out;
}

} // namespace hapnet::base

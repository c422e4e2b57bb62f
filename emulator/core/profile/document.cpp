// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/profile/document.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <optional>
#include <spdlog/fmt/fmt.h>

// The shared library is built with exceptions; here a wrong text is a value.
#undef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 1
#undef TOML_SHARED_LIB
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#define TOML_MAX_NESTED_VALUES 16
// Version 3.3 asserts, and in a release even assumes, what a text need not keep to ("[@"); the code
// behind it finds the error all the same. Without both, that is what happens.
#undef NDEBUG
#define TOML_ASSERT(condition) static_assert(true)
#include <toml++/toml.h>

namespace hapnet::emulator {

namespace {

Place place_of(const toml::source_region& region)
{
    return {region.begin.line, region.begin.column};
}

/// Finds what the library would not survive: a key of so many parts that the tables in each other
/// exhaust the stack, as its own bound counts values only; and letters beyond ASCII outside of
/// strings, which are an error anyway, but some of which lead version 3.3 where it believes that it
/// cannot come. Strings over several lines are not for profiles; without them, a line can be read
/// on its own.
class TextCheck {
public:
    [[nodiscard]] std::optional<DocumentError> run(std::string_view text)
    {
        for (const char c : text) {
            if (auto error = step(c)) return error;
        }
        return std::nullopt;
    }

private:
    static constexpr std::uint32_t dots_max = 256; // those of a line, outside of strings

    [[nodiscard]] std::optional<DocumentError> step(char c)
    {
        ++place_.column;
        if (c == '\n') {
            place_ = {place_.line + 1, 0};
            dots_ = 0;
            quote_ = '\0';
            is_escaped_ = false;
        } else if (quote_ == '#') {
            return std::nullopt;
        } else if (quote_ != '\0') {
            step_in_string(c);
        } else if (c == '"' || c == '\'' || c == '#') {
            if (c != '#' && c == last_closed_) {
                return DocumentError{place_, "a string over several lines has no place here"};
            }
            quote_ = c;
        } else if (static_cast<unsigned char>(c) >= 0x80) {
            return DocumentError{place_, "a letter that may only stand in quotes"};
        } else if (c == '.' && ++dots_ > dots_max) {
            return DocumentError{place_, fmt::format("more than {} dots in a line", dots_max)};
        }
        if (quote_ != '\0' || (c != '"' && c != '\'')) last_closed_ = '\0';
        return std::nullopt;
    }

    void step_in_string(char c)
    {
        if (is_escaped_) {
            is_escaped_ = false;
        } else if (quote_ == '"' && c == '\\') {
            is_escaped_ = true;
        } else if (c == quote_) {
            last_closed_ = c;
            quote_ = '\0';
        }
    }

    Place place_{1, 0};
    std::uint32_t dots_ = 0;
    char quote_ = '\0'; // which string we are in; '#': a comment
    char last_closed_ = '\0';
    bool is_escaped_ = false;
};

tl::expected<Node, DocumentError> convert(const toml::node& node);

tl::expected<Node, DocumentError> convert_list(const toml::array& array)
{
    Node::List list;
    for (const toml::node& element : array) {
        auto value = convert(element);
        if (!value) return value;
        list.push_back(*std::move(value));
    }
    return Node{place_of(array.source()), std::move(list)};
}

tl::expected<Node, DocumentError> convert_table(const toml::table& table)
{
    Node::Table entries;
    for (const auto& [key, element] : table) {
        auto value = convert(element);
        if (!value) return value;
        entries.push_back({std::string{key.str()}, place_of(key.source()), *std::move(value)});
    }
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return std::pair{a.place.line, a.place.column} < std::pair{b.place.line, b.place.column};
    });
    return Node{place_of(table.source()), std::move(entries)};
}

tl::expected<Node, DocumentError> convert(const toml::node& node)
{
    const Place place = place_of(node.source());
    if (const auto* table = node.as_table()) return convert_table(*table);
    if (const auto* array = node.as_array()) return convert_list(*array);
    if (const auto* text = node.as_string()) return Node{place, text->get()};
    if (const auto* integer = node.as_integer()) return Node{place, integer->get()};
    if (const auto* real = node.as_floating_point()) return Node{place, real->get()};
    if (const auto* boolean = node.as_boolean()) return Node{place, boolean->get()};
    return tl::unexpected{DocumentError{place, "a date or a time of day has no place here; a "
                                               "duration is written as a string: \"10s\""}};
}

} // namespace

tl::expected<Node, DocumentError> parse_document(std::string_view text)
{
    if (text.size() > document_bytes_max) {
        return tl::unexpected{DocumentError{{}, "longer than 1 MiB"}};
    }
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    if (auto error = TextCheck{}.run(text)) return tl::unexpected{*std::move(error)};
    const toml::parse_result parsed = toml::parse(text);
    if (!parsed) {
        return tl::unexpected{DocumentError{place_of(parsed.error().source()),
                                            std::string{parsed.error().description()}}};
    }
    return convert(parsed.table());
}

} // namespace hapnet::emulator

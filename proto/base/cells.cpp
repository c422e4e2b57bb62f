// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/cells.hpp"

#include <algorithm>

namespace hapnet::base {

namespace {

constexpr char by_blanks = ' ';

bool is_at_line_end(std::string_view text) { return text.empty() || text.front() == '\n'; }

} // namespace

bool Cells::is_blank(char c) const
{
    const bool is_any = c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
    return is_any && c != style_.separator;
}

bool Cells::ends_cell(char c) const
{
    if (c == '\n' || c == style_.separator) return true;
    return style_.separator == by_blanks && is_blank(c);
}

void Cells::skip_blanks(std::string_view& text) const
{
    if (!style_.trims_blanks && style_.separator != by_blanks) return;
    const auto is_skipped = [&](char c) {
        return is_blank(c) || (c == by_blanks && style_.separator == by_blanks);
    };
    const auto first = std::ranges::find_if_not(text, is_skipped);
    text.remove_prefix(static_cast<std::size_t>(first - text.begin()));
}

/// Takes a cell that begins with a quote.
bool Cells::take_quoted(std::string_view& text)
{
    std::string_view inner = text.substr(1);
    std::size_t length = 0;
    bool has_doubled = false;
    for (;; ++length) {
        if (length == inner.size()) return false;
        if (inner[length] == '\n') ++lines_;
        if (inner[length] != '"') continue;
        if (length + 1 == inner.size() || inner[length + 1] != '"') break;
        has_doubled = true;
        ++length;
    }
    text = inner.substr(length + 1);
    if (text.starts_with("\r\n") || text == "\r") text.remove_prefix(1);
    const auto cell = inner.substr(0, length);
    if (!has_doubled) {
        cells_.push_back(cell);
        return true;
    }
    std::string& plain = unescaped_.emplace_back();
    for (std::size_t i = 0; i < cell.size(); ++i) {
        plain += cell[i];
        if (cell[i] == '"') ++i;
    }
    cells_.push_back(plain);
    return true;
}

void Cells::take_plain(std::string_view& text)
{
    const auto end = std::ranges::find_if(text, [&](char c) { return ends_cell(c); });
    const auto length = static_cast<std::size_t>(end - text.begin());
    auto cell = text.substr(0, length);
    text.remove_prefix(length);
    const bool is_trimmed = style_.trims_blanks;
    while (is_trimmed && !cell.empty() && is_blank(cell.back())) cell.remove_suffix(1);
    if (is_at_line_end(text) && cell.ends_with('\r')) cell.remove_suffix(1);
    cells_.push_back(cell);
}

bool Cells::take_line(std::string_view& text)
{
    cells_.clear();
    unescaped_.clear();
    lines_ = 1;
    for (;;) {
        skip_blanks(text);
        if (text.starts_with('"')) {
            if (!take_quoted(text)) return false;
        } else {
            take_plain(text);
        }
        if (style_.separator != by_blanks && !text.empty() && text.front() == style_.separator) {
            text.remove_prefix(1);
            continue;
        }
        const auto before = text.size();
        skip_blanks(text);
        if (is_at_line_end(text)) break;
        const bool is_separated = text.front() == style_.separator;
        if (is_separated) text.remove_prefix(1);
        const bool is_next = style_.separator == by_blanks ? text.size() < before : is_separated;
        if (!is_next) return false;
    }
    if (!text.empty()) text.remove_prefix(1);
    return true;
}

} // namespace hapnet::base

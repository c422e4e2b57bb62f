// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/monitor/held_rows.hpp"

#include <algorithm>
#include <map>
#include <string_view>
#include <variant>

namespace hapnet::peer::monitor {

namespace {

std::string text_of(const record::Row& row, const record::Layout& layout)
{
    const record::RowBytes bytes = record::encode(row, layout);
    std::string text(bytes.size(), '\0');
    std::ranges::transform(bytes, text.begin(), [](std::byte b) { return static_cast<char>(b); });
    return text;
}

} // namespace

HeldRows::HeldRows(base::Duration span, const record::Layout& layout)
    : layout_{layout}, rows_{span, bytes_max}
{}

void HeldRows::add(const record::Row& row)
{
    if (const auto* tick = std::get_if<record::TickRow>(&row)) {
        now_ = std::max(now_, tick->due);
    } else if (const auto* message = std::get_if<record::MessageRow>(&row)) {
        now_ = std::max(now_, message->received_at);
    } else if (const auto* session = std::get_if<record::SessionRow>(&row)) {
        if (terms_.size() >= terms_max) terms_.pop_front();
        terms_.push_back({now_, *session});
    }
    rows_.add(now_, text_of(row, layout_));
}

std::string HeldRows::since(base::TimePoint from) const
{
    std::map<std::uint16_t, const record::SessionRow*> before;
    for (const auto& [at, row] : terms_) {
        if (at < from) before[row.other] = &row;
    }
    std::string text;
    for (const auto& [other, row] : before) text += text_of(*row, layout_);
    return text + rows_.since(from);
}

} // namespace hapnet::peer::monitor

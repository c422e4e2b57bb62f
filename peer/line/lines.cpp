// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/line/lines.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <utility>

namespace hapnet::peer::line {

Lines::Lines(std::vector<Line> lines) : lines_{std::move(lines)} { base::ensure(!lines_.empty()); }

std::optional<Lines::Opened> Lines::open(std::span<const std::byte> datagram,
                                         const secure::Place& from, base::TimePoint now)
{
    const auto open_by = [&](std::size_t line) -> std::optional<Opened> {
        const auto message = lines_[line].open(datagram, from, now);
        return message ? std::optional{Opened{line, *message}} : std::nullopt;
    };
    if (lines_.size() == 1) return open_by(0);
    // In rare cases two lines have drawn the same number for a key. Then both try.
    bool is_named = false;
    for (std::size_t line = 0; line < lines_.size(); ++line) {
        if (!lines_[line].is_named_by(datagram)) continue;
        if (const auto opened = open_by(line)) return opened;
        is_named = true;
    }
    if (is_named) return std::nullopt;
    const auto from_there =
        std::ranges::find_if(lines_, [&from](const Line& line) { return line.leads_to(from); });
    // A datagram for no line is counted by the first line.
    return open_by(
        from_there == lines_.end() ? 0 : static_cast<std::size_t>(from_there - lines_.begin()));
}

void Lines::tick(secure::Moment moment)
{
    lines_[next_].tick(moment);
    next_ = (next_ + 1) % lines_.size();
}

} // namespace hapnet::peer::line

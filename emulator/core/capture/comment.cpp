// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/core/capture/pcapng.hpp"

#include <algorithm>
#include <iterator>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

base::Duration::rep microseconds(base::Duration time) { return (time.count() + 500) / 1000; }

void append_delay(std::string& text, base::Duration delay)
{
    auto out = std::back_inserter(text);
    if (const auto us = microseconds(delay); us > 0 && us < 1000) {
        fmt::format_to(out, "delayed {} us", us);
    } else {
        const auto tenths = (us + 50) / 100;
        fmt::format_to(out, "delayed {}.{} ms", tenths / 10, tenths % 10);
    }
}

} // namespace

void append_arrival_comment(std::string& text, const Fate& fate)
{
    if (const auto* drop = std::get_if<Drop>(&fate.verdict)) {
        text += "dropped: ";
        const auto start = static_cast<std::ptrdiff_t>(text.size());
        text += to_text(drop->cause);
        std::replace(text.begin() + start, text.end(), '_', '-');
        return;
    }
    const auto& deliver = std::get<Deliver>(fate.verdict);
    append_delay(text, deliver.after);
    if (deliver.copy) text += ", copied";
    if (const int bits = deliver.flips.count; bits > 0) {
        fmt::format_to(std::back_inserter(text), ", {} bit{} corrupted", bits, bits > 1 ? "s" : "");
    }
    if (deliver.displacement != Displacement{}) text += ", displaced";
}

void append_departure_comment(std::string& text, base::Duration late, bool is_copy)
{
    fmt::format_to(std::back_inserter(text), "late {} us{}", microseconds(late),
                   is_copy ? ", copy" : "");
}

} // namespace hapnet::emulator

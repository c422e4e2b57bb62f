// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/direction_words.hpp"

#include "proto/output/told.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

double in_us(base::Duration duration) { return base::to_nanoseconds(duration) / 1e3; }

/// Returns "160.00 ms (sd 2.89)".
std::string delay_in_words(const base::Moments& moments)
{
    const auto in_ms = [](base::Duration duration) { return 1e3 * base::to_seconds(duration); };
    return fmt::format("{:.2f} ms (sd {:.2f})", in_ms(moments.mean),
                       in_ms(moments.sd.value_or(base::Duration{0})));
}

/// Returns a sentence on whether the emulator did what it was asked to, and nothing else.
std::string verdict_in_words(const DirectionReport& report)
{
    const auto reasons = report.reasons();
    if (reasons.empty()) return "valid";
    // With fewer datagrams, p99 is the lateness of the latest one.
    constexpr std::uint64_t few = 100;
    const bool are_few = report.statistics->lateness.count() < few;
    const bool are_late = !report.statistics->is_punctual(report.budget);
    return fmt::format("NOT VALID: {}{}", fmt::join(reasons, "; "),
                       are_few && are_late ? "; p99 of so few datagrams is the latest of them"
                                           : "");
}

} // namespace

std::string in_words(std::string_view title, const DirectionReport& report)
{
    const Statistics& s = *report.statistics;
    std::string text = fmt::format("{}: {}", title, output::told(report));
    if (const auto late = s.lateness.quantiles()) {
        text += fmt::format("; lateness {:.0f} us median, {:.0f} us p99, {:.0f} us at most: {}",
                            in_us(late->p50), in_us(late->p99), in_us(late->max),
                            verdict_in_words(report));
    } else if (!report.reasons().empty()) {
        text += ": " + verdict_in_words(report);
    }
    if (const auto lens = report.lens()) {
        const StreamReport& measured = lens->measured;
        if (measured.requested_delay && measured.delay) {
            text += fmt::format("; delay {} as drawn, {} as it came out",
                                delay_in_words(*measured.requested_delay),
                                delay_in_words(*measured.delay));
        }
    }
    if (report.unreachable > 0) {
        text += fmt::format("; {} answers that no program listens: start it, or name the address "
                            "at which it listens",
                            report.unreachable);
    }
    return text + "\n";
}

std::string in_short(std::string_view title, const DirectionReport& report)
{
    const Statistics& s = *report.statistics;
    std::string text =
        fmt::format("{} {} in, {} out, {} lost", title, s.received, s.delivered, s.dropped_total());
    if (const auto p99 = s.lateness.quantile(0.99)) {
        text += fmt::format(", late p99 {:.0f} us", in_us(*p99));
    }
    return text;
}

} // namespace hapnet::emulator

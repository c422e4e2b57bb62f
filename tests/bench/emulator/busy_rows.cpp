// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/emulator/busy_rows.hpp"

#include "tests/bench/emulator/lateness.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::bench {

namespace {

/// A metric of a relay, and how it is computed.
struct Metric {
    std::string_view name;
    double (*of)(const BesideBusy&);
    bool is_judged; // judged against the timerfd relay
};

constexpr double default_p99_us_max = 1000.0; // at 20 kpps
constexpr double default_judged_at = 20'000.0;

constexpr std::array metrics{
    Metric{"p50_us", [](const BesideBusy& one) { return quantile_us(one.errors, 0.5); }, false},
    Metric{"p99_us", [](const BesideBusy& one) { return quantile_us(one.errors, 0.99); }, true},
    Metric{"stalls_over_5ms", [](const BesideBusy& one) { return static_cast<double>(one.stalls); },
           true},
    Metric{"longest_stall_ms",
           [](const BesideBusy& one) { return microseconds(one.longest_stall) / 1000.0; }, false},
    Metric{"cpu_percent", [](const BesideBusy& one) { return 100.0 * one.share(); }, false},
    Metric{"lost", [](const BesideBusy& one) { return static_cast<double>(one.lost); }, false},
};

} // namespace

void BesideBusy::add(const TimingTrial& trial)
{
    errors.insert(errors.end(), trial.errors.begin(), trial.errors.end());
    const Stalls found = stalls_in(trial.departures, stall_min);
    stalls += found.count;
    longest_stall = std::max(longest_stall, found.longest);
    lost += trial.tally.sent - std::min(trial.tally.sent, trial.tally.received);
}

double BesideBusy::share() const { return base::to_seconds(used) / base::to_seconds(took); }

std::vector<Row> rows_beside_busy(double rate, std::map<std::string_view, BesideBusy> relays,
                                  bool fifo)
{
    for (auto& [name, relay] : relays) std::ranges::sort(relay.errors);
    const BesideBusy& timerfd = relays.at(timerfd_relay.name);
    const bool is_judged = fifo && timerfd.share() < share_comparable;
    const auto row = [&](const Subject& subject, std::string_view metric, double value) {
        return Row{.name = fmt::format("{} kpps, beside busy processes", rate / 1000.0),
                   .subject = std::string{subject.name},
                   .baseline = "",
                   .metric = std::string{metric},
                   .value = value,
                   .baseline_value = std::nullopt,
                   .target = std::nullopt};
    };
    std::vector<Row> rows;
    for (const Subject& subject : {eco, precise, timerfd_relay}) {
        for (const auto& [name, of, compares] : metrics) {
            Row& one = rows.emplace_back(row(subject, name, of(relays.at(subject.name))));
            if (subject.name == timerfd_relay.name) continue;
            one.baseline = timerfd_relay.name;
            one.baseline_value = of(timerfd);
            if (compares && is_judged) one.target = one.baseline_value;
        }
    }
    if (fifo && rate == default_judged_at) {
        Row& one = rows.emplace_back(row(precise, "p99_us_of_the_default",
                                         quantile_us(relays.at(precise.name).errors, 0.99)));
        one.target = default_p99_us_max;
    }
    return rows;
}

} // namespace hapnet::bench

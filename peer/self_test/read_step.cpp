// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/read_step.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::self_test {

namespace {

// The least share of its nominal rate at which a device must report to be fit for a session.
constexpr double rate_share_wanted = 0.5;
constexpr std::size_t bar_most = 50; // characters

} // namespace

StepRequest ReadStep::on_tick(const StepInput& input, base::TimePoint now)
{
    if (!start_) start_ = now;
    now_ = now;
    const device::Sample& sample = input.sample;
    if (fault_ == device::Fault::none) fault_ = sample.fault;
    if (sample.sequence != sequence_) {
        sequence_ = sample.sequence;
        if (heard_) count_gap(now - *heard_);
        heard_ = now;
    }
    return {.is_done = now - *start_ >= length_, .prompt = Prompt::hold_still};
}

void ReadStep::count_gap(base::Duration gap)
{
    ++reports_;
    all_gaps_.add(gap);
    const double gap_ms = 1e3 * base::to_seconds(gap);
    const auto edge = std::upper_bound(edges_ms.begin(), edges_ms.end(), gap_ms);
    ++gaps_[static_cast<std::size_t>(edge - edges_ms.begin())];
}

std::string ReadStep::drawing() const
{
    const auto most = *std::max_element(gaps_.begin(), gaps_.end());
    if (most == 0) return "";
    std::string text = "time between two reports of the device:\n";
    for (std::size_t i = 0; i < gaps_.size(); ++i) {
        const std::string from = i == 0 ? "0" : fmt::format("{}", edges_ms[i - 1]);
        const std::string to = i == edges_ms.size() ? "..." : fmt::format("{}", edges_ms[i]);
        const auto share = static_cast<double>(gaps_[i]) / static_cast<double>(most);
        auto bar = static_cast<std::size_t>(share * static_cast<double>(bar_most));
        if (gaps_[i] > 0) bar = std::max<std::size_t>(bar, 1);
        text +=
            fmt::format("{:>5} to {:>3} ms {:>7}  {}\n", from, to, gaps_[i], std::string(bar, '#'));
    }
    return text;
}

Outcome ReadStep::outcome() const
{
    Outcome outcome{.step = "read", .verdict = Verdict::failed, .text = {}};
    const double seconds = start_ ? base::to_seconds(now_ - *start_) : 0.0;
    const double rate_hz = seconds > 0.0 ? static_cast<double>(reports_) / seconds : 0.0;
    outcome.rate_hz = rate_hz;
    outcome.gap_p50 = all_gaps_.quantile(0.5).value_or(base::Duration{});
    outcome.gap_max = all_gaps_.max().value_or(base::Duration{});
    const double median_s = base::to_seconds(*outcome.gap_p50);
    outcome.drawing = drawing();
    outcome.text =
        fmt::format("{:.0f} reports a second, {:.1f} ms apart in the median and {:.1f} ms "
                    "at most",
                    rate_hz, 1e3 * median_s, 1e3 * base::to_seconds(*outcome.gap_max));
    if (fault_ != device::Fault::none) {
        outcome.text = fmt::format("{}; {}", device::describe(fault_), outcome.text);
    } else if (reports_ == 0) {
        outcome.text =
            "the device sent no reports, although it may have been moved: check its power";
    } else if (median_s * rate_share_wanted * nominal_hz_ > 1.0) {
        outcome.text += fmt::format(", but {:.0f} a second are nominal: another cable, port or "
                                    "hub may help",
                                    nominal_hz_);
    } else {
        outcome.verdict = Verdict::passed;
    }
    return outcome;
}

} // namespace hapnet::peer::self_test

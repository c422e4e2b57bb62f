// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/predict.hpp"

#include "emulator/core/link.hpp"
#include "emulator/core/profile/timeline.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>

namespace hapnet::emulator {

namespace {

/// One direction on its way through virtual time.
class Play {
public:
    Play(const Conditions& conditions, base::Seed seed, Direction direction)
        : link_{conditions, {.seed = seed, .direction = direction}}
    {}

    void change(const Conditions& conditions, base::TimePoint at)
    {
        drain(at);
        if (conditions != link_.conditions()) link_.change(conditions, at);
    }

    void packet(std::span<const std::byte> bytes, base::TimePoint at)
    {
        drain(at);
        const Admission admission = link_.on_packet(bytes, at);
        if (admission.departure) link_.on_sent(*admission.departure, at);
        count(std::holds_alternative<Drop>(admission.fate.verdict));
    }

    [[nodiscard]] DirectionPrediction finish()
    {
        while (const auto deadline = link_.next_deadline()) drain(*deadline);
        result_.statistics = link_.statistics();
        result_.lens = link_.lens().report();
        const auto& lens = result_.lens;
        if (lens.delay) result_.added_by_queues = lens.delay->mean - lens.requested_delay->mean;
        return result_;
    }

private:
    /// Lets leave what is due before or at `now`, each at its own time.
    void drain(base::TimePoint now)
    {
        for (auto deadline = link_.next_deadline(); base::is_due(deadline, now);
             deadline = link_.next_deadline()) {
            while (const auto departure = link_.poll(*deadline)) {
                link_.on_sent(*departure, *deadline);
            }
        }
    }

    void count(bool is_lost)
    {
        if (!is_lost) {
            run_ = 0;
            return;
        }
        ++result_.lost;
        if (run_ == 0) ++result_.loss_runs;
        ++run_;
        result_.loss_run_max = std::max(result_.loss_run_max, run_);
    }

    Link link_;
    DirectionPrediction result_;
    std::uint64_t run_ = 0;
};

} // namespace

double DirectionPrediction::loss_share() const
{
    if (statistics.received == 0) return 0.0;
    return static_cast<double>(lost) / static_cast<double>(statistics.received);
}

std::optional<double> DirectionPrediction::loss_run_mean() const
{
    if (loss_runs == 0) return std::nullopt;
    return static_cast<double>(lost) / static_cast<double>(loss_runs);
}

Prediction predicted(const Profile& profile, const Stream& stream, base::Seed seed)
{
    base::ensure(stream.spacing > base::Duration{0} && stream.bytes <= 65'507);
    const Timeline timeline{profile};
    const Path start = timeline.at(base::Duration{0});
    Play up{start.up, seed, Direction::up};
    Play down{start.down, seed, Direction::down};
    const std::vector<std::byte> bytes(stream.bytes);
    auto change = timeline.next_change(base::Duration{0});
    base::Duration now{};
    for (std::uint64_t i = 0; i < stream.packets; ++i, now += stream.spacing) {
        for (; change && *change <= now; change = timeline.next_change(*change)) {
            const Path path = timeline.at(*change);
            up.change(path.up, base::TimePoint{*change});
            down.change(path.down, base::TimePoint{*change});
        }
        up.packet(bytes, base::TimePoint{now});
        down.packet(bytes, base::TimePoint{now});
    }
    return {up.finish(), down.finish()};
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/predict.hpp"

#include "emulator/core/emulated_path.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

/// Lets leave what is due before or at `now`, each at its own time.
void drain(EmulatedPath& path, base::TimePoint now)
{
    for (auto due = path.next_due(); base::is_due(due, now); due = path.next_due()) {
        for (const Direction direction : {Direction::up, Direction::down}) {
            while (const auto datagram = path.poll(direction, *due)) {
                path.on_sent(direction, *datagram, *due);
            }
        }
    }
}

/// Counts the losses of one direction.
class Losses {
public:
    void add(bool is_lost)
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

    /// With what the link saw.
    [[nodiscard]] DirectionPrediction with(const Link& link) const
    {
        DirectionPrediction result = result_;
        result.statistics = link.statistics();
        result.measured = link.stream_statistics().report();
        const auto& measured = result.measured;
        if (measured.delay) {
            result.added_by_queues = measured.delay->mean - measured.requested_delay->mean;
        }
        return result;
    }

private:
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

Prediction predict(const Profile& profile, const Stream& stream, base::Seed seed)
{
    base::ensure(stream.spacing > base::Duration{0} && stream.bytes <= 65'507);
    EmulatedPath path{profile, {.seed = seed}};
    const std::vector<std::byte> bytes(stream.bytes);
    Losses up;
    Losses down;
    base::TimePoint now{};
    for (std::uint64_t i = 0; i < stream.packets; ++i, now += stream.spacing) {
        while (base::is_due(path.director().next_change(), now)) {
            const auto change = *path.director().next_change();
            drain(path, change);
            path.advance(change);
        }
        drain(path, now);
        for (const Direction direction : {Direction::up, Direction::down}) {
            const Admission admission = path.on_packet(direction, bytes, now);
            if (admission.departure) path.on_sent(direction, *admission.departure, now);
            (direction == Direction::up ? up : down).add(admission.fate.drop.has_value());
        }
    }
    while (const auto due = path.next_due()) drain(path, *due);
    return {up.with(path.link(Direction::up)), down.with(path.link(Direction::down))};
}

} // namespace hapnet::emulator::tools

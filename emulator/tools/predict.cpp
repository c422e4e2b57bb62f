// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/predict.hpp"

#include "emulator/core/emulated_path.hpp"
#include "proto/base/ensure.hpp"

#include <utility>
#include <vector>

namespace hapnet::emulator::tools {

namespace {

/// Counts the losses of one direction, and collects its delays.
class Outcomes {
public:
    void add_departure(const Datagram& datagram, base::TimePoint at)
    {
        if (!datagram.is_copy) delays_.add(base::to_seconds(at - datagram.arrival));
    }

    [[nodiscard]] bool is_settled() const
    {
        DirectionPrediction result;
        result.precision = delays_.precision();
        return result.is_settled();
    }

    void add_fate(bool is_lost)
    {
        if (is_lost) {
            ++run_;
        } else if (run_ > 0) {
            result_.loss_runs.add(std::exchange(run_, 0));
        }
    }

    /// Returns the prediction with the link's counts.
    [[nodiscard]] DirectionPrediction with(const Link& link) const
    {
        DirectionPrediction result = result_;
        if (run_ > 0) result.loss_runs.add(run_);
        result.statistics = link.statistics();
        result.measured = link.stream_statistics().report();
        result.precision = delays_.precision();
        const auto& measured = result.measured;
        if (measured.delay) {
            result.added_by_queues = measured.delay->mean - measured.requested_delay->mean;
        }
        return result;
    }

private:
    DirectionPrediction result_;
    BatchMeans delays_;
    std::uint64_t run_ = 0; // length of the run of losses in progress
};

/// A stream that is sent through a path.
class Play {
public:
    Play(const Profile& profile, const Stream& stream, base::Seed seed)
        : spacing_{stream.spacing},
          is_sealed_{stream.is_sealed},
          path_{profile, {.seed = seed, .name = stream.path}},
          bytes_(stream.bytes)
    {
        base::ensure(stream.spacing > base::Duration{0} && stream.bytes <= 65'507);
    }

    /// Continues sending until `packets` were sent in each direction.
    void go_on_to(std::uint64_t packets)
    {
        for (; sent_ < packets; ++sent_, now_ += spacing_) {
            while (base::is_due(path_.director().next_change(), now_)) {
                const auto change = *path_.director().next_change();
                drain(change);
                path_.advance(change);
            }
            drain(now_);
            for (const Direction direction : {Direction::up, Direction::down}) {
                const Admission admission = path_.on_packet(direction, bytes_, now_);
                if (admission.departure) depart(direction, *admission.departure, now_);
                const Fate& fate = admission.fate;
                const bool is_refused = is_sealed_ && fate.flips.count > 0;
                of(direction).add_fate(fate.drop.has_value() || is_refused);
            }
        }
    }

    [[nodiscard]] bool is_settled() const { return up_.is_settled() && down_.is_settled(); }

    /// Lets all datagrams leave.
    [[nodiscard]] Prediction finish()
    {
        while (const auto due = path_.next_due()) drain(*due);
        return {up_.with(path_.link(Direction::up)), down_.with(path_.link(Direction::down))};
    }

private:
    [[nodiscard]] Outcomes& of(Direction direction)
    {
        return direction == Direction::up ? up_ : down_;
    }

    void depart(Direction direction, const Datagram& datagram, base::TimePoint at)
    {
        of(direction).add_departure(datagram, at);
        path_.on_sent(direction, datagram, at);
    }

    /// Lets the datagrams that are due at or before `now` leave, each at its own time.
    void drain(base::TimePoint now)
    {
        for (auto due = path_.next_due(); base::is_due(due, now); due = path_.next_due()) {
            for (const Direction direction : {Direction::up, Direction::down}) {
                while (const auto datagram = path_.poll(direction, *due)) {
                    depart(direction, *datagram, *due);
                }
            }
        }
    }

    base::Duration spacing_;
    bool is_sealed_;
    EmulatedPath path_;
    std::vector<std::byte> bytes_;
    std::uint64_t sent_ = 0;
    base::TimePoint now_{};
    Outcomes up_;
    Outcomes down_;
};

} // namespace

double DirectionPrediction::loss_share() const
{
    if (statistics.received == 0) return 0.0;
    return static_cast<double>(loss_runs.sum) / static_cast<double>(statistics.received);
}

bool DirectionPrediction::is_settled() const
{
    return !precision || (precision->mean <= settled_to && precision->sd <= settled_to);
}

Prediction predict(const Profile& profile, const Stream& stream, base::Seed seed)
{
    Play play{profile, stream, seed};
    play.go_on_to(stream.packets);
    return play.finish();
}

Prediction predict_until_settled(const Profile& profile, const Stream& stream, base::Seed seed,
                                 std::uint64_t packets_max)
{
    Play play{profile, stream, seed};
    auto packets = stream.packets;
    play.go_on_to(packets);
    const bool can_settle = profile.timeline.empty();
    while (can_settle && !play.is_settled() && packets <= packets_max / 2) {
        packets *= 2;
        play.go_on_to(packets);
    }
    return play.finish();
}

} // namespace hapnet::emulator::tools

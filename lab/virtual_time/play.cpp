// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/play.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace hapnet::lab::virtual_time {

namespace {

/// Two sides that have not begun by then never will: at a loss of 99 % both ways it takes 10 s.
constexpr base::Duration begins_within{std::chrono::seconds{60}};
constexpr std::int64_t steps_between_looks = 1024; // at `stop`

/// One side while it was in session with the other: one sample a tick, without gaps.
struct Track {
    base::TimePoint first;
    std::vector<Sample> samples;
};

/// Whether a link was full, so that a datagram was lost which the emulator would have kept.
bool has_overflowed(const VirtualWorld& world)
{
    const auto overflowed = [&](std::size_t side) {
        return world.link(side).statistics().dropped_by(emulator::DropCause::queue_full) > 0;
    };
    return overflowed(0) || overflowed(1);
}

bool is_playing(const VirtualPlayer& player) { return player.last().phase == peer::Phase::running; }

/// A session on its way.
class Play {
public:
    explicit Play(VirtualWorld& world) : world_{world}, tick_{world.setting().tick} {}

    /// Until it is over; false when `stop` became true before.
    [[nodiscard]] bool run(const std::atomic<bool>* stop)
    {
        for (std::int64_t step = 0; !over_; ++step) {
            const bool looks = stop != nullptr && step % steps_between_looks == 0;
            if (looks && stop->load(std::memory_order_relaxed)) return false;
            world_.step();
            for (const std::size_t side : {0U, 1U}) note(side);
        }
        return true;
    }

    [[nodiscard]] Trace trace() &&;

private:
    void note(std::size_t side);

    VirtualWorld& world_;
    base::Duration tick_;
    std::array<Track, 2> tracks_;
    bool over_ = false;
};

void Play::note(std::size_t side)
{
    const VirtualPlayer& player = world_.side(side);
    if (player.stepped_at != world_.now()) return; // not its tick
    Track& track = tracks_[side];
    if (!is_playing(player)) {
        const bool in_vain = !world_.side(0).peer().session() && !world_.side(1).peer().session() &&
                             world_.now() - VirtualWorld::start > begins_within;
        over_ = over_ || !track.samples.empty() || in_vain;
        return;
    }
    if (track.samples.empty()) {
        track.first = world_.now();
        const auto ticks = player.peer().hands_on() / tick_;
        track.samples.reserve(static_cast<std::size_t>(ticks) + 1);
    }
    track.samples.push_back(player.sample());
}

Trace Play::trace() &&
{
    Trace trace{.task = world_.setting().task, .tick = tick_};
    trace.simulated = world_.now() - VirtualWorld::start;
    auto& [l, r] = tracks_;
    if (l.samples.empty() || r.samples.empty()) return trace;
    const VirtualPlayer& first = world_.side(0);
    const base::TimePoint start = first.peer().session()->start - first.clock_ahead;

    // L's samples before R began are left out; R's are taken at L's times.
    const base::Duration wait = std::max(base::Duration{0}, r.first - l.first);
    const auto skipped = (wait + tick_ - base::Duration{1}) / tick_;
    const base::Duration into_r = l.first + skipped * tick_ - r.first;
    const auto size = [](const Track& track) {
        return static_cast<base::Duration::rep>(track.samples.size());
    };
    const auto from = into_r / tick_;
    const double share =
        static_cast<double>((into_r % tick_).count()) / static_cast<double>(tick_.count());
    const auto beyond = share > 0.0 ? 1 : 0;
    const auto common = std::min(size(l) - skipped, size(r) - from - beyond);
    if (common <= 0) return trace;

    l.samples.erase(l.samples.begin(), l.samples.begin() + skipped);
    l.samples.resize(static_cast<std::size_t>(common));
    for (base::Duration::rep i = 0; i < common && (from > 0 || beyond > 0); ++i) {
        const auto at = static_cast<std::size_t>(from + i);
        r.samples[static_cast<std::size_t>(i)] =
            between(r.samples[at], r.samples[at + static_cast<std::size_t>(beyond)], share);
    }
    r.samples.resize(static_cast<std::size_t>(common));
    trace.begin = l.first + skipped * tick_ - start;
    trace.overlap =
        std::min(1.0, base::to_seconds(common * tick_) / base::to_seconds(first.peer().hands_on()));
    trace.sides[0] = std::move(l.samples);
    trace.sides[1] = std::move(r.samples);
    return trace;
}

} // namespace

std::optional<Trace> play_out(VirtualWorld& world, const std::atomic<bool>* stop)
{
    Play session{world};
    if (!session.run(stop)) return std::nullopt;
    return std::move(session).trace();
}

base::Result<Trace> play(const Setting& setting, const std::atomic<bool>* stop)
{
    if (auto valid = validate(setting); !valid) return tl::unexpected{std::move(valid).error()};
    VirtualWorld world{setting};
    std::optional<Trace> trace = play_out(world, stop);
    if (trace && has_overflowed(world)) {
        // Datagrams were in flight by the thousand: again, with the memory that the emulator has.
        VirtualWorld roomy{setting, {}};
        trace = play_out(roomy, stop);
    }
    if (!trace) return base::fail("stopped before its end");
    return *std::move(trace);
}

} // namespace hapnet::lab::virtual_time

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/play.hpp"

#include "lab/virtual_time/one_world.hpp"
#include "scene/maths/rotation.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace hapnet::lab::virtual_time {

namespace {

/// The time within which sides must begin. Later they never will: at a loss of 99 % in both
/// directions two sides take 10 s.
constexpr base::Duration begins_within{std::chrono::seconds{60}};
constexpr std::int64_t steps_between_looks = 1024; // steps between two looks at `stop`
/// The time that the copies have to agree again after all hands let go.
constexpr base::Duration settles_within{std::chrono::seconds{2}};

/// One side while it was in session: one sample per tick, without gaps.
struct Track {
    base::TimePoint first;
    std::vector<Sample> samples;
    std::vector<Pose> further;          // see Trace::further
    std::vector<base::TimePoint> times; // times of the samples, if any side ticks unevenly
};

/// True if a link was full, so that it lost a datagram which the emulator would have kept.
bool has_overflowed(const VirtualWorld& world)
{
    const std::size_t players = world.setting().players.size();
    for (std::size_t from = 0; from < players; ++from) {
        for (std::size_t to = 0; to < players; ++to) {
            if (from == to) continue;
            const emulator::Statistics& statistics = world.link(from, to).statistics();
            if (statistics.dropped[emulator::DropCause::queue_full] > 0) return true;
        }
    }
    return false;
}

/// The number of bits that each direction has carried so far, with the headers of UDP over IPv4.
struct Traffic {
    base::TimePoint at;
    std::vector<double> bits;
};

Traffic traffic_of(const VirtualWorld& world)
{
    constexpr double header_bytes = 28.0;
    Traffic traffic{world.now(), {}};
    const std::size_t players = world.setting().players.size();
    for (std::size_t from = 0; from < players; ++from) {
        for (std::size_t to = 0; to < players; ++to) {
            if (from == to) continue;
            const emulator::Statistics& sent = world.link(from, to).statistics();
            traffic.bits.push_back(8.0 * (static_cast<double>(sent.bytes_in) +
                                          header_bytes * static_cast<double>(sent.received)));
        }
    }
    return traffic;
}

/// Returns the rate of the busiest direction between the two moments, bit/s.
double rate_between(const Traffic& begin, const Traffic& end)
{
    double most = 0.0;
    for (std::size_t i = 0; i < begin.bits.size(); ++i)
        most = std::max(most, end.bits[i] - begin.bits[i]);
    const double seconds = base::to_seconds(end.at - begin.at);
    return seconds > 0.0 ? most / seconds : 0.0;
}

bool has_own_ticks(const PlayerSetting& player) { return player.ticks != nullptr; }

bool is_playing(const VirtualPlayer& player) { return player.last().phase == peer::Phase::running; }

/// A session in progress.
class Play {
public:
    Play(VirtualWorld& world, PlaysOn plays_on)
        : world_{world},
          plays_on_{plays_on},
          tick_{world.setting().tick},
          tracks_(world.setting().players.size()),
          are_even_{std::ranges::none_of(world.setting().players, has_own_ticks)}
    {}

    /// Plays until the session is over. Returns false when `stop` became true before.
    [[nodiscard]] bool run(const std::atomic<bool>* stop)
    {
        for (std::int64_t step = 0; !over_; ++step) {
            const bool looks = stop != nullptr && step % steps_between_looks == 0;
            if (looks && stop->load(std::memory_order_relaxed)) return false;
            world_.step();
            for (std::size_t side = 0; side < tracks_.size(); ++side) note(side);
        }
        if (!begun_.bits.empty()) rate_bit_per_s_ = rate_between(begun_, traffic_of(world_));
        settle();
        return true;
    }

    [[nodiscard]] Trace trace() &&;

private:
    void note(std::size_t side);
    void settle();
    void note_settled();
    [[nodiscard]] base::Duration::rep take_even(base::TimePoint& begin, Trace& trace);
    [[nodiscard]] base::Duration::rep take_uneven(base::TimePoint& begin, Trace& trace) const;
    [[nodiscard]] bool has_any_session() const;

    VirtualWorld& world_;
    PlaysOn plays_on_;
    base::Duration tick_;
    std::vector<Track> tracks_; // one for each side
    bool are_even_;             // true if all sides tick evenly
    std::vector<Settled> settled_;
    Traffic begun_; // traffic when the first side began; without bits until then
    double rate_bit_per_s_ = 0.0;
    bool over_ = false;
};

void Play::note(std::size_t side)
{
    const VirtualPlayer& player = world_.side(side);
    if (player.stepped_at != world_.now()) return; // the player has no tick now
    Track& track = tracks_[side];
    if (!is_playing(player)) {
        const bool in_vain =
            !has_any_session() && world_.now() - VirtualWorld::start > begins_within;
        over_ = over_ || !track.samples.empty() || in_vain;
        return;
    }
    if (track.samples.empty()) {
        track.first = world_.now();
        if (begun_.bits.empty()) begun_ = traffic_of(world_);
        const auto ticks = player.peer().hands_on() / tick_;
        track.samples.reserve(static_cast<std::size_t>(ticks) + 1);
    }
    track.samples.push_back(player.sample());
    if (!are_even_) track.times.push_back(world_.now());
    if (player.peer().shared().size() > 1) player.add_further_bodies(track.further);
}

bool Play::has_any_session() const
{
    for (std::size_t side = 0; side < tracks_.size(); ++side) {
        if (world_.side(side).peer().session()) return true;
    }
    return false;
}

/// Plays on with hands off.
void Play::settle()
{
    const peer::Peer& peer = world_.side(0).peer();
    const base::Duration hands_off = peer.length() - peer.hands_on();
    const bool agrees_soon = peer::is_one_without_turning(peer.shared());
    if (plays_on_ == PlaysOn::where_it_takes_time && agrees_soon) return;
    if (hands_off <= settles_within) return;
    const base::TimePoint let_go = world_.now();
    while (world_.now() < let_go + hands_off) {
        world_.step();
        if (world_.now() >= let_go + settles_within) note_settled();
    }
}

void Play::note_settled()
{
    for (std::size_t side = 0; side < tracks_.size(); ++side)
        if (world_.side(side).last().phase != peer::Phase::hands_off) return;
    const auto shared = world_.side(0).peer().shared();
    settled_.resize(shared.size());
    for (std::size_t i = 0; i < shared.size(); ++i) {
        Settled& most = settled_[i];
        for (std::size_t a = 0; a < tracks_.size(); ++a) {
            const scene::BodyState here = world_.side(a).peer().world().body(shared[i].id);
            for (std::size_t b = a + 1; b < tracks_.size(); ++b) {
                const scene::BodyState there = world_.side(b).peer().world().body(shared[i].id);
                const glm::dvec3 turn = scene::turn_between(here.orientation, there.orientation);
                most.metres = std::max(most.metres, base::norm(here.position - there.position));
                most.radians = std::max(most.radians, base::norm(base::Displacement{turn}));
            }
        }
    }
}

/// The point from which a track is read: sample number `tick`, and `share` of a tick more.
struct Offset {
    base::Duration::rep tick = 0;
    double share = 0.0;

    [[nodiscard]] base::Duration::rep beyond() const { return share > 0.0 ? 1 : 0; }
};

/// Keeps `count` ticks of a track, beginning at `from`, each with `each` values, and drops the
/// others.
template <typename Value>
void take(std::vector<Value>& values, const Offset& from, base::Duration::rep count,
          std::size_t each = 1)
{
    const auto kept = each * static_cast<std::size_t>(count);
    const auto skipped = each * static_cast<std::size_t>(from.tick);
    const auto beyond = each * static_cast<std::size_t>(from.beyond());
    const bool moves = from.tick > 0 || from.share > 0.0;
    for (std::size_t i = 0; i < kept && moves; ++i) {
        values[i] = between(values[skipped + i], values[skipped + i + beyond], from.share);
    }
    values.resize(kept);
}

/// Reads a track between its samples, in the order of time.
class UnevenTrack {
public:
    UnevenTrack(const Track& track, std::size_t further_bodies)
        : track_{track}, bodies_{further_bodies}
    {}

    /// Adds the interpolated values of the track at a time. The time is within the track, and not
    /// before that of the last call.
    void add_at(base::TimePoint time, std::vector<Sample>& samples, std::vector<Pose>& further)
    {
        while (at_ + 1 < track_.times.size() && track_.times[at_ + 1] <= time) ++at_;
        const std::size_t next = std::min(at_ + 1, track_.times.size() - 1);
        const base::Duration gap = track_.times[next] - track_.times[at_];
        const base::Duration into = time - track_.times[at_];
        const double share =
            into.count() == 0 ? 0.0 : base::to_seconds(into) / base::to_seconds(gap);
        samples.push_back(between(track_.samples[at_], track_.samples[next], share));
        for (std::size_t i = 0; i < bodies_; ++i) {
            further.push_back(between(track_.further[bodies_ * at_ + i],
                                      track_.further[bodies_ * next + i], share));
        }
    }

private:
    const Track& track_;
    std::size_t bodies_;
    std::size_t at_ = 0;
};

/// Moves the even ticks that all sides have into the trace. Sets `begin` to the time of the first
/// of them, and returns their number.
base::Duration::rep Play::take_even(base::TimePoint& begin, Trace& trace)
{
    // The first side's samples before the last side began are left out. The other sides' samples
    // are taken at the first side's times.
    const base::TimePoint first = tracks_.front().first;
    const base::TimePoint last = std::ranges::max(tracks_, {}, &Track::first).first;
    const auto skipped = (last - first + tick_ - base::Duration{1}) / tick_;
    std::vector<Offset> offsets;
    auto common = std::numeric_limits<base::Duration::rep>::max();
    for (const Track& track : tracks_) {
        const base::Duration into = first + skipped * tick_ - track.first;
        const Offset& from =
            offsets.emplace_back(Offset{into / tick_, static_cast<double>((into % tick_).count()) /
                                                          static_cast<double>(tick_.count())});
        const auto size = static_cast<base::Duration::rep>(track.samples.size());
        common = std::min(common, size - from.tick - from.beyond());
    }
    if (common <= 0) return 0;
    for (std::size_t side = 0; side < tracks_.size(); ++side) {
        take(tracks_[side].samples, offsets[side], common);
        trace.sides[side] = std::move(tracks_[side].samples);
        if (trace.further_bodies == 0) continue;
        take(tracks_[side].further, offsets[side], common, trace.further_bodies);
        trace.further.push_back(std::move(tracks_[side].further));
    }
    begin = first + skipped * tick_;
    return common;
}

/// As take_even(), with even times between uneven ticks.
base::Duration::rep Play::take_uneven(base::TimePoint& begin, Trace& trace) const
{
    begin = std::ranges::max(tracks_, {}, &Track::first).first;
    base::TimePoint end = tracks_.front().times.back();
    for (const Track& track : tracks_) end = std::min(end, track.times.back());
    if (end < begin) return 0;
    const base::Duration::rep common = (end - begin) / tick_ + 1;
    if (trace.further_bodies > 0) trace.further.resize(tracks_.size());
    std::vector<Pose> none;
    for (std::size_t side = 0; side < tracks_.size(); ++side) {
        UnevenTrack track{tracks_[side], trace.further_bodies};
        auto& further = trace.further_bodies > 0 ? trace.further[side] : none;
        for (base::Duration::rep i = 0; i < common; ++i)
            track.add_at(begin + i * tick_, trace.sides[side], further);
    }
    return common;
}

Trace Play::trace() &&
{
    Trace trace{.task = world_.setting().task, .tick = tick_};
    trace.simulated = world_.now() - VirtualWorld::start;
    trace.settled = settled_;
    trace.rate_bit_per_s = rate_bit_per_s_;
    trace.sides.assign(tracks_.size(), {});
    const auto is_empty = [](const Track& track) { return track.samples.empty(); };
    if (std::ranges::any_of(tracks_, is_empty)) return trace;

    trace.further_bodies = world_.side(0).peer().shared().size() - 1;
    base::TimePoint begin;
    const auto common = are_even_ ? take_even(begin, trace) : take_uneven(begin, trace);
    if (common == 0) {
        trace.further_bodies = 0;
        return trace;
    }
    const VirtualPlayer& player = world_.side(0);
    const base::TimePoint start = player.peer().session()->start - player.clock_ahead;
    trace.begin = begin - start;
    trace.overlap = std::min(1.0, base::to_seconds(common * tick_) /
                                      base::to_seconds(player.peer().hands_on()));
    return trace;
}

} // namespace

std::optional<Trace> play_out(VirtualWorld& world, const std::atomic<bool>* stop, PlaysOn plays_on)
{
    Play session{world, plays_on};
    if (!session.run(stop)) return std::nullopt;
    return std::move(session).trace();
}

base::Result<Trace> play(const Setting& setting, const std::atomic<bool>* stop, PlaysOn plays_on)
{
    if (auto valid = validate(setting); !valid) return tl::unexpected{std::move(valid).error()};
    if (setting.is_one_world) return play_in_one_world(setting, stop);
    VirtualWorld world{setting};
    std::optional<Trace> trace = play_out(world, stop, plays_on);
    if (trace && has_overflowed(world)) {
        // Thousands of datagrams were in flight. The session is played again, with as much memory
        // as the emulator has.
        VirtualWorld roomy{setting, {}};
        trace = play_out(roomy, stop, plays_on);
    }
    if (!trace) return base::fail("stopped before its end");
    return *std::move(trace);
}

} // namespace hapnet::lab::virtual_time

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/soak/round_judge.hpp"

#include "device/governor.hpp"
#include "proto/wire/message.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::soak {

namespace {

using namespace std::chrono_literals;
using device::GovernorState;
using record::Phase;

// As in peer::Staleness: a state holds, fades, and then no longer counts.
constexpr base::Duration holds = 250ms;
constexpr base::Duration fades = 50ms;
constexpr int fade_ticks = 50;
constexpr base::Duration tick = 1ms;
// As peer::Others::gone_after. The others then play on, after 50 ms for the governor.
constexpr base::Duration gone = 1s;
constexpr base::Duration ramped = gone + 100ms;
// Longer than any run of lost states, so the peer has died.
constexpr base::Duration silence_least = 350ms;
constexpr std::size_t ticks_to_judge = 50;
constexpr double played_share = 0.9;
constexpr double force_rounding_n = 1e-6;
constexpr std::size_t breaches_max = 5; // of a record, in words
// As in Analysis: the copies have this long to agree.
constexpr base::Duration settles = 2s;

double ms(base::Duration length) { return 1e3 * base::to_seconds(length); }

/// The last state of another peer, as this peer received it.
struct Heard {
    std::uint32_t session = 0;
    std::uint32_t sequence = 0;
    base::TimePoint arrived{};
    bool touching = false;
    double force_n = 0.0; // along x, on the body
};

/// The time after the last state of another peer has held long enough.
struct Silence {
    int ticks = 0;
    bool is_counted = false;      // among those that died
    std::size_t ticks_after = 0;  // after it counts as gone
    std::size_t ticks_played = 0; // of these
    bool at_fault = false;
};

class Judge {
public:
    explicit Judge(const record::Record& record) : record_{record} {}
    [[nodiscard]] Verdict run();

private:
    void hear(const record::MessageRow& row);
    void look(const record::TickRow& row);
    void look_at_silence(const record::TickRow& row, std::uint16_t id, base::Duration age);
    void look_whether_it_counts(const record::TickRow& row, std::uint16_t id, base::Duration age);
    void look_whether_it_plays_on(const record::TickRow& row, std::uint16_t id);
    void end(std::uint16_t id);
    [[nodiscard]] bool is_known(std::uint16_t from, std::uint32_t session) const;
    template <typename... Values>
    void breach(fmt::format_string<Values...> words, Values&&... values)
    {
        if (verdict_.breaches.size() < breaches_max)
            verdict_.breaches.push_back(fmt::format(words, std::forward<Values>(values)...));
    }

    const record::Record& record_;
    std::map<std::uint16_t, Heard> heard_;
    std::map<std::uint16_t, Silence> silent_;
    double force_limit_n_ = 0.0;
    Verdict verdict_;
};

Verdict Judge::run()
{
    verdict_.peer = record_.config.value("peer_id", 0);
    force_limit_n_ = record_.config.value("force_limit_n", 0.0);
    std::size_t next = 0;
    for (const record::TickRow& row : record_.ticks) {
        for (; next < record_.messages.size() && record_.messages[next].tick <= row.tick; ++next)
            hear(record_.messages[next]);
        look(row);
    }
    while (!silent_.empty()) end(silent_.begin()->first);
    return std::move(verdict_);
}

bool Judge::is_known(std::uint16_t from, std::uint32_t session) const
{
    return std::ranges::any_of(record_.sessions, [&](const record::SessionRow& row) {
        return row.other == from && row.session == session;
    });
}

void Judge::hear(const record::MessageRow& row)
{
    const auto message = wire::decode(row.bytes);
    const auto* const state = message ? std::get_if<wire::State>(&*message) : nullptr;
    if (state == nullptr) return;
    const auto found = heard_.find(row.from);
    const bool is_of_same_run = found != heard_.end() && found->second.session == state->session;
    if (is_of_same_run && state->sequence <= found->second.sequence) return;
    if (!is_of_same_run && !is_known(row.from, state->session)) return;
    end(row.from);
    heard_[row.from] = {state->session, state->sequence, row.received_at, state->touching,
                        state->contact_force.x()};
}

void Judge::look(const record::TickRow& row)
{
    const double force_n = base::norm(row.device);
    if (!base::is_finite(row.device) || !base::is_finite(row.cube) ||
        force_n > force_limit_n_ + 1e-9)
        breach("tick {}: a force of {} N, the body at {} m", row.tick, force_n, row.cube.x());
    verdict_.force_max_n = std::max(verdict_.force_max_n, force_n);
    if (row.governor == static_cast<std::uint8_t>(GovernorState::fault))
        verdict_.was_at_fault = true;
    if (row.phase != Phase::running) {
        while (!silent_.empty()) end(silent_.begin()->first);
        return;
    }
    verdict_.hands_on_s += base::to_seconds(tick);
    for (const auto& [id, heard] : heard_) {
        const base::Duration age = row.at() - heard.arrived;
        if (age > holds) look_at_silence(row, id, age);
    }
}

void Judge::look_at_silence(const record::TickRow& row, std::uint16_t id, base::Duration age)
{
    Silence& silence = silent_[id];
    ++silence.ticks;
    const bool touched = heard_[id].touching;
    if (age > silence_least && !std::exchange(silence.is_counted, true)) {
        ++verdict_.silences;
        verdict_.died_touching += touched ? 1 : 0;
    }
    if (touched && age < gone && base::norm(row.device) > 0.0) {
        verdict_.felt_max_ms = std::max(verdict_.felt_max_ms, ms(age));
        // In ticks, as a busy machine may skip some: each tick reduces the force by its share.
        if (silence.ticks > fade_ticks)
            breach("tick {}: {:.3f} N are felt {:.1f} ms after the last word of {}, which touched",
                   row.tick, base::norm(row.device), ms(age), id);
    }
    look_whether_it_counts(row, id, age);
    if (age > ramped) look_whether_it_plays_on(row, id);
}

/// Expects that the forces counted by this peer are the sum of those of the peers that are heard.
void Judge::look_whether_it_counts(const record::TickRow& row, std::uint16_t id, base::Duration age)
{
    if (!heard_[id].touching || std::abs(heard_[id].force_n) < force_rounding_n) return;
    double of_the_heard_n = 0.0;
    for (const auto& [other, heard] : heard_) {
        const base::Duration other_age = row.at() - heard.arrived;
        if (other == id || other_age >= holds + fades) continue;
        if (other_age > holds) return; // its force fades at this moment
        if (heard.touching) of_the_heard_n += heard.force_n;
    }
    if (std::abs(row.remote.x() - of_the_heard_n) < force_rounding_n) return;
    verdict_.counted_max_ms = std::max(verdict_.counted_max_ms, ms(age));
    if (age > holds + fades)
        breach("tick {}: {:.3f} N of others, and not {:.3f} N, {:.1f} ms after the last word of {}",
               row.tick, row.remote.x(), of_the_heard_n, ms(age), id);
}

void Judge::look_whether_it_plays_on(const record::TickRow& row, std::uint16_t id)
{
    const bool hears_another = std::ranges::any_of(heard_, [&](const auto& entry) {
        return entry.first != id && row.at() - entry.second.arrived < holds;
    });
    if (!hears_another) return;
    const auto state = static_cast<GovernorState>(row.governor);
    Silence& silence = silent_[id];
    ++silence.ticks_after;
    if (state == GovernorState::active || state == GovernorState::ramping) ++silence.ticks_played;
    if (state == GovernorState::fault) silence.at_fault = true;
}

void Judge::end(std::uint16_t id)
{
    const auto found = silent_.find(id);
    if (found == silent_.end()) return;
    const Silence silence = found->second;
    silent_.erase(found);
    if (silence.ticks_after < ticks_to_judge || silence.at_fault) return;
    ++verdict_.lasted;
    const double share =
        static_cast<double>(silence.ticks_played) / static_cast<double>(silence.ticks_after);
    if (share >= played_share) {
        ++verdict_.played_on;
    } else {
        breach("it did not play on when {} was gone: a force was permitted in {:.0f} % of {} ticks",
               id, 100.0 * share, silence.ticks_after);
    }
}

double degrees_between(const glm::dquat& a, const glm::dquat& b)
{
    const glm::dquat turn = glm::conjugate(a) * b;
    const double sine = std::hypot(turn.x, turn.y, turn.z);
    return glm::degrees(2.0 * std::atan2(sine, std::abs(turn.w)));
}

} // namespace

base::Result<Verdict> judge(const record::Record& record)
{
    if (!record.config.is_object() || record.config.value("force_limit_n", 0.0) <= 0.0)
        return base::fail("its config has no force_limit_n");
    return Judge{record}.run();
}

void add_poses(Poses& poses, const record::Record& record)
{
    const auto off = std::ranges::find(record.ticks, Phase::hands_off, &record::TickRow::phase);
    if (off == record.ticks.end()) return;
    for (const record::MessageRow& row : record.messages) {
        if (row.received_at < off->at() + settles) continue;
        const auto message = wire::decode(row.bytes);
        const auto* const state = message ? std::get_if<wire::State>(&*message) : nullptr;
        if (state == nullptr) continue;
        for (const wire::BodyState& body : state->bodies) {
            Pose pose{body.position, std::nullopt};
            if (body.turning) pose.orientation = body.turning->orientation.quaternion();
            poses[body.body][row.from] = pose;
        }
    }
}

Apart apart(const Poses& poses)
{
    Apart most{.copies = poses.empty() ? 0 : SIZE_MAX};
    for (const auto& [body, copies] : poses) {
        most.copies = std::min(most.copies, copies.size());
        for (const auto& [id, a] : copies) {
            for (const auto& [other, b] : copies) {
                if (other <= id) continue;
                most.distance_mm =
                    std::max(most.distance_mm, 1e3 * base::norm(a.position - b.position));
                if (a.orientation && b.orientation)
                    most.angle_deg =
                        std::max(most.angle_deg, degrees_between(*a.orientation, *b.orientation));
            }
        }
    }
    return most;
}

} // namespace hapnet::soak

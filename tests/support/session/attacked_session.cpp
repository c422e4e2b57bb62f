// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/session/attacked_session.hpp"

#include "tests/support/multiplications.hpp"
#include "tests/support/session/draws.hpp"
#include "tests/support/session/mallory.hpp"
#include "tests/support/session/work_of_5s.hpp"

#include <array>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <spdlog/fmt/fmt.h>
#include <vector>

namespace hapnet::test {

namespace {

using namespace std::chrono_literals;
using lab::virtual_time::Setting;
using lab::virtual_time::VirtualPlayer;
using lab::virtual_time::VirtualWorld;
using peer::Phase;

constexpr base::Duration length = 10s; // 7 s hands on
// With keys the two may first have to wait for 5 s, when both answered what the other has given up.
constexpr base::Duration sealed_length = 18s;
constexpr base::Duration attack_max = 8s;            // over before the hands let go
constexpr base::Duration agree_within = 1200ms;      // of hands off
constexpr base::Duration jump_max = 500ms;           // both still let go together for long enough
constexpr base::Duration silent_after = 300ms + 2ms; // held, faded, and a tick of each side
constexpr double force_max_n = 3.3 + 1e-12;
constexpr double work_max_j = 0.15;
constexpr double agreement_m = 0.1e-3;
// The 1 m that a remote side may claim, and then a push of 3.3 N against 10 N s/m for all of 9 s.
constexpr double cube_within_m = 1.0 + 0.33 * 9.0;

/// Delay to 2 s, loss to 99.9 %, bursts, copies, damage.
emulator::Conditions drawn_conditions(Draws& draw)
{
    emulator::Conditions conditions;
    const base::Duration delay = draw.up_to(draw.one_in(4) ? 2s : 200ms);
    conditions.delay = emulator::constant(delay);
    const base::Duration jitter = draw.up_to(delay);
    conditions.jitter.law = emulator::UniformLaw{{}, jitter};
    conditions.order = static_cast<emulator::Order>(draw.below(3));
    if (!draw.one_in(3)) {
        const double lost = draw.one_in(5) ? 0.999 : 0.6;
        conditions.loss.emplace_back(
            emulator::RandomLoss{base::Probability::from_fraction(lost * draw.share()).value()});
    }
    if (draw.one_in(4)) {
        const auto lost = static_cast<std::uint32_t>(1 + draw.below(80));
        conditions.loss.emplace_back(emulator::Burst{lost, 100, {}});
    }
    if (draw.one_in(4)) {
        conditions.duplicate = {base::Probability::from_fraction(0.3).value(), 5ms};
    }
    if (draw.one_in(4)) {
        conditions.corrupt = {base::Probability::from_fraction(0.2 * draw.share()).value(), 2};
    }
    return conditions;
}

Habits drawn_habits(Draws& draw)
{
    const auto perhaps = [&draw](double most) {
        const bool is_his = draw.one_in(2);
        const double drawn = draw.share();
        return is_his ? most * drawn * drawn : 0.0;
    };
    Habits habits;
    habits.drop = perhaps(0.5);
    habits.hold = perhaps(0.5);
    habits.copy = perhaps(0.5);
    habits.flip = perhaps(0.5);
    habits.resize = perhaps(0.2);
    habits.held_for = draw.up_to(2s);
    habits.replay = perhaps(1.0);
    habits.reflect = perhaps(0.2);
    habits.splice = perhaps(1.0);
    habits.storm = perhaps(0.005);
    habits.silence = perhaps(0.001);
    habits.forge = perhaps(1.0);
    habits.redirect = perhaps(0.3);
    return habits;
}

Setting drawn_setting(base::Seed seed, Draws& draw, base::Duration heals_at, Seal seal)
{
    constexpr std::array tasks{device::Task::p1, device::Task::t1, device::Task::t3};
    constexpr std::array algorithms{"base", "base", "dead-reckoning", "sep"};
    Setting setting;
    setting.task = tasks.at(draw.below(tasks.size()));
    setting.seed = seed;
    setting.length = length;
    setting.energy_limit = true;
    setting.profile.path.up = drawn_conditions(draw);
    setting.profile.path.down = drawn_conditions(draw);
    const emulator::Patch healed{.loss = std::vector<emulator::LossLaw>{},
                                 .corrupt = emulator::Corruption{},
                                 .delay = emulator::constant(20ms),
                                 .jitter = emulator::Variation{}};
    setting.profile.timeline = {{.time = heals_at, .ramp = {}, .up = healed, .down = healed}};
    const auto algorithm = peer::algorithm_named(algorithms.at(draw.below(algorithms.size())));
    for (auto& player : setting.players) {
        player.algorithm = algorithm.value();
        player.phase = draw.up_to(999us);
        player.clock_ahead = draw.up_to(2000s) - 1000s;
        if (seal == Seal::keys) player.circle = seed;
    }
    if (seal == Seal::keys) {
        setting.length = sealed_length;
        // Damage is the attacker's alone: he keeps the book.
        setting.profile.path.up.corrupt = setting.profile.path.down.corrupt = {};
    }
    return setting;
}

/// A clock that runs fast or slow, and may jump ahead once, as that of a machine does that slept.
struct Clock {
    base::Duration ahead{};
    double skew = 0.0;
    base::Duration jump{};
    base::Duration jumps_at{};

    [[nodiscard]] base::Duration at(base::Duration since_start) const
    {
        return ahead + base::from_seconds(skew * base::to_seconds(since_start)) +
               (since_start >= jumps_at ? jump : base::Duration{0});
    }
};

struct Death {
    std::size_t side = 0;
    base::Duration at{};
    base::Duration lasts{};
};

/// What is followed of one side in one run.
struct Watch {
    std::uint64_t let_in_before = 0; // by its earlier runs
    std::uint64_t states = 0;
    base::TimePoint last_taken;
    WorkOf5s work;
    std::optional<base::Position> hip;
    base::Force held;
    std::optional<base::TimePoint> settled_since; // hands off, and the other side is heard
};

std::uint64_t heard(const peer::Counters& c)
{
    return c.states + c.hellos + c.byes + c.outdated + c.other_session + c.malformed +
           c.other_version + c.implausible;
}

class Play {
public:
    Play(std::uint64_t seed, Seal seal);
    [[nodiscard]] AttackedSession run() &&;

private:
    [[nodiscard]] base::Duration elapsed() const { return world_.now() - VirtualWorld::start; }
    void set_clocks();
    void let_die();
    void judge(std::size_t index);
    void judge_forces(std::size_t index);
    void judge_agreement();
    void judge_multiplications();
    [[nodiscard]] bool is_over() const;
    template <typename... Values>
    void complain(fmt::format_string<Values...> words, Values&&... values)
    {
        if (result_.complaint) return;
        const Setting& setting = world_.setting();
        result_.complaint =
            fmt::format("{}, {}, attacked for {:.3f} s, after {:.6f} s: ", name_of(setting.task),
                        peer::algorithm_names.at(setting.players[0].algorithm.index()),
                        base::to_seconds(attack_), base::to_seconds(elapsed())) +
            fmt::format(words, std::forward<Values>(values)...);
    }

    Draws draw_;
    base::Duration attack_;
    VirtualWorld world_;
    Habits habits_;
    Mallory mallory_;
    std::array<Clock, 2> clocks_;
    std::vector<Death> deaths_;
    std::array<Watch, 2> watches_;
    std::uint64_t multiplied_ = 0; // on the curve, before the step
    AttackedSession result_;
};

Play::Play(std::uint64_t seed, Seal seal)
    : draw_{base::Seed{seed}, "attacked session"},
      attack_{2s + draw_.up_to(attack_max - 2s)},
      world_{drawn_setting(base::Seed{seed}, draw_, attack_, seal),
             {.datagrams_max = 16'384, .bytes_max = 16U << 20}},
      habits_{drawn_habits(draw_)},
      mallory_{world_, base::Seed{seed}, habits_}
{
    const auto is_damaged = [this](std::size_t side) {
        const emulator::Path& path = world_.setting().profile.path;
        const emulator::Conditions& way = side == 0 ? path.up : path.down;
        return way.corrupt.share.fraction() > 0.0;
    };
    for (const std::size_t side : {0U, 1U}) {
        Clock& clock = clocks_.at(side);
        clock.ahead = world_.side(side).clock_ahead;
        if (!draw_.one_in(3)) clock.skew = 200e-6 * (2.0 * draw_.share() - 1.0);
        if (draw_.one_in(6)) {
            clock.jump = draw_.up_to(jump_max);
            clock.jumps_at = draw_.up_to(attack_);
        }
        watches_.at(side).last_taken = world_.now();
    }
    for (const std::size_t side : {0U, 1U}) {
        if (!draw_.one_in(3)) continue;
        const base::Duration at = draw_.up_to(attack_);
        deaths_.push_back({side, at, draw_.up_to(attack_ - at)}); // one a side at most
    }
    // A hello that this side's former run sent is that of another peer with its id.
    const bool claims_its_id = habits_.reflect > 0.0 && !deaths_.empty();
    const bool is_taken_for_true =
        claims_its_id || is_damaged(0) || is_damaged(1) ||
        habits_.forge + habits_.flip + habits_.splice + habits_.storm > 0.0;
    result_.is_forged = seal == Seal::none && is_taken_for_true;
}

AttackedSession Play::run() &&
{
    bool is_healed = false;
    while (!is_over() && !result_.complaint) {
        set_clocks();
        let_die(); // those that are started again multiply before their first tick
        multiplied_ = multiplications();
        world_.step();
        for (const std::size_t side : {0U, 1U}) judge(side);
        judge_agreement();
        if (!is_healed && elapsed() >= attack_) {
            is_healed = true;
            mallory_.leave();
        }
        mallory_.act();
        judge_multiplications();
    }
    const bool must_agree = !result_.is_forged && !result_.compared;
    if (must_agree) complain("the two never played together once all was well");
    result_.datagrams = mallory_.given(0) + mallory_.given(1);
    return result_;
}

bool Play::is_over() const
{
    if (elapsed() > attack_ + world_.setting().length + 10s) return true;
    if (elapsed() < attack_) return false;
    const auto is_done = [&](std::size_t side) {
        return world_.is_alive(side) && world_.side(side).last().phase == Phase::ended;
    };
    return result_.compared || (is_done(0) && is_done(1));
}

void Play::set_clocks()
{
    for (const std::size_t side : {0U, 1U}) {
        if (world_.is_alive(side)) world_.side(side).clock_ahead = clocks_.at(side).at(elapsed());
    }
}

void Play::let_die()
{
    for (Death& death : deaths_) {
        const bool is_dead = !world_.is_alive(death.side);
        if (!is_dead && elapsed() >= death.at && death.lasts > base::Duration{0}) {
            world_.kill(death.side);
            result_.work_5s_max_j =
                std::max(result_.work_5s_max_j, watches_.at(death.side).work.most_j());
        } else if (is_dead && elapsed() >= death.at + death.lasts) {
            world_.revive(death.side);
            death.lasts = {};
            watches_.at(death.side) = Watch{};
            watches_.at(death.side).let_in_before = mallory_.let_in(death.side);
            mallory_.note_restart(death.side);
            world_.side(death.side).date_ahead = draw_.up_to(48h) - 24h;
            watches_.at(death.side).last_taken = world_.now();
            set_clocks();
        }
    }
}

void Play::judge(std::size_t index)
{
    if (!world_.is_alive(index)) return;
    const auto& link = world_.link(index, 1 - index).statistics();
    if (link.received + link.duplicated != link.delivered + link.dropped_total() + link.in_flight) {
        complain("link of side {}: its counters do not add up", index);
    }
    if (world_.side(index).stepped_at != world_.now()) return;
    const peer::Counters& counters = world_.side(index).peer().counters();
    const std::uint64_t given = mallory_.let_in(index) - watches_.at(index).let_in_before;
    if (heard(counters) != given) {
        complain("side {}: {} messages in its counters, {} given", index, heard(counters), given);
    }
    if (mallory_.breach()) complain("side {}: {}", index, *mallory_.breach());
    judge_forces(index);
}

void Play::judge_forces(std::size_t index)
{
    const VirtualPlayer& side = world_.side(index);
    Watch& watch = watches_.at(index);
    const std::uint64_t states = side.peer().counters().states;
    if (states != watch.states) watch.last_taken = world_.now();
    watch.states = states;

    const base::Force told = side.told();
    if (!base::is_finite(told) || base::norm(told) > force_max_n) {
        complain("side {}: a force of {} N", index, base::norm(told));
    }
    const base::Duration silence = world_.now() - watch.last_taken;
    if (silence > silent_after && told != base::Force{}) {
        complain("side {}: {} N although nothing was taken for {} ms", index, base::norm(told),
                 silence / 1ms);
    }
    const base::Position body = side.peer().position();
    if (!base::is_finite(body) || std::abs(body.x()) > cube_within_m) {
        complain("side {}: its cube is at x = {} m", index, body.x());
    }
    const base::Position hip = side.side->sample().hip;
    if (watch.hip) {
        const double work_j = glm::dot(watch.held.value, (hip - *watch.hip).value);
        watch.work.add(work_j, world_.now() + side.clock_ahead);
    }
    watch.hip = hip;
    watch.held = told;
    result_.work_5s_max_j = std::max(result_.work_5s_max_j, watch.work.most_j());
    if (watch.work.most_j() > work_max_j) {
        complain("side {}: {} J into the hand within 5 s", index, watch.work.most_j());
    }
}

void Play::judge_agreement()
{
    if (elapsed() < attack_ || !world_.is_alive(0) || !world_.is_alive(1)) return;
    bool all_settled = true;
    for (const std::size_t side : {0U, 1U}) {
        Watch& watch = watches_.at(side);
        const bool is_settled = world_.side(side).last().phase == Phase::hands_off &&
                                world_.now() - watch.last_taken < silent_after;
        if (!is_settled) watch.settled_since.reset();
        if (is_settled && !watch.settled_since) watch.settled_since = world_.now();
        all_settled =
            all_settled && is_settled && world_.now() - *watch.settled_since >= agree_within;
    }
    if (!all_settled || result_.compared) return;
    result_.compared = true;
    const double apart =
        std::abs(world_.side(0).peer().position().x() - world_.side(1).peer().position().x());
    if (apart > agreement_m) complain("the copies are {} mm apart", 1e3 * apart);
}

/// Of each side at most one in its tick, and none for what comes in.
void Play::judge_multiplications()
{
    const std::uint64_t made = multiplications() - multiplied_;
    std::uint64_t ticks = 0;
    for (const std::size_t side : {0U, 1U})
        if (world_.is_alive(side) && world_.side(side).stepped_at == world_.now()) ++ticks;
    if (made > ticks) complain("{} multiplications on the curve in {} ticks", made, ticks);
}

} // namespace

AttackedSession play_attacked(std::uint64_t seed, Seal seal) { return Play{seed, seal}.run(); }

} // namespace hapnet::test

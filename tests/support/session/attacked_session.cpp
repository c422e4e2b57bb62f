// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/session/attacked_session.hpp"

#include "scene/text/text.hpp"
#include "tests/support/multiplications.hpp"
#include "tests/support/session/draws.hpp"
#include "tests/support/session/mallory.hpp"
#include "tests/support/session/work_of_5s.hpp"

#include <algorithm>
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
using peer::Peer;
using peer::Phase;

constexpr base::Duration length = 10s; // 7 s hands on
// With keys the two may first have to wait for 5 s, when both answered what the other has given up.
constexpr base::Duration sealed_length = 18s;
// How much later than at once they may begin when all is well: what was on its way comes within
// 4 s, and then, with keys, a side whose date was set back is refused by one that has used a key of
// a later date. It gives up after 5 s, listens for 1 s, and may begin anew, for 5 s, just before
// the other's handshake reaches it. Only then does it answer.
constexpr base::Duration begins_within = 10s;
constexpr base::Duration begins_within_sealed = 4s + 11s;
constexpr base::Duration attack_max = 8s;       // over before the hands let go
constexpr base::Duration agree_within = 1200ms; // of hands off
// Of 3 s hands off. A start is converted from one clock to the other once, by an echo that he may
// have held back on one way alone; the hands then let go apart by half of that.
constexpr base::Duration let_go_apart_max = 3s - agree_within - 100ms;
constexpr base::Duration longest_delay = 2s;
constexpr base::Duration jump_max = 500ms;           // both still let go together for long enough
constexpr base::Duration silent_after = 300ms + 2ms; // held, faded, and a tick of each side
constexpr base::Duration fade_takes = 50ms + 2ms;
constexpr double force_max_n = 3.3 + 1e-12;
constexpr double work_max_j = 0.15;
constexpr double agreement_m = 0.1e-3;
// The 1 m that a remote side may claim, and then a push of 3.3 N of each hand against 10 N s/m for
// all of 9 s; each of the others' is part of what the first claims where there are two.
double body_within_m(std::size_t peers)
{
    return 1.0 + 0.33 * 9.0 * static_cast<double>(peers - 1);
}

/// Delay to 2 s, loss to 99.9 %, bursts, copies, damage.
emulator::Conditions drawn_conditions(Draws& draw)
{
    emulator::Conditions conditions;
    const base::Duration delay = draw.up_to(draw.one_in(4) ? longest_delay : 200ms);
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

/// What is played.
struct Asked {
    std::uint64_t seed = 0;
    Seal seal = Seal::none;
    std::size_t peers = 2;
};

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

/// What becomes of every path when all is well again.
const emulator::Patch healed{.loss = std::vector<emulator::LossLaw>{},
                             .corrupt = emulator::Corruption{},
                             .delay = emulator::constant(20ms),
                             .jitter = emulator::Variation{}};

/// Draws tasks, algorithms and the path of two.
void draw_pair(Setting& setting, Draws& draw, base::Duration heals_at)
{
    constexpr std::array tasks{device::Task::p1, device::Task::t1, device::Task::t3};
    constexpr std::array algorithms{"base", "base", "dead-reckoning", "sep"};
    setting.task = tasks.at(draw.below(tasks.size()));
    setting.profile.path.up = drawn_conditions(draw);
    setting.profile.path.down = drawn_conditions(draw);
    setting.profile.timeline = {{.time = heals_at, .ramp = {}, .up = healed, .down = healed}};
    const auto algorithm = peer::algorithm_named(algorithms.at(draw.below(algorithms.size())));
    for (auto& player : setting.players) player.algorithm = algorithm.value();
}

emulator::Patch all_of(const emulator::Conditions& conditions)
{
    return {.loss = conditions.loss,
            .corrupt = conditions.corrupt,
            .duplicate = conditions.duplicate,
            .delay = conditions.delay,
            .jitter = conditions.jitter,
            .order = conditions.order};
}

/// Draws the algorithm and the paths of more than two, each its own.
void draw_group(Setting& setting, Draws& draw, base::Duration heals_at)
{
    constexpr std::array algorithms{"base", "base", "remote-proxy", "wave"};
    setting.task = device::Task::t7;
    setting.scene = scene::load_scene("carry", {}).value();
    emulator::Change heals{.time = heals_at, .ramp = {}, .up = {}, .down = {}};
    for (const std::string& link : lab::virtual_time::links_between(setting.players.size())) {
        const emulator::Patch up = all_of(drawn_conditions(draw));
        setting.profile.paths.push_back({link, up, all_of(drawn_conditions(draw))});
        heals.paths.push_back({link, healed, healed});
    }
    setting.profile.timeline = {std::move(heals)};
    if (draw.one_in(2)) setting.wait_for = 2;
    const auto algorithm = peer::algorithm_named(algorithms.at(draw.below(algorithms.size())));
    for (auto& player : setting.players) player.algorithm = algorithm.value();
}

Setting drawn_setting(const Asked& asked, Draws& draw, base::Duration heals_at)
{
    Setting setting;
    setting.seed = base::Seed{asked.seed};
    setting.length = length;
    setting.energy_limit = true;
    setting.players.resize(asked.peers);
    (asked.peers == 2 ? draw_pair : draw_group)(setting, draw, heals_at);
    for (auto& player : setting.players) {
        player.phase = draw.up_to(999us);
        player.clock_ahead = draw.up_to(2000s) - 1000s;
        if (is_keyed(asked.seal)) player.circle = setting.seed;
        player.has_shared_key = asked.seal == Seal::keys;
    }
    if (is_keyed(asked.seal)) {
        setting.length = sealed_length;
        // Damage is the attacker's alone: he keeps the book.
        setting.profile.path.up.corrupt = setting.profile.path.down.corrupt = {};
        for (emulator::PathPatch& path : setting.profile.paths)
            path.up.corrupt = path.down.corrupt = emulator::Corruption{};
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
    std::optional<base::TimePoint> let_go;        // its hands are off
    std::optional<base::TimePoint> settled_since; // and all others are heard
    struct Heard {
        std::optional<base::TimePoint> arrived; // its newest state, by the side's clock
        base::TimePoint at;
        std::optional<base::TimePoint> touches_unheard_since{}; // and is not gone
    };
    std::vector<Heard> others; // in the order of the side's lines
};

std::uint64_t heard(const peer::Counters& c)
{
    return c.states + c.hellos + c.byes + c.outdated + c.other_session + c.malformed +
           c.other_version + c.implausible;
}

class Play {
public:
    explicit Play(const Asked& asked);
    [[nodiscard]] AttackedSession run() &&;

private:
    [[nodiscard]] base::Duration elapsed() const { return world_.now() - VirtualWorld::start; }
    [[nodiscard]] std::size_t sides() const { return world_.sides(); }
    [[nodiscard]] bool is_damaged() const;
    void draw_troubles();
    void begin_watch(std::size_t index);
    void set_clocks();
    void let_die();
    void judge(std::size_t index);
    void judge_links(std::size_t index);
    void judge_forces(std::size_t index);
    void judge_energy(std::size_t index);
    void judge_others(std::size_t index);
    [[nodiscard]] bool is_settled(std::size_t index) const;
    [[nodiscard]] bool let_go_together() const;
    void judge_agreement();
    void judge_multiplications();
    [[nodiscard]] bool is_over() const;
    template <typename... Values>
    void complain(fmt::format_string<Values...> words, Values&&... values)
    {
        if (result_.complaint) return;
        const Setting& setting = world_.setting();
        result_.complaint =
            fmt::format(
                "{} of {}, {}, attacked for {:.3f} s, after {:.6f} s: ", name_of(setting.task),
                sides(), peer::algorithm_names.at(setting.players[0].algorithm.index()),
                base::to_seconds(attack_), base::to_seconds(elapsed())) +
            fmt::format(words, std::forward<Values>(values)...);
    }

    Draws draw_;
    base::Duration attack_;
    base::Duration begins_within_;
    VirtualWorld world_;
    Habits habits_;
    Mallory mallory_;
    std::vector<Clock> clocks_;
    std::vector<Death> deaths_;
    std::vector<Watch> watches_;
    std::uint64_t multiplied_ = 0; // on the curve, before the step
    AttackedSession result_;
};

Play::Play(const Asked& asked)
    : draw_{base::Seed{asked.seed}, "attacked session"},
      attack_{2s + draw_.up_to(attack_max - 2s)},
      begins_within_{is_keyed(asked.seal) ? begins_within_sealed : begins_within},
      world_{drawn_setting(asked, draw_, attack_),
             {.datagrams_max = asked.peers == 2 ? 16'384U : 4096U, .bytes_max = 16U << 20}},
      habits_{drawn_habits(draw_)},
      mallory_{world_, base::Seed{asked.seed}, habits_},
      clocks_(asked.peers),
      watches_(asked.peers)
{
    draw_troubles();
    // A hello that this side's former run sent is that of another peer with its id.
    const bool claims_its_id = habits_.reflect > 0.0 && !deaths_.empty();
    // To a pair what another says is forged.
    const bool crosses = habits_.reflect > 0.0 && sides() > 2;
    const bool is_taken_for_true =
        claims_its_id || crosses || is_damaged() ||
        habits_.forge + habits_.flip + habits_.splice + habits_.storm > 0.0;
    result_.is_forged = !is_keyed(asked.seal) && is_taken_for_true;
}

bool Play::is_damaged() const
{
    const emulator::Profile& profile = world_.setting().profile;
    const auto is_way = [](const auto& conditions) {
        return conditions.corrupt.share.fraction() > 0.0;
    };
    const auto is_patched = [](const emulator::Patch& patch) {
        return patch.corrupt && patch.corrupt->share.fraction() > 0.0;
    };
    return is_way(profile.path.up) || is_way(profile.path.down) ||
           std::ranges::any_of(profile.paths, [&](const emulator::PathPatch& path) {
               return is_patched(path.up) || is_patched(path.down);
           });
}

/// Clocks that are wrong, and deaths.
void Play::draw_troubles()
{
    for (std::size_t side = 0; side < sides(); ++side) {
        Clock& clock = clocks_[side];
        clock.ahead = world_.side(side).clock_ahead;
        if (!draw_.one_in(3)) clock.skew = 200e-6 * (2.0 * draw_.share() - 1.0);
        if (draw_.one_in(6)) {
            clock.jump = draw_.up_to(jump_max);
            clock.jumps_at = draw_.up_to(attack_);
        }
        begin_watch(side);
    }
    for (std::size_t side = 0; side < sides(); ++side) {
        if (!draw_.one_in(3)) continue;
        const base::Duration at = draw_.up_to(attack_);
        deaths_.push_back({side, at, draw_.up_to(attack_ - at)}); // one a side at most
    }
}

/// Of a new run.
void Play::begin_watch(std::size_t index)
{
    Watch& watch = watches_[index];
    watch = Watch{};
    watch.let_in_before = mallory_.let_in(index);
    watch.last_taken = world_.now();
    watch.others.assign(sides() - 1, {std::nullopt, world_.now(), {}});
}

AttackedSession Play::run() &&
{
    bool is_healed = false;
    while (!is_over() && !result_.complaint) {
        set_clocks();
        let_die(); // those that are started again multiply before their first tick
        multiplied_ = multiplications();
        world_.step();
        for (std::size_t side = 0; side < sides(); ++side) judge(side);
        judge_agreement();
        if (!is_healed && elapsed() >= attack_) {
            is_healed = true;
            mallory_.leave();
        }
        mallory_.act();
        judge_multiplications();
    }
    const bool must_agree = !result_.is_forged && !result_.compared && let_go_together();
    if (must_agree) complain("they never played together once all was well");
    for (std::size_t side = 0; side < sides(); ++side) result_.datagrams += mallory_.given(side);
    return result_;
}

bool Play::is_over() const
{
    if (elapsed() > attack_ + world_.setting().length + begins_within_) return true;
    if (elapsed() < attack_) return false;
    if (result_.compared) return true;
    for (std::size_t side = 0; side < sides(); ++side) {
        const bool is_done =
            world_.is_alive(side) && world_.side(side).last().phase == Phase::ended;
        if (!is_done) return false;
    }
    return true;
}

void Play::set_clocks()
{
    for (std::size_t side = 0; side < sides(); ++side) {
        if (world_.is_alive(side)) world_.side(side).clock_ahead = clocks_[side].at(elapsed());
    }
}

void Play::let_die()
{
    for (Death& death : deaths_) {
        const bool is_dead = !world_.is_alive(death.side);
        if (!is_dead && elapsed() >= death.at && death.lasts > base::Duration{0}) {
            world_.kill(death.side);
            result_.work_5s_max_j =
                std::max(result_.work_5s_max_j, watches_[death.side].work.most_j());
        } else if (is_dead && elapsed() >= death.at + death.lasts) {
            world_.revive(death.side);
            death.lasts = {};
            begin_watch(death.side);
            mallory_.note_restart(death.side);
            world_.side(death.side).date_ahead = draw_.up_to(48h) - 24h;
            set_clocks();
        }
    }
}

void Play::judge(std::size_t index)
{
    if (!world_.is_alive(index)) return;
    judge_links(index);
    if (world_.side(index).stepped_at != world_.now()) return;
    const peer::Counters& counters = world_.side(index).peer().counters();
    const std::uint64_t given = mallory_.let_in(index) - watches_[index].let_in_before;
    if (heard(counters) != given) {
        complain("side {}: {} messages in its counters, {} given", index, heard(counters), given);
    }
    if (mallory_.breach()) complain("side {}: {}", index, *mallory_.breach());
    judge_forces(index);
    judge_energy(index);
    judge_others(index);
}

void Play::judge_links(std::size_t index)
{
    for (std::size_t to = 0; to < sides(); ++to) {
        if (to == index) continue;
        const auto& link = world_.link(index, to).statistics();
        if (link.received + link.duplicated !=
            link.delivered + link.dropped_total() + link.in_flight)
            complain("link from {} to {}: its counters do not add up", index, to);
    }
}

void Play::judge_forces(std::size_t index)
{
    const VirtualPlayer& side = world_.side(index);
    Watch& watch = watches_[index];
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
    if (!base::is_finite(body) || std::abs(body.x()) > body_within_m(sides())) {
        complain("side {}: its body is at x = {} m", index, body.x());
    }
}

void Play::judge_energy(std::size_t index)
{
    const VirtualPlayer& side = world_.side(index);
    Watch& watch = watches_[index];
    const base::Position hip = side.side->sample().hip;
    if (watch.hip) {
        const double work_j = glm::dot(watch.held.value, (hip - *watch.hip).value);
        watch.work.add(work_j, world_.now() + side.clock_ahead);
    }
    watch.hip = hip;
    watch.held = side.told();
    result_.work_5s_max_j = std::max(result_.work_5s_max_j, watch.work.most_j());
    if (watch.work.most_j() > work_max_j) {
        complain("side {}: {} J into the hand within 5 s", index, watch.work.most_j());
    }
}

/// No hand counts that was not heard lately. Beside one that may be on the body, unheard, a side
/// feels nothing until that one counts as gone. It may come to be such a one late, too: when its
/// goodbye turns out to have been forged.
void Play::judge_others(std::size_t index)
{
    const VirtualPlayer& side = world_.side(index);
    const base::TimePoint here = world_.now() + side.clock_ahead;
    for (std::size_t i = 0; i < side.peer().others().size(); ++i) {
        const peer::Remote& other = side.peer().others()[i];
        Watch::Heard& heard = watches_[index].others[i];
        const auto arrived = other.arrived();
        if (arrived != heard.arrived) heard = {arrived, world_.now(), heard.touches_unheard_since};
        const base::Duration silence = world_.now() - heard.at;
        if (silence > silent_after && other.freshness_at(here) > 0.0)
            complain("side {}: counts a hand unheard for {} ms", index, silence / 1ms);
        const bool is_gone =
            !arrived || other.is_gone() || here - *arrived > peer::Others::gone_after;
        const bool touches_unheard =
            !is_gone && other.freshness_at(here) < 1.0 && other.state()->touching;
        if (!touches_unheard) heard.touches_unheard_since.reset();
        if (!touches_unheard) continue;
        const auto since = heard.touches_unheard_since.value_or(world_.now());
        heard.touches_unheard_since = since;
        if (world_.now() - since > fade_takes && side.told() != base::Force{})
            complain("side {}: {} N beside a hand that touched, unheard for {} ms", index,
                     base::norm(side.told()), silence / 1ms);
    }
}

/// Its hands are off, and it hears what all others have sent since all is well: what was on its way
/// before may still come for seconds, and nothing overtakes it where order is kept.
bool Play::is_settled(std::size_t index) const
{
    const VirtualPlayer& side = world_.side(index);
    if (side.last().phase != Phase::hands_off) return false;
    for (std::size_t i = 0; i < side.peer().others().size(); ++i) {
        const Watch::Heard& heard = watches_[index].others[i];
        if (!heard.arrived || world_.now() - heard.at >= silent_after) return false;
        const VirtualPlayer& other = world_.side(i < index ? i : i + 1);
        const base::TimePoint sent = side.peer().others()[i].state()->sent;
        if (sent - other.clock_ahead < VirtualWorld::start + attack_) return false;
    }
    return true;
}

/// For long enough to compare their copies; also when one of them never did.
bool Play::let_go_together() const
{
    const auto by_let_go = [](const Watch& a, const Watch& b) { return a.let_go < b.let_go; };
    const auto [first, last] = std::ranges::minmax_element(watches_, by_let_go);
    return !first->let_go || *last->let_go - *first->let_go <= let_go_apart_max;
}

void Play::judge_agreement()
{
    if (elapsed() < attack_ || result_.compared) return;
    bool all_settled = true;
    for (std::size_t side = 0; side < sides(); ++side) {
        if (!world_.is_alive(side)) return;
        Watch& watch = watches_[side];
        if (!watch.let_go && world_.side(side).last().phase == Phase::hands_off)
            watch.let_go = world_.now();
        if (!is_settled(side))
            watch.settled_since.reset();
        else if (!watch.settled_since)
            watch.settled_since = world_.now();
        all_settled = all_settled && watch.settled_since &&
                      world_.now() - *watch.settled_since >= agree_within;
    }
    if (!all_settled) return;
    result_.compared = true;
    const base::Position first = world_.side(0).peer().position();
    for (std::size_t side = 1; side < sides(); ++side) {
        const double apart = base::norm(world_.side(side).peer().position() - first);
        if (apart > agreement_m)
            complain("the copies of 0 and {} are {} mm apart", side, 1e3 * apart);
    }
}

/// Of each side at most one in its tick, and none for what comes in.
void Play::judge_multiplications()
{
    const std::uint64_t made = multiplications() - multiplied_;
    std::uint64_t ticks = 0;
    for (std::size_t side = 0; side < sides(); ++side)
        if (world_.is_alive(side) && world_.side(side).stepped_at == world_.now()) ++ticks;
    if (made > ticks) complain("{} multiplications on the curve in {} ticks", made, ticks);
}

} // namespace

AttackedSession play_attacked(std::uint64_t seed, Seal seal, std::size_t peers)
{
    return Play{{seed, seal, peers}}.run();
}

} // namespace hapnet::test

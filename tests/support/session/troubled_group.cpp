// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/session/troubled_group.hpp"

#include "lab/virtual_time/world.hpp"
#include "scene/text/text.hpp"
#include "tests/support/session/draws.hpp"

#include <algorithm>
#include <chrono>
#include <spdlog/fmt/fmt.h>
#include <utility>
#include <vector>

namespace hapnet::test {

namespace {

using namespace std::chrono_literals;
using lab::virtual_time::VirtualPlayer;
using World = lab::virtual_time::VirtualWorld;
using GroupSetting = lab::virtual_time::Setting;

constexpr base::Duration group_length = 12s; // 9 s hands on
constexpr base::Duration last_death = 6s;    // since the world began
constexpr base::Duration longest_way = 50ms;
constexpr base::Duration faded_after = 300ms + 2ms; // held, faded, and a tick of each side
constexpr base::Duration touched_for = 60ms;        // longer than a run of lost states
constexpr base::Duration zero_until = 900ms;        // after a death; gone after 1 s of silence
constexpr double group_force_max_n = 3.3 + 1e-12;
constexpr double group_agreement_m = 0.1e-3;

/// Two halves of a group that cannot hear each other at first; each has at least two peers, as many
/// as start without the others.
struct Partition {
    std::size_t half = 0; // the sides below it are in the one, the others in the other; 0: there is
                          // no partition
    base::Duration heals{};
};

Partition drawn_partition(base::Seed seed, std::size_t peers)
{
    Draws draw{seed, "partition of a troubled group"};
    if (peers < 4 || !draw.one_in(3)) return {};
    const std::size_t half = 2 + draw.below(static_cast<std::uint32_t>(peers) - 3);
    return {half, draw.up_to(4s)};
}

GroupSetting drawn_group(base::Seed seed, std::size_t peers, Draws& draw, Seal seal)
{
    GroupSetting setting{.task = device::Task::t7};
    const auto carry =
        scene::load_scene("carry", [](const std::string& file) { return base::fail(file); });
    setting.scene = carry.value();
    setting.seed = seed;
    setting.length = group_length;
    setting.energy_limit = true;
    const auto loss = base::Probability::from_fraction(0.3 * draw.share()).value();
    emulator::Conditions both;
    both.loss = {emulator::RandomLoss{loss}};
    both.delay = emulator::constant(40ms);
    both.jitter = emulator::uniform(draw.up_to(10ms));
    both.order = emulator::Order::free;
    setting.profile.path = {both, both};
    setting.players.resize(peers);
    for (auto& player : setting.players) {
        player.phase = draw.up_to(999us);
        player.clock_ahead = draw.up_to(2000s) - 1000s;
        if (is_keyed(seal)) player.circle = seed;
        player.has_shared_key = seal == Seal::keys;
    }
    const bool comes_late = peers > 2 && draw.one_in(3);
    setting.wait_for = comes_late ? peers - 1 : 0;
    if (drawn_partition(seed, peers).half > 0) setting.wait_for = 2;
    return setting;
}

/// One of them is not there for a while.
struct Absence {
    std::size_t side = 0;
    base::Duration begin{};
    base::Duration end{};
    bool was_touching = false; // when it was killed, and for some time before
};

class GroupPlay {
public:
    GroupPlay(std::uint64_t seed, std::size_t peers, Seal seal);
    [[nodiscard]] TroubledGroup run() &&;

private:
    [[nodiscard]] base::Duration since_begin() const { return world_.now() - World::start; }
    [[nodiscard]] std::size_t peers() const { return world_.sides(); }
    void come_and_go();
    void part(bool is_cut);
    void judge_side(std::size_t side);
    void judge_absence(const Absence& absence);
    void compare();
    template <typename... Values>
    void complain(fmt::format_string<Values...> words, Values&&... values)
    {
        if (result_.complaint) return;
        result_.complaint =
            fmt::format("{} peers, after {:.6f} s: ", peers(), base::to_seconds(since_begin())) +
            fmt::format(words, std::forward<Values>(values)...);
    }

    Draws draw_;
    World world_;
    Partition partition_;
    std::vector<Absence> absences_;         // one after the other
    std::vector<base::TimePoint> apart_at_; // when a side last did not touch
    TroubledGroup result_;
};

GroupPlay::GroupPlay(std::uint64_t seed, std::size_t peers, Seal seal)
    : draw_{base::Seed{seed}, "troubled group"},
      world_{drawn_group(base::Seed{seed}, peers, draw_, seal)},
      partition_{drawn_partition(base::Seed{seed}, peers)},
      apart_at_(peers, World::start)
{
    part(true);
    base::Duration next = 500ms + draw_.up_to(2s);
    if (world_.setting().wait_for > 0) {
        absences_.push_back({peers - 1, 0s, 1s + draw_.up_to(2s)});
        next += absences_.back().end;
    }
    while (next < last_death) {
        const std::size_t side = draw_.below(static_cast<std::uint32_t>(peers));
        absences_.push_back({side, next, next + 100ms + draw_.up_to(1400ms)});
        next = absences_.back().end + 500ms + draw_.up_to(2s);
    }
}

TroubledGroup GroupPlay::run() &&
{
    const base::Duration end = last_death + group_length + 20s;
    while (!result_.complaint && !result_.compared && since_begin() < end) {
        come_and_go();
        if (partition_.half > 0 && since_begin() >= partition_.heals) part(false);
        world_.step();
        for (std::size_t side = 0; side < peers(); ++side) {
            if (world_.is_alive(side) && world_.side(side).stepped_at == world_.now())
                judge_side(side);
        }
        for (const Absence& absence : absences_) judge_absence(absence);
        compare();
    }
    if (!result_.compared) complain("they never had hands off together");
    for (std::size_t from = 0; from < peers(); ++from) {
        for (std::size_t to = 0; to < peers(); ++to) {
            if (from != to) result_.datagrams += world_.link(from, to).statistics().delivered;
        }
    }
    return result_;
}

void GroupPlay::come_and_go()
{
    for (Absence& absence : absences_) {
        const bool is_there = world_.is_alive(absence.side);
        const bool is_away = since_begin() >= absence.begin && since_begin() < absence.end;
        if (is_away && is_there) {
            absence.was_touching = world_.now() - apart_at_[absence.side] > touched_for;
            world_.kill(absence.side);
        }
        const bool comes_back =
            !is_there && since_begin() >= absence.end && since_begin() < absence.end + 100ms;
        if (comes_back) {
            world_.revive(absence.side);
            apart_at_[absence.side] = world_.now();
        }
    }
}

void GroupPlay::part(bool is_cut)
{
    for (std::size_t a = 0; a < partition_.half; ++a)
        for (std::size_t b = partition_.half; b < peers(); ++b) world_.cut(a, b, is_cut);
}

void GroupPlay::judge_side(std::size_t side)
{
    const VirtualPlayer& player = world_.side(side);
    const base::Force told = player.told();
    if (!base::is_finite(told) || base::norm(told) > group_force_max_n)
        complain("peer {}: a force of {} N", side + 1, base::norm(told));
    if (!base::is_finite(player.peer().position()))
        complain("peer {}: its body is nowhere", side + 1);
    const peer::Counters& counters = player.peer().counters();
    if (counters.malformed + counters.implausible + counters.unusable_hand > 0)
        complain("peer {}: it refused a message of another", side + 1);
    if (!player.last().touched.touching) apart_at_[side] = world_.now();
}

void GroupPlay::judge_absence(const Absence& absence)
{
    const base::Duration faded = absence.begin + longest_way + faded_after;
    if (since_begin() < faded || since_begin() >= absence.end) return;
    for (std::size_t side = 0; side < peers(); ++side) {
        if (side == absence.side || !world_.is_alive(side)) continue;
        const VirtualPlayer& player = world_.side(side);
        if (player.stepped_at != world_.now()) continue;
        const std::size_t other = absence.side < side ? absence.side : absence.side - 1;
        if (player.peer().others()[other].freshness_at(world_.now() + player.clock_ahead) > 0.0)
            complain("peer {} counts the hand of {}, which is dead", side + 1, absence.side + 1);
        // One that died before this one met it again, or beyond a cut, was not heard to touch.
        const auto arrived = player.peer().others()[other].arrived();
        const bool was_heard =
            arrived && *arrived - player.clock_ahead >= World::start + absence.begin - touched_for;
        const bool must_be_zero =
            was_heard && absence.was_touching && since_begin() < absence.begin + zero_until;
        if (must_be_zero && player.told() != base::Force{})
            complain("peer {} feels {} N beside {}, which died touching", side + 1,
                     base::norm(player.told()), absence.side + 1);
    }
}

/// Near the end of hands off, when all have been there for long.
void GroupPlay::compare()
{
    const auto is_off = [](const VirtualPlayer& player) {
        return player.last().phase == peer::Phase::hands_off;
    };
    if (!world_.is_alive(0) || !is_off(world_.side(0))) return;
    const VirtualPlayer& first = world_.side(0);
    const base::TimePoint ends =
        first.peer().session()->start - first.clock_ahead + first.peer().length();
    if (world_.now() < ends - 300ms) return;
    result_.compared = true;
    double apart_m = 0.0;
    for (std::size_t side = 1; side < peers(); ++side) {
        if (!world_.is_alive(side) || !is_off(world_.side(side)))
            return complain("peer {} is not in the session", side + 1);
        apart_m = std::max(
            apart_m, base::norm(world_.side(side).peer().position() - first.peer().position()));
    }
    if (apart_m > group_agreement_m) complain("the copies are {} mm apart", 1e3 * apart_m);
}

} // namespace

TroubledGroup play_troubled_group(std::uint64_t seed, std::size_t peers, Seal seal)
{
    return GroupPlay{seed, peers, seal}.run();
}

} // namespace hapnet::test

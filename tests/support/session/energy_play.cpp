// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/support/session/energy_play.hpp"

#include "lab/virtual_time/world.hpp"
#include "proto/base/math.hpp"
#include "proto/wire/message.hpp"
#include "scene/text/text.hpp"
#include "tests/sim/peer/core/score.hpp"
#include "tests/support/session/draws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <glm/geometric.hpp>
#include <spdlog/fmt/fmt.h>
#include <variant>
#include <vector>

namespace hapnet::test {

namespace {

using namespace std::chrono_literals;
using lab::virtual_time::VirtualWorld;

double between(Draws& draw, double least, double most)
{
    return least + (most - least) * draw.share();
}

/// Evenly over the logarithm.
double scaled(Draws& draw, double least, double most)
{
    return least * std::exp(draw.share() * std::log(most / least));
}

emulator::Conditions drawn_network(Draws& draw, EnergyCase& one)
{
    const base::Duration delay = draw.up_to(400ms);
    const base::Duration jitter = draw.one_in(2) ? std::min(delay, draw.up_to(60ms)) : 0ms;
    emulator::Conditions both{.delay = emulator::constant(delay)};
    if (jitter > 0ms) both.jitter = emulator::uniform(jitter);
    both.order = emulator::Order::free;
    one.age_max = delay + jitter + 3ms;
    one.words = fmt::format("{} ms +- {} ms", delay / 1ms, jitter / 1ms);
    const std::size_t kind = draw.below(3);
    if (kind == 1) {
        const double lost = between(draw, 0.1, 0.97);
        both.loss = {emulator::RandomLoss{base::Probability::from_fraction(lost).value()}};
        // Longer gaps occur once in e^9 messages.
        one.age_max += base::from_seconds(-9e-3 / std::log(lost));
        one.words += fmt::format(", {:.0f} % lost", 100.0 * lost);
    } else if (kind == 2) {
        const auto lost = static_cast<std::uint32_t>(10 + draw.below(81));
        both.loss = {emulator::Burst{lost, 100, {}}};
        one.age_max += lost * 1ms;
        one.words += fmt::format(", bursts of {}", lost);
    }
    if (draw.one_in(3)) both.duplicate = {base::Probability::from_fraction(0.1).value(), 50ms};
    return both;
}

device::Operator drawn_person(Draws& draw)
{
    device::Operator person;
    person.hand = {.mass_kg = scaled(draw, 0.1, 0.6),
                   .damping_ns_per_m = scaled(draw, 1.0, 16.0),
                   .stiffness_n_per_m = scaled(draw, 50.0, 1000.0)};
    return person;
}

/// Gives each player a device whose friction is not the one that it states.
void draw_devices(std::uint64_t seed, EnergyCase& one)
{
    Draws draw{base::Seed{seed}, "devices"};
    for (auto& player : one.setting.players) {
        player.omni.friction_n = between(draw, 0.0, 0.5);
        player.omni.stated_friction_n = between(draw, 0.0, 0.5);
        one.words += fmt::format(", friction {:.2f} N stated as {:.2f} N", player.omni.friction_n,
                                 *player.omni.stated_friction_n);
    }
}

/// One who watches the hands, and stands between the links and the sides.
class EnergyPlay {
public:
    EnergyPlay(const EnergyCase& one, Delivery delivery)
        : case_{one}, delivery_{delivery}, world_{one.setting}, hands_(world_.sides())
    {
        earlier_.resize(world_.sides() * world_.sides());
        world_.intercept([this](const VirtualWorld::Arrival& arrival) { pass(arrival); });
    }

    EnergyPlayed run() &&
    {
        sim::run_until_started(world_);
        for (const std::size_t side : {0U, 1U}) {
            if (world_.side(side).last().phase == peer::Phase::running) played_.has_begun = true;
        }
        const base::TimePoint end = world_.now() + world_.side(0).peer().hands_on();
        while (world_.now() < end) {
            world_.step();
            watch();
        }
        for (const Watched& hand : hands_) played_.withdrawn_j += hand.withdrawn_j;
        played_.hash = hash_.value();
        return played_;
    }

private:
    /// A hand's work on its device, and the highest that it was within the longest age.
    struct Watched {
        bool is_known = false;
        base::Position hip;
        base::Force told;
        double work_j = 0.0;
        double withdrawn_j = 0.0;
        std::deque<std::pair<base::TimePoint, double>> highest{}; // falling
    };

    void watch()
    {
        double sum_j = 0.0;
        for (std::size_t i = 0; i < hands_.size(); ++i) {
            hash_.add(world_, i);
            add(hands_[i], i);
            sum_j += hands_[i].work_j;
        }
        played_.least_j = std::min(played_.least_j, sum_j);
    }

    void add(Watched& hand, std::size_t side)
    {
        const base::Position hip = world_.side(side).side->sample().hip;
        if (hand.is_known) {
            const double work_j = -glm::dot(hand.told.value, (hip - hand.hip).value);
            hand.work_j += work_j;
            played_.work_j += std::max(0.0, work_j);
        }
        hand.is_known = true;
        hand.hip = hip;
        hand.told = world_.side(side).told();
        played_.is_finite = played_.is_finite && base::is_finite(hand.told) &&
                            base::is_finite(world_.side(side).peer().position());
        while (!hand.highest.empty() && hand.highest.back().second <= hand.work_j)
            hand.highest.pop_back();
        hand.highest.emplace_back(world_.now(), hand.work_j);
        while (hand.highest.front().first < world_.now() - case_.age_max) hand.highest.pop_front();
        hand.withdrawn_j = std::max(hand.withdrawn_j, hand.highest.front().second - hand.work_j);
    }

    void pass(const VirtualWorld::Arrival& arrival)
    {
        const std::size_t line = arrival.from < arrival.to ? arrival.from : arrival.from - 1;
        const auto give = [&](std::span<const std::byte> bytes) {
            world_.side(arrival.to).receive(line, bytes, arrival.at);
        };
        const auto message = wire::decode(arrival.datagram);
        const auto* const state = message ? std::get_if<wire::State>(&*message) : nullptr;
        if (state == nullptr) return give(arrival.datagram);
        wire::State said = *state;
        if (case_.liar == arrival.from) {
            const double seconds = base::to_seconds(world_.now() - VirtualWorld::start);
            said.intention.value.x += 0.02 * base::sin(base::two_pi * 6.0 * seconds);
        }
        const wire::Datagram datagram = wire::encode(said);
        give(datagram.bytes());
        if (delivery_ == Delivery::once) return;
        give(datagram.bytes());
        auto& earlier = earlier_[arrival.from * world_.sides() + arrival.to];
        if (earlier.size() == 40) {
            give(earlier.front().bytes());
            earlier.pop_front();
        }
        earlier.push_back(datagram);
    }

    const EnergyCase& case_;
    Delivery delivery_;
    VirtualWorld world_;
    std::vector<Watched> hands_;
    std::vector<std::deque<wire::Datagram>> earlier_; // by from and to
    sim::Hash hash_;
    EnergyPlayed played_;
};

} // namespace

std::uint64_t energy_sessions(std::uint64_t usual)
{
    const char* const asked = std::getenv("HAPNET_ENERGY_SESSIONS");
    return asked == nullptr ? usual : std::strtoull(asked, nullptr, 10);
}

EnergyCase drawn_energy_case(std::uint64_t seed, const peer::Algorithm& algorithm,
                             base::Duration duration)
{
    using device::Task;
    Draws draw{base::Seed{seed}, "energy"};
    EnergyCase one;
    const std::size_t players = peer::plays_with_many(algorithm) ? 2 + seed % 4 : 2;
    const std::array tasks{Task::t1, Task::t2, Task::t3, players == 2 ? Task::t6 : Task::t7};
    lab::virtual_time::Setting& setting = one.setting;
    setting.task = tasks.at(draw.below(tasks.size()));
    if (players > 2) setting.scene = scene::load_scene("carry", {}).value();
    setting.seed = base::Seed{seed};
    setting.length = duration;
    const emulator::Conditions both = drawn_network(draw, one);
    setting.profile.path = {both, both};
    setting.players.resize(players);
    for (auto& player : setting.players) {
        player.algorithm = algorithm;
        player.person = drawn_person(draw);
        player.phase = draw.up_to(999us);
    }
    if (seed % 2 == 1) draw_devices(seed, one);
    if (draw.one_in(3)) one.liar = draw.below(static_cast<std::uint32_t>(players));
    one.words = fmt::format("seed {}: {} of {}, {}{}", seed, name_of(setting.task), players,
                            one.words, one.liar ? ", one lies" : "");
    return one;
}

EnergyPlayed play_for_energy(const EnergyCase& one, Delivery delivery)
{
    return EnergyPlay{one, delivery}.run();
}

double remote_proxy_bound_j(const EnergyCase& one, const EnergyPlayed& played)
{
    constexpr double in_a_contact_j = 0.011; // of 500 N/m at the greatest force, 3.3 N
    constexpr double in_motion_j = 0.004;    // of the cube
    constexpr double in_a_tick_j = 0.0033;   // at that force and 1 m/s
    const auto others = static_cast<double>(one.setting.players.size() - 1);
    const double age_s = std::min(0.4, base::to_seconds(one.age_max));
    const peer::RemoteProxyOptions usual;
    const double lent_j = usual.account_j + usual.power_w * age_s;
    return lent_j + in_motion_j + in_a_tick_j + others * (in_a_contact_j + in_motion_j) +
           played.withdrawn_j;
}

} // namespace hapnet::test

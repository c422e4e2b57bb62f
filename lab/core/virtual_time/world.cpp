// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/core/virtual_time/world.hpp"

#include <cmath>
#include <utility>

namespace hapnet::sim {

using std::chrono::milliseconds;
using std::chrono::seconds;

Side::Side(const Setting& setting, std::uint16_t id_of_side, std::uint32_t nonce)
    : omni{std::make_unique<device::SimulatedOmni>(setting.task, device::HandImpedance{},
                                                   device::OmniPlant{})},
      id{id_of_side}
{
    peer::Settings settings;
    settings.introduction.id = id_of_side;
    settings.introduction.nonce = nonce;
    settings.introduction.scene_hash = scene::hash(settings.scene);
    settings.introduction.seed = setting.seed.value() + id_of_side;
    settings.introduction.task = wire::TaskName::from_text(device::name_of(setting.task)).value();
    settings.length = setting.length;
    peer = std::make_unique<peer::Peer>(settings);
}

World::World(const Setting& setting)
    : setting_{setting},
      links_{emulator::Link{setting.up, {setting.seed, emulator::Direction::up, now_, {}}},
             emulator::Link{setting.down, {setting.seed, emulator::Direction::down, now_, {}}}}
{
    revive(0);
    revive(1);
}

void World::kill(std::size_t side) { sides_[side].reset(); }

void World::revive(std::size_t side)
{
    sides_[side].emplace(setting_, static_cast<std::uint16_t>(side + 1), next_nonce_++);
}

double World::discrepancy_x() const
{
    return std::abs(sides_[0]->peer->body().position.x() - sides_[1]->peer->body().position.x());
}

void World::deliver(std::size_t from)
{
    auto& receiver = sides_[1 - from];
    const auto hand_over = [&](const emulator::Departure& departure) {
        if (receiver) {
            receiver->peer->on_datagram(departure.bytes, departure.due + receiver->clock_ahead);
        }
        links_[from].on_sent(departure, now_);
    };
    for (auto& passing : undelayed_[from]) {
        passing.departure.bytes = passing.bytes;
        hand_over(passing.departure);
    }
    undelayed_[from].clear();
    while (const auto departure = links_[from].poll(now_)) hand_over(*departure);
}

void World::turn(std::size_t index)
{
    if (!sides_[index]) return;
    Side& side = *sides_[index];
    const base::TimePoint now = now_ + side.clock_ahead;
    const device::Sample sample = side.omni->read(now);
    side.last = side.peer->tick(now, {sample.hip, sample.velocity, sample.gripping});
    side.applied = side.governor.limit(side.last.force, side.last.permitted, now);
    side.omni->apply(side.applied);
    while (const auto datagram = side.peer->poll()) {
        if (cut_) continue;
        const auto admission = links_[index].on_packet(datagram->bytes(), now_);
        if (!admission.departure) continue;
        const auto bytes = admission.departure->bytes;
        undelayed_[index].push_back({*admission.departure, {bytes.begin(), bytes.end()}});
    }
    while (const auto event = side.peer->event()) side.events.push_back(*event);
    const auto& session = side.peer->session();
    if (session && side.cued != session->start) {
        side.cued = session->start;
        side.omni->on_cue({session->start, side.peer->hands_on(), base::Seed{session->seed},
                           side.id, session->is_left});
    }
}

void World::step()
{
    now_ += milliseconds{1};
    deliver(0);
    deliver(1);
    turn(0);
    turn(1);
}

void World::run_for(base::Duration duration)
{
    const auto end = now_ + duration;
    while (now_ < end) step();
}

void World::run_until_started()
{
    const auto end = now_ + seconds{10};
    const auto runs = [this](std::size_t i) {
        return sides_[i]->last.phase == peer::Phase::running;
    };
    while (now_ < end && !(runs(0) && runs(1))) step();
}

} // namespace hapnet::sim

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/virtual_time/one_world.hpp"

#include "lab/virtual_time/player.hpp"
#include "lab/virtual_time/world.hpp"
#include "peer/core/finger_friction.hpp"
#include "peer/core/passivity.hpp"
#include "peer/core/settings.hpp"
#include "peer/core/shared_body.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace hapnet::lab::virtual_time {

namespace {

/// The time in which hands come to rest where their task begins.
constexpr base::Duration countdown{std::chrono::seconds{1}};
constexpr std::int64_t ticks_between_looks = 1024; // ticks between two looks at `stop`

/// Returns the share of a contact's force that a peer renders.
double rendered_share(const Setting& setting)
{
    const peer::Settings usual;
    const auto wall = peer::hardest_wall(setting.scene);
    return std::min(
        peer::share_within(usual.stiffness_max_n_per_m, wall),
        peer::passive_share(wall, base::to_seconds(setting.tick), usual.grip_damping_ns_per_m));
}

/// A session with all hands in one scene.
class OneWorld {
public:
    explicit OneWorld(const Setting& setting)
        : setting_{setting},
          bodies_{peer::shared_bodies(setting.scene).value()},
          world_{scene::World::freeze(setting.scene, {.tick = setting.tick}).value()},
          share_{rendered_share(setting)}
    {
        trace_.task = setting.task;
        trace_.tick = setting.tick;
        trace_.sides.resize(setting.players.size());
        trace_.further_bodies = bodies_.size() - 1;
        if (trace_.further_bodies > 0) trace_.further.resize(setting.players.size());
        for (std::size_t seat = 0; seat < setting.players.size(); ++seat) seat_player(seat);
    }

    /// Plays the session. Returns false when `stop` became true meanwhile.
    bool play(const std::atomic<bool>* stop)
    {
        const base::TimePoint start = VirtualWorld::start + countdown;
        const base::TimePoint end = start + hands_on();
        std::int64_t ticks = 0;
        for (base::TimePoint now = VirtualWorld::start; now < end; now += setting_.tick) {
            const bool looks = stop != nullptr && ticks++ % ticks_between_looks == 0;
            if (looks && stop->load(std::memory_order_relaxed)) return false;
            step(now, now >= start);
        }
        trace_.overlap = 1.0;
        trace_.simulated = countdown + hands_on();
        return true;
    }

    [[nodiscard]] Trace trace() && { return std::move(trace_); }

private:
    struct Hand {
        device::Rig rig;
        std::optional<peer::FingerFriction> friction{};
        device::Sample sample{};
        base::Force rubbing{};
    };

    [[nodiscard]] base::Duration hands_on() const
    {
        return peer::Peer::hands_on_of(setting_.length);
    }

    void seat_player(std::size_t seat)
    {
        const std::size_t all = setting_.players.size();
        const bool is_left = seat % 2 == 0;
        Hand& hand = hands_.emplace_back(Hand{make_rig(setting_, {seat})});
        const auto& hips = setting_.scene.hands;
        if (hips.friction > 0.0) hand.friction.emplace(hips);
        hand.rig.on_cue({VirtualWorld::start + countdown, hands_on(), setting_.seed,
                         static_cast<std::uint16_t>(seat + 1), is_left,
                         1.0 / static_cast<double>(is_left ? all - all / 2 : all / 2), seat < 2});
    }

    void step(base::TimePoint now, bool plays)
    {
        for (Hand& hand : hands_) hand.sample = hand.rig.read(now);
        if (!plays) {
            for (Hand& hand : hands_) hand.rig.apply({}, false, now);
            return;
        }
        for (std::size_t seat = 0; seat < hands_.size(); ++seat) put_in(seat);
        world_.tick();
        for (std::size_t seat = 0; seat < hands_.size(); ++seat) take_out(seat, now);
    }

    void put_in(std::size_t seat)
    {
        Hand& hand = hands_[seat];
        const bool is_there = is_in_hand(hand.sample);
        const scene::HandInput input{.position = is_there ? hand.sample.hip : base::Position{},
                                     .velocity = is_there ? hand.sample.velocity : base::Velocity{},
                                     .present = is_there,
                                     .gripping = hand.sample.gripping};
        world_.set_hand(static_cast<std::uint32_t>(seat), input);
        if (!hand.friction) return;
        const scene::BodyId body = bodies_.front().id;
        hand.rubbing = hand.friction->on_body(input, world_.body(body));
        world_.push(body, hand.rubbing);
    }

    void take_out(std::size_t seat, base::TimePoint now)
    {
        Hand& hand = hands_[seat];
        scene::HandTouch touch = world_.touch(static_cast<std::uint32_t>(seat));
        if (hand.friction) {
            hand.friction->on_touch(touch);
            touch.on_body += hand.rubbing;
            touch.on_hand += -hand.rubbing;
        }
        const base::Force told =
            hand.rig.apply(share_ * touch.on_hand, is_in_hand(hand.sample), now);
        const scene::BodyState body = world_.body(bodies_.front().id);
        trace_.sides[seat].push_back({.body = body.position,
                                      .body_velocity = body.velocity,
                                      .orientation = body.orientation,
                                      .hip = hand.sample.hip,
                                      .hip_velocity = hand.sample.velocity,
                                      .on_hand = told,
                                      .on_body = touch.on_body,
                                      .touching = touch.touching,
                                      .holding = touch.holding,
                                      .remote_touching = is_touched_beside(seat)});
        for (std::size_t i = 1; i < bodies_.size(); ++i) {
            const scene::BodyState further = world_.body(bodies_[i].id);
            trace_.further[seat].push_back({further.position, further.orientation});
        }
    }

    /// True if another hand touches.
    [[nodiscard]] bool is_touched_beside(std::size_t seat) const
    {
        for (std::uint32_t other = 0; other < hands_.size(); ++other)
            if (other != seat && world_.touch(other).touching) return true;
        return false;
    }

    const Setting& setting_;
    std::vector<peer::SharedBody> bodies_;
    scene::World world_;
    double share_;
    std::vector<Hand> hands_;
    Trace trace_;
};

} // namespace

base::Result<Trace> play_in_one_world(const Setting& setting, const std::atomic<bool>* stop)
{
    OneWorld world{setting};
    if (!world.play(stop)) return base::fail("stopped before its end");
    return std::move(world).trace();
}

} // namespace hapnet::lab::virtual_time

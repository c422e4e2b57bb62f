// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/remote_proxy.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace hapnet::peer {

namespace {

/// Returns the hand of the scene that represents one of the others.
std::uint32_t hand_of(std::size_t other)
{
    return own_hand + 1 + static_cast<std::uint32_t>(other);
}

/// True if there is one body and it does not turn. Otherwise PoseCorrection keeps the copies
/// together.
bool has_one_without_turning(const scene::Bodies& bodies)
{
    return bodies.movable == 1 && bodies.properties.front().turning == scene::Turning::locked;
}

} // namespace

RemoteProxy::RemoteProxy(const RemoteProxyOptions& options) : options_{options} {}

void RemoteProxy::prepare(std::size_t others, const scene::World& world)
{
    proxies_.assign(others, ProxyHand{options_.proxy});
    rubbing_.assign(others, base::Force{});
    const scene::Bodies& bodies = world.state().bodies;
    if (has_one_without_turning(bodies)) {
        past_.assign(past_max, Past{});
    } else {
        poses_.emplace(bodies.movable, PoseCorrection::Rates{options_.correction_rate_hz,
                                                             options_.correction_speed_m_per_s});
    }
}

void RemoteProxy::hear(const ReceivedState& received)
{
    if (!received.taken) return;
    account_j_ += proxies_[received.from].hear(received);
}

void RemoteProxy::forget(std::size_t of) { proxies_[of].forget(); }

/// Lends the energy that may be under way before the report of it arrives, in proportion to the
/// largest age. It is lent once, and not again when ages fall and rise.
void RemoteProxy::lend()
{
    base::Duration age{0};
    for (const ProxyHand& proxy : proxies_) age = std::max(age, proxy.usual_age());
    allowance_j_ = options_.account_j + options_.power_w * base::to_seconds(age);
    if (allowance_j_ > lent_j_) {
        account_j_ += allowance_j_ - lent_j_;
        lent_j_ = allowance_j_;
    }
    account_j_ = std::min(account_j_, 2.0 * allowance_j_);
}

void RemoteProxy::look(const scene::World& world, const Situation& situation)
{
    if (poses_) {
        for (std::size_t i = 0; i < proxies_.size(); ++i)
            proxies_[i].look(view_of(i, world, situation));
        return;
    }
    for (std::size_t i = 0; i < proxies_.size(); ++i) {
        proxies_[i].look({.other = situation.others[i],
                          .there = situation.others[i].body(),
                          .world = world,
                          .now = situation.now,
                          .tick = situation.tick,
                          .own_hand_touches = own_hand_touches_});
    }
}

/// Returns the view of the body that the other hand touches, if bodies turn or if there are
/// several.
ProxyHand::View RemoteProxy::view_of(std::size_t other, const scene::World& world,
                                     const Situation& situation) const
{
    ProxyHand::View view{.other = situation.others[other],
                         .there = situation.others[other].touched(),
                         .world = world,
                         .now = situation.now,
                         .tick = situation.tick};
    if (view.there == nullptr) return view;
    const SharedPoses& poses = *situation.poses;
    const auto index = poses.index_of(view.there->body);
    if (!index) {
        view.there = nullptr;
        return view;
    }
    view.own_hand_touches = poses.mover(*index) == SharedPoses::Mover::own;
    return view;
}

/// Returns the share of the proxies' drives that the account covers.
double RemoteProxy::share() const
{
    double moving_j = 0.0;
    double driving_j = 0.0;
    for (const ProxyHand& proxy : proxies_) {
        moving_j += proxy.kinetic_energy_j();
        driving_j += proxy.drive_energy_j();
    }
    const double left_j = std::max(0.0, account_j_ - moving_j);
    return driving_j > left_j ? std::sqrt(left_j / driving_j) : 1.0;
}

void RemoteProxy::act(scene::World& world, const Situation& situation)
{
    for (std::size_t i = 0; i < proxies_.size(); ++i) {
        ProxyHand& proxy = proxies_[i];
        const scene::HandInput input = proxy.input();
        world.set_hand(hand_of(i), input);
        rubbing_[i] = {};
        if (situation.hands == nullptr || situation.hands->friction == 0.0) continue;
        if (!proxy.finger) proxy.finger.emplace(*situation.hands);
        rubbing_[i] = proxy.finger->on_body(input, world.body(situation.body));
        world.push(situation.body, rubbing_[i]);
    }
}

Outcome RemoteProxy::tick(scene::World& world, const Situation& situation)
{
    lend();
    look(world, situation);
    const double share_now = share();
    act(world, situation);
    world.tick();
    Outcome outcome;
    outcome.touched = world.touch(own_hand);
    outcome.on_hand = outcome.touched.on_hand; // no remote force: the proxies push already
    own_hand_touches_ = outcome.touched.touching;
    if (own_hand_touches_) touched_ = situation.now;
    if (const auto& state = situation.remote.state()) outcome.remote_hip = state->hip;
    move_proxies(world, situation, share_now, outcome);
    if (poses_) {
        account_j_ -= poses_->keep_together({world, situation, proxies_});
        return outcome;
    }
    if (!own_hand_touches_) correct(world, situation);
    remember(world, situation);
    return outcome;
}

void RemoteProxy::move_proxies(const scene::World& world, const Situation& situation, double share,
                               Outcome& outcome)
{
    proxy_force_ = glm::dvec3{0.0};
    if (poses_) poses_->begin_pushes();
    for (std::size_t i = 0; i < proxies_.size(); ++i) {
        ProxyHand& proxy = proxies_[i];
        if (!proxy.is_there()) continue;
        const scene::HandTouch& touch = world.touch(hand_of(i));
        if (proxy.finger) proxy.finger->on_touch(touch);
        account_j_ += proxy.step(touch.on_hand - rubbing_[i],
                                 share * situation.others[i].freshness(), situation.tick);
        const base::Force on_body = touch.on_body + rubbing_[i];
        outcome.remote_touching = true;
        outcome.remote_force = outcome.remote_force + on_body;
        outcome.remote_hip = proxy.place();
        proxy_force_ += on_body.value;
        if (!poses_ || !touch.touching) continue;
        const base::Displacement lever =
            world.state().hands[hand_of(i)].position - world.position(touch.body);
        poses_->add_push(*situation.poses->index_of(touch.body), on_body, lever);
    }
}

bool RemoteProxy::is_anyone_touching(const Situation& situation) const
{
    return own_hand_touches_ || std::ranges::any_of(situation.others, [](const Remote& other) {
               return other.freshness() > 0.0 && other.state() && other.state()->touching;
           });
}

/// Returns the peer with the lowest id among those that are heard and this peer; nullopt stands for
/// this peer.
std::optional<std::size_t> RemoteProxy::lowest(const Situation& situation)
{
    for (std::size_t i = 0; i < situation.lower_ids; ++i)
        if (situation.others[i].freshness() > 0.0) return i;
    return std::nullopt;
}

/// Returns the peer whose pose is authoritative; nullopt stands for this peer. At first it is the
/// peer that touched last. But messages about a touch may have been lost, or an older touch may be
/// reported after this hand's last one. Then several peers consider themselves the last, or none
/// does. So a while after the last touch of any hand it is the lowest id. This decision needs only
/// the newest message of each peer, which arrives sooner or later, so that all copies decide in the
/// same way.
std::optional<std::size_t> RemoteProxy::leader(const Situation& situation) const
{
    std::optional<std::size_t> found;
    std::optional<base::TimePoint> latest = touched_;
    for (std::size_t i = 0; i < proxies_.size(); ++i) {
        const auto& touched = proxies_[i].touched_at();
        if (!touched) continue;
        const bool has_lower_id = !found && i < situation.lower_ids;
        if (!latest || *touched > *latest || (*touched == *latest && has_lower_id)) {
            latest = touched;
            found = i;
        }
    }
    const bool is_quiet = !latest || (situation.now - *latest >= last_touch_counts_for &&
                                      !is_anyone_touching(situation));
    return is_quiet ? lowest(situation) : found;
}

/// Returns the displacement from this copy's body to the leader's. While the leader moves the body,
/// its present place is predicted. Afterwards, places at the same past time are compared. Both
/// copies' places of that time are known, so the delay is not in the loop.
glm::dvec3 RemoteProxy::error_against(std::size_t leader, const Situation& situation,
                                      const scene::BodyState& body) const
{
    const ProxyHand& proxy = proxies_[leader];
    const Remote& remote = situation.others[leader];
    const wire::BodyState& there = *remote.body();
    const base::Duration age = proxy.age(situation.now);
    if (remote.state()->touching) {
        const double ahead_s = proxy.eta() * base::to_seconds(age);
        return there.position.value + ahead_s * there.velocity.value - body.position.value;
    }
    const auto ago = static_cast<std::uint64_t>(age / situation.tick);
    if (ago == 0 || ago > ticks_ || ago >= past_max)
        return there.position.value - body.position.value;
    const Past& then = past_[(ticks_ - ago) % past_max];
    return there.position.value - then.place - (corrected_ - then.corrected);
}

void RemoteProxy::correct(scene::World& world, const Situation& situation)
{
    const auto index = leader(situation);
    if (!index) return;
    const Remote& other = situation.others[*index];
    if (!(other.freshness() > 0.0) || !other.state() || !other.body()) return;
    const scene::BodyState body = world.body(situation.body);
    const glm::dvec3 error = error_against(*index, situation, body);
    const double tick_s = base::to_seconds(situation.tick);
    const base::Velocity speed = base::limited(base::Velocity{options_.correction_rate_hz * error},
                                               options_.correction_speed_m_per_s);
    const glm::dvec3 way = tick_s * speed.value;
    if (way == glm::dvec3{0.0}) return;
    world.shift(situation.body, {way});
    corrected_ += way;
    // A motion against a proxy stretches the springs of the contact with it, and no hand has
    // supplied this energy.
    account_j_ -= std::max(0.0, -glm::dot(proxy_force_, way));
}

void RemoteProxy::remember(const scene::World& world, const Situation& situation)
{
    ++ticks_;
    past_[ticks_ % past_max] = {world.position(situation.body).value, corrected_};
}

} // namespace hapnet::peer

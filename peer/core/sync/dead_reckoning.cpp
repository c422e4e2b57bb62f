// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/dead_reckoning.hpp"

#include "proto/base/quantity.hpp"
#include "proto/base/text.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer {

void HorizonFormat::read(const base::Node& node, Horizon& target, base::Reading& reading) const
{
    const auto* name = std::get_if<std::string>(&node.value);
    const auto found = name == nullptr
                           ? horizon_names.end()
                           : std::find(horizon_names.begin(), horizon_names.end(), *name);
    if (found != horizon_names.end()) {
        target = {static_cast<Horizon::Law>(found - horizon_names.begin()), {}};
        return;
    }
    const auto text = base::quantity(node);
    if (!text || !base::parse_duration(*text)) return base::complain_of(node, describe(), reading);
    base::Duration fixed{};
    parameter_time.read(node, fixed, reading);
    if (reading.is_good()) target = {Horizon::Law::fixed, fixed};
}

std::string HorizonFormat::print(const Horizon& horizon) const
{
    if (horizon.law == Horizon::Law::fixed) return parameter_time.print(horizon.fixed);
    return base::quoted(horizon_names.at(static_cast<std::size_t>(horizon.law)));
}

std::string HorizonFormat::describe() const
{
    return fmt::format("\"{}\" or {}", fmt::join(horizon_names, "\", \""),
                       parameter_time.describe());
}

DeadReckoning::DeadReckoning(const DeadReckoningOptions& options)
    : options_{options}, base_{options.base}, delay_{options.horizon_memory}
{}

void DeadReckoning::hear(const ReceivedState& received)
{
    base_.hear(received);
    const auto age = one_way_delay(received);
    if (age) delay_.add(*age);
    is_clock_known_ = received.clock.estimate().has_value();
    if (!received.taken) return;
    const wire::BodyState* const body = received.state.bodies.first();
    if (body == nullptr && !newest_) return;
    // A message without a body means that nothing moves the body.
    const Fix fix{.place = body != nullptr ? body->position : newest_->place,
                  .arrived = received.arrived,
                  .sent = received.state.sent,
                  .age = std::max(base::Duration{0}, age.value_or(base::Duration{0}))};
    velocity_ = newest_ ? velocity_to(fix, received.span) : base::Velocity{};
    newest_ = fix;
    has_news_ = true;
}

void DeadReckoning::forget()
{
    base_.forget();
    delay_.reset();
    newest_.reset();
    velocity_ = {};
    course_.reset();
    has_news_ = false;
}

base::Velocity DeadReckoning::velocity_to(const Fix& next, base::Duration span) const
{
    const base::Duration sent_apart = next.sent - newest_->sent;
    if (std::chrono::abs(sent_apart) > options_.gap_max) return {};
    base::Duration apart = span;
    if (options_.velocity == VelocityRule::arrival) apart = next.arrived - newest_->arrived;
    if (options_.velocity == VelocityRule::sender) apart = sent_apart;
    // No velocity can be computed from states without a time between them, such as duplicates.
    const bool tells = options_.velocity == VelocityRule::sender ? apart != base::Duration{0}
                                                                 : apart > base::Duration{0};
    if (!tells) return velocity_;
    const base::Displacement moved = next.place - newest_->place;
    const base::Velocity velocity{moved.value / base::to_seconds(apart)};
    return base::limited(velocity, options_.speed_max_m_per_s);
}

base::Duration DeadReckoning::horizon() const
{
    switch (options_.horizon.law) {
    case Horizon::Law::none: break;
    case Horizon::Law::one_way: return is_clock_known_ ? delay_.mean() : base::Duration{0};
    case Horizon::Law::packet_age: return newest_ ? newest_->age : base::Duration{0};
    case Horizon::Law::fixed: return options_.horizon.fixed;
    }
    return base::Duration{0};
}

std::optional<base::Position> DeadReckoning::predicted(base::TimePoint now) const
{
    if (!newest_) return std::nullopt;
    base::Duration ahead = (now - newest_->arrived) + horizon();
    if (options_.ahead_max) ahead = std::min(ahead, *options_.ahead_max);
    return newest_->place + base::limited(velocity_ * ahead, options_.lead_max_m);
}

Outcome DeadReckoning::tick(scene::World& world, const Situation& situation)
{
    CombinedRemote remote = combined_remote(situation, options_.base);
    if (const auto place = predicted(situation.now); place && remote.pose) {
        remote.pose->position = *place;
        if (options_.blend_within) remote.pose->position = blended(*place, world, situation);
    }
    const Outcome outcome = base_.tick(world, situation, remote);
    // The blend restarts from the place where this hand has left the body.
    if (outcome.touched.touching || !remote.touching) course_.reset();
    has_news_ = false;
    return outcome;
}

base::Position DeadReckoning::blended(base::Position target, const scene::World& world,
                                      const Situation& situation)
{
    const base::TimePoint before = situation.now - situation.tick;
    if (!course_) {
        const scene::BodyState own = world.body(situation.body);
        course_ = Course{own.position, own.velocity, before};
    } else if (has_news_) {
        course_ = shown_;
    }
    const base::Duration since = situation.now - course_->start;
    const double share = since < *options_.blend_within
                             ? base::to_seconds(since) / base::to_seconds(*options_.blend_within)
                             : 1.0;
    const base::Velocity old = course_->velocity;
    const base::Velocity velocity{old.value + share * (velocity_.value - old.value)};
    const base::Position onward = course_->from + velocity * since;
    shown_ = Course{onward + share * (target - onward), velocity, situation.now};
    return shown_.from;
}

} // namespace hapnet::peer

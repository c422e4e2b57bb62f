// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/sync/hand_history.hpp"

#include <algorithm>

namespace hapnet::peer {

namespace {

// This is a separate function, because GCC 12 omits the rounding when it vectorises two of three
// such conversions.
[[gnu::noinline]] double as_sent(double component)
{
    return static_cast<double>(static_cast<float>(component));
}

glm::dvec3 as_sent(const glm::dvec3& v) { return {as_sent(v.x), as_sent(v.y), as_sent(v.z)}; }

/// True for the state that represents a hand without a sample: exactly at the origin, at rest. A
/// present hand never has exactly this state.
bool is_nowhere(const HandSample& sample)
{
    return sample.place == glm::dvec3{0.0} && sample.velocity == glm::dvec3{0.0};
}

} // namespace

HandSample HandSample::of(const scene::HandInput& input)
{
    HandSample sample{as_sent(input.position.value), as_sent(input.velocity.value), input.present,
                      input.gripping};
    sample.present = sample.present && !is_nowhere(sample);
    return sample;
}

HandSample HandSample::of(const wire::State& state)
{
    HandSample sample{state.hip.value, state.hip_velocity.value, true, state.holding};
    sample.present = !is_nowhere(sample);
    return sample;
}

scene::HandInput HandSample::input() const
{
    if (!present) return {.present = false};
    return {.position = {place}, .velocity = {velocity}, .gripping = gripping};
}

bool HandHistory::add(std::int64_t tick, const HandSample& sample)
{
    if (tick < 0 || tick <= newest_ - ticks_max || knows(tick)) return false;
    entries_[static_cast<std::size_t>(tick % ticks_max)] = {tick, sample};
    newest_ = std::max(newest_, tick);
    return true;
}

void HandHistory::clear()
{
    for (Entry& each : entries_) each.tick = none;
    newest_ = none;
}

bool HandHistory::knows(std::int64_t tick) const { return tick >= 0 && entry(tick).tick == tick; }

HandSample HandHistory::at(std::int64_t tick, base::Duration length) const
{
    if (is_empty() || tick < 0) return {};
    if (knows(tick)) return entry(tick).sample;
    if (tick < newest_) return between(tick, base::to_seconds(length));
    HandSample held = entry(newest_).sample;
    held.velocity = glm::dvec3{0.0};
    return held;
}

HandSample HandHistory::between(std::int64_t tick, double tick_s) const
{
    const std::int64_t oldest = std::max<std::int64_t>(0, newest_ - ticks_max + 1);
    std::int64_t before = tick - 1, after = tick + 1;
    while (before >= oldest && !knows(before)) --before;
    while (!knows(after)) ++after; // ends at the newest tick, which is known
    if (before < oldest) return {};
    const HandSample& from = entry(before).sample;
    const HandSample& to = entry(after).sample;
    HandSample sample = from;
    if (!from.present || !to.present) {
        sample.velocity = glm::dvec3{0.0};
        return sample;
    }
    const double apart_s = tick_s * static_cast<double>(after - before);
    const double u = static_cast<double>(tick - before) / static_cast<double>(after - before);
    const double v = 1.0 - u;
    const glm::dvec3 way = to.place - from.place;
    sample.place = from.place + u * u * (3.0 - 2.0 * u) * way +
                   (u * v * apart_s) * (v * from.velocity - u * to.velocity);
    sample.velocity = (6.0 * u * v / apart_s) * way + v * (v - 2.0 * u) * from.velocity +
                      u * (u - 2.0 * v) * to.velocity;
    return sample;
}

std::optional<std::int64_t> answered_tick(const ReceivedState& received)
{
    const auto& echo = received.state.echo;
    // An answer to a hello from before the start refers to no tick.
    if (!echo || echo->of < received.start) return std::nullopt;
    return static_cast<std::int64_t>((echo->of - received.start) / received.tick);
}

std::optional<std::int64_t> HeardHand::hear(const ReceivedState& received)
{
    const auto delay = one_way_delay(received);
    if (!delay) return std::nullopt;
    const base::Duration since_start = received.arrived - *delay - received.start;
    const auto count = static_cast<std::int64_t>(received.tick_number) - 1;
    const std::int64_t tick = ticks.number(count, since_start, received.tick);
    const base::Duration latest = received.arrived - received.start + SessionTicks::in_time;
    if (tick * received.tick > latest) return std::nullopt;
    const wire::BodyState* const body = received.state.bodies.first();
    if (received.taken && body != nullptr) {
        told = RestAgreement::Word{.from = received.from,
                                   .tick = tick,
                                   .knows = answered_tick(received).value_or(-1),
                                   .body = body->position};
    }
    return tick;
}

void HeardHand::forget()
{
    history.clear();
    ticks.forget();
    told.reset();
}

} // namespace hapnet::peer

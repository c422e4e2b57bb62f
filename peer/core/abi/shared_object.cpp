// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/core/abi/shared_object.hpp"

#include "proto/base/ensure.hpp"

#include <array>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::peer {

namespace {

hapnet_vector plain(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

glm::dvec3 vector_of(const hapnet_vector& v) { return {v.x, v.y, v.z}; }

std::uint8_t flag(bool value) { return value ? 1 : 0; }

std::int64_t count_of(base::TimePoint time) { return time.time_since_epoch().count(); }

void put_body(const wire::BodyState* body, hapnet_state& to)
{
    to.has_body = flag(body != nullptr);
    if (body != nullptr) to.body = {plain(body->position.value), plain(body->velocity.value)};
}

/// Converts a state, except for the body.
void put_state(const wire::State& state, base::TimePoint arrived, hapnet_state& to)
{
    to.sent_ns = count_of(state.sent);
    to.arrived_ns = count_of(arrived);
    to.hip = plain(state.hip.value);
    to.hip_velocity = plain(state.hip_velocity.value);
    to.contact_force = plain(state.contact_force.value);
    to.intention = plain(state.intention.value);
    to.intention_velocity = plain(state.intention_velocity.value);
    to.sequence = state.sequence;
    to.touching = flag(state.touching);
    to.holding = flag(state.holding);
}

hapnet_clock clock_of(const std::optional<ClockEstimate>& clock)
{
    hapnet_clock result{};
    if (clock) result = {clock->offset.count(), clock->uncertainty.count(), 1, {}};
    return result;
}

void put_other(const Remote& other, hapnet_other& to)
{
    const auto& state = other.state();
    to.freshness = other.freshness();
    to.id = other.id();
    to.heard = flag(state.has_value());
    if (state) put_state(*state, *other.arrived(), to.state);
    put_body(other.body(), to.state);
}

/// Access to this peer's copy of the scene during a call.
struct Access {
    scene::World& world;
    scene::BodyId body{};
    bool has_ticked = false;
};

Access& access(void* handle) { return *static_cast<Access*>(handle); }

void read_body(void* handle, hapnet_body* body)
{
    const Access& at = access(handle);
    *body = {plain(at.world.position(at.body).value), plain(at.world.velocity(at.body).value)};
}

void push(void* handle, const hapnet_vector* force)
{
    Access& at = access(handle);
    if (!at.has_ticked) at.world.push(at.body, base::Force{vector_of(*force)});
}

void tick_once(void* handle)
{
    Access& at = access(handle);
    if (std::exchange(at.has_ticked, true)) return;
    at.world.tick();
}

void read_touch(void* handle, hapnet_touch* touch)
{
    const scene::HandTouch& own = access(handle).world.touch(own_hand);
    *touch = {plain(own.on_body.value), plain(own.on_hand.value), own.depth_m,
              flag(own.touching),       flag(own.holding),        {}};
}

void place(void* handle, const hapnet_body* body)
{
    Access& at = access(handle);
    at.world.place(at.body, base::Position{vector_of(body->position)},
                   base::Velocity{vector_of(body->velocity)});
}

/// Returns a vector from the loaded code, or zero if it is not finite.
glm::dvec3 finite(const hapnet_vector& v)
{
    const glm::dvec3 vector = vector_of(v);
    return base::is_finite(vector) ? vector : glm::dvec3{0.0};
}

base::Result<void> check(const hapnet_algorithm& loaded)
{
    if (loaded.abi != HAPNET_ALGORITHM_ABI) {
        return base::fail(fmt::format("it is for version {} of hapnet/algorithm.h, and this "
                                      "program for {}: compile it anew",
                                      loaded.abi, HAPNET_ALGORITHM_ABI));
    }
    if (loaded.tick == nullptr) return base::fail("it has no tick()");
    if (loaded.state_bytes > HAPNET_STATE_BYTES_MAX) {
        return base::fail(fmt::format("its memory of {} bytes is more than the {} that it may have",
                                      loaded.state_bytes, HAPNET_STATE_BYTES_MAX));
    }
    return {};
}

} // namespace

base::Result<SharedObject> SharedObject::with(Loaded loaded) const
{
    if (const auto valid = check(*loaded); !valid) return tl::unexpected{valid.error()};
    SharedObject result{options_};
    constexpr std::size_t unit = sizeof(std::max_align_t);
    result.memory_.resize((loaded->state_bytes + unit - 1) / unit);
    if (loaded->begin != nullptr) {
        const char* const complaint =
            loaded->begin(result.memory_.data(), options_.parameters.c_str());
        if (complaint != nullptr) return base::fail(fmt::format("parameters: {}", complaint));
    } else if (!options_.parameters.empty()) {
        return base::fail("it takes no parameters");
    }
    result.loaded_ = std::move(loaded);
    return result;
}

void SharedObject::hear(const ReceivedState& received)
{
    if (!loaded_ || loaded_->hear == nullptr) return;
    hapnet_received told{};
    put_state(received.state, received.arrived, told.state);
    put_body(received.state.bodies.first(), told.state);
    told.clock = clock_of(received.clock.estimate());
    told.tick_ns = received.tick.count();
    told.force_max_n = received.force_max_n;
    told.from = static_cast<std::uint32_t>(received.from);
    told.taken = flag(received.taken);
    loaded_->hear(memory_.data(), &told);
}

Outcome SharedObject::tick(scene::World& world, const Situation& situation)
{
    base::ensure(is_loaded());
    std::array<hapnet_other, HAPNET_OTHERS_MAX> others; // NOLINT(*-member-init): filled below
    base::ensure(situation.others.size() <= others.size());
    hapnet_situation told{};
    for (const Remote& other : situation.others) {
        hapnet_other& to = others.at(told.others_count);
        to = {};
        put_other(other, to);
        if (&other == &situation.remote) told.leader = told.others_count;
        ++told.others_count;
    }
    told.now_ns = count_of(situation.now);
    told.tick_ns = situation.tick.count();
    told.others = others.data();
    told.clock = clock_of(situation.clock.estimate());
    told.force_max_n = situation.force_max_n;
    told.yields = flag(situation.yields);

    Access at{world, situation.body};
    const hapnet_world access_to{&at, read_body, push, tick_once, read_touch, place};
    hapnet_outcome result{};
    loaded_->tick(memory_.data(), &access_to, &told, &result);
    tick_once(&at);

    Outcome outcome;
    outcome.touched = world.touch(own_hand);
    outcome.on_hand =
        result.has_on_hand != 0 ? base::Force{finite(result.on_hand)} : outcome.touched.on_hand;
    outcome.remote_touching = result.remote_touching != 0;
    outcome.remote_force = base::Force{finite(result.remote_force)};
    if (result.has_remote_hip != 0) outcome.remote_hip = base::Position{finite(result.remote_hip)};
    return outcome;
}

void SharedObject::forget(std::size_t other)
{
    if (!loaded_ || loaded_->forget == nullptr) return;
    loaded_->forget(memory_.data(), static_cast<std::uint32_t>(other));
}

} // namespace hapnet::peer

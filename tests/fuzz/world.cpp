// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/world.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <bit>
#include <cmath>
#include <tuple>

namespace {

using namespace hapnet;
using namespace hapnet::scene;

/// Takes numbers from bytes; zeros when there are none left.
class Bytes {
public:
    explicit Bytes(std::span<const std::uint8_t> bytes) : bytes_{bytes} {}

    [[nodiscard]] bool any() const { return next_ < bytes_.size(); }
    std::uint8_t byte() { return any() ? bytes_[next_++] : std::uint8_t{0}; }
    /// From -most to most, in steps that are finer near 0.
    double number(double most)
    {
        const double share = (static_cast<double>(byte()) - 128.0) / 127.0;
        return most * share * share * share;
    }
    /// Any bits.
    double anything()
    {
        std::uint64_t bits = 0;
        for (int i = 0; i < 8; ++i) bits = bits << 8U | byte();
        return std::bit_cast<double>(bits);
    }
    glm::dvec3 vector(double most)
    {
        const double x = number(most);
        const double y = number(most);
        return {x, y, number(most)};
    }

private:
    std::span<const std::uint8_t> bytes_;
    std::size_t next_ = 0;
};

BodyDescription body_from(Bytes& bytes)
{
    BodyDescription body;
    const std::uint8_t flags = bytes.byte();
    body.movable = (flags & 1U) == 0;
    body.turning = static_cast<Turning>((flags >> 1U) % 5U);
    body.locked.x = (flags & 0xe0U) == 0xe0U;
    body.half = 0.001 + glm::abs(bytes.vector(0.02));
    body.position.value = bytes.vector(0.1);
    body.velocity.value = bytes.vector(1000.0);
    body.angular_velocity = bytes.vector(100.0);
    body.mass_kg = 0.001 + std::abs(bytes.number(10.0));
    if ((flags & 16U) != 0) body.orientation = base::normalized({1.0, bytes.number(1.0), 0.5, 0.1});
    body.material = {std::abs(bytes.number(2.0)), std::abs(bytes.number(1.0))};
    body.drag_ns_per_m = std::abs(bytes.number(10.0));
    return body;
}

Description scene_from(Bytes& bytes)
{
    Description scene;
    for (auto left = 1U + bytes.byte() % 5U; left > 0; --left)
        scene.bodies.push_back(body_from(bytes));
    if ((bytes.byte() & 1U) == 0)
        scene.planes.push_back({.name = {}, .offset_m = bytes.number(0.1)});
    scene.hands.radius_m = 0.001 + std::abs(bytes.number(0.02));
    scene.hands.stiffness_n_per_m = std::abs(bytes.number(1e9));
    scene.hands.damping_ns_per_m = std::abs(bytes.number(1e4));
    return scene;
}

void act(World& world, Bytes& bytes)
{
    const std::uint8_t what = bytes.byte();
    switch (what % 4U) {
    case 0: {
        const base::Position at{bytes.vector(0.1)};
        std::ignore =
            world.set_hand(what >> 7U, {at, {bytes.vector(100.0)}, true, (what & 64U) != 0});
        break;
    }
    case 1: std::ignore = world.push(what >> 6U, {bytes.vector(1e6)}); break;
    case 2: std::ignore = world.place(what >> 6U, {.position = {bytes.vector(0.1)}}); break;
    default: { // anything at all: refused, or in range
        const double one = bytes.anything();
        const double other = bytes.anything();
        std::ignore = world.set_hand(what >> 7U, {.position = {{one, other, 0.0}}});
        std::ignore = world.push(what >> 6U, {{other, one, 0.0}});
    }
    }
}

} // namespace

/// In any scene, under any inputs, everything stays finite, and no hand pushes with more than its
/// greatest force.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes{std::span{data, size}};
    const Description scene = scene_from(bytes);
    auto world = World::freeze(scene);
    if (!world) return 0;
    for (int tick = 0; tick < 64 && (tick < 8 || bytes.any()); ++tick) {
        act(*world, bytes);
        world->tick();
        for (BodyId id = 0; id < scene.bodies.size(); ++id) {
            const BodyState state = world->body(id);
            base::ensure(base::is_finite(state.position) && base::is_finite(state.velocity));
            base::ensure(base::is_finite(state.angular_velocity));
            base::ensure(std::isfinite(glm::dot(state.orientation, state.orientation)));
        }
        for (std::uint32_t hand = 0; hand < scene.hands.count; ++hand) {
            const double force = base::norm(world->touch(hand).on_body);
            base::ensure(force <= scene.hands.force_max_n * (1.0 + 1e-6));
        }
    }
    return 0;
}

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "proto/base/ensure.hpp"
#include "scene/world.hpp"
#include "tests/bench/scene/peers.hpp"

#include <algorithm>
#include <cmath>

namespace hapnet::bench {

namespace {

std::uint64_t guarded = 0; // of all worlds that have ended

class Hapnet final : public Engine {
public:
    explicit Hapnet(scene::World world)
        : world_{std::move(world)},
          feels_planes_{std::any_of(world_.frozen().planes.begin(), world_.frozen().planes.end(),
                                    [](const auto& plane) { return plane.felt; })}
    {}
    ~Hapnet() override { guarded += world_.state().interventions.guards(); }

    void set_hand(std::uint32_t index, const scene::HandInput& input) override
    {
        base::ensure(!world_.set_hand(index, input));
    }
    void step() override { world_.tick(); }
    [[nodiscard]] scene::BodyState state(scene::BodyId body) const override
    {
        return world_.body(body);
    }
    [[nodiscard]] glm::dvec3 hip_force(std::uint32_t index) const override
    {
        const scene::HandTouch& touch = world_.touch(index);
        return feels_planes_ ? -touch.on_hand.value : touch.on_body.value;
    }

private:
    scene::World world_;
    bool feels_planes_;
};

} // namespace

std::uint64_t hapnet_guards() { return guarded; }

std::unique_ptr<Engine> make_hapnet(const scene::Description& scene, const EngineOptions& options)
{
    const scene::FreezeOptions freeze{base::Duration{std::llround(options.tick_s * 1e9)},
                                      options.sleeping, options.stepper};
    auto world = scene::World::freeze(scene, freeze);
    if (!world) return nullptr;
    return std::make_unique<Hapnet>(*std::move(world));
}

} // namespace hapnet::bench

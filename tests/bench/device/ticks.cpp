// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "tests/bench/device/ticks.hpp"

#include "device/omni/geometry.hpp"
#include "device/velocity_filter.hpp"
#include "proto/base/math.hpp"
#include "tests/support/device/ungoverned.hpp"

#include <utility>

namespace hapnet::bench {

namespace {

using namespace std::chrono_literals;

constexpr double radians_per_count = base::two_pi / 15000.0;
constexpr double push_m = 0.002; // depth to which each hand presses into the cube
constexpr double sway_m = 0.020; // and goes to and fro with it
constexpr double sway_hz = 0.25;

double cube_x(base::TimePoint now)
{
    return sway_m * base::sin(base::two_pi * sway_hz * base::to_seconds(now.time_since_epoch()));
}

peer::Hand hand_at(std::size_t side, base::TimePoint now)
{
    const double away = 0.025 - push_m;
    return {.hip = {{cube_x(now) + (side == 0 ? -away : away), 0.0, 0.0}}, .velocity = {}};
}

/// Reports the place of the left peer's hand in counts, as three encoders would.
class EncodedHand final : public device::Device {
public:
    explicit EncodedHand(Load load) : load_{load}
    {
        capabilities_.force_max_n = 3.3;
        capabilities_.force_continuous_n = 0.88;
        capabilities_.speed_max_m_per_s = 1.0;
        capabilities_.joints =
            device::JointLimits{device::omni::mechanism, device::omni::torque_max_nm};
    }
    [[nodiscard]] const device::Identity& identity() const override { return identity_; }
    [[nodiscard]] const device::Capabilities& capabilities() const override
    {
        return capabilities_;
    }
    [[nodiscard]] device::Sample read(base::TimePoint now) override
    {
        device::Sample sample;
        sample.sequence = ++reports_;
        const peer::Hand hand = hand_at(0, now);
        sample.hip = hand.hip;
        if (load_ == Load::contact) return sample;
        // The arm computes this place: the place of its counts, and its velocity.
        const base::Displacement off =
            device::omni::position_of({counts_now()}) - device::omni::position_of({});
        sample.hip = hand.hip + 1e-6 * off;
        sample.velocity = velocity_.at(sample.hip, now);
        return sample;
    }
    void apply(const device::GovernedForce& force) override { last_ = force.force(); }
    void halt() noexcept override {}

private:
    [[nodiscard]] glm::dvec3 counts_now() const
    {
        const auto turn = static_cast<double>(reports_ % 1000);
        return radians_per_count * glm::dvec3{turn, 0.7 * turn, -0.4 * turn};
    }

    Load load_;
    device::Identity identity_;
    device::Capabilities capabilities_;
    device::VelocityFilter velocity_{30.0};
    std::uint64_t reports_ = 0;
    base::Force last_;
};

peer::Settings settings_of(std::size_t side)
{
    peer::Settings settings;
    settings.introduction = {.id = static_cast<std::uint16_t>(side + 1),
                             .nonce = static_cast<std::uint32_t>(side + 1),
                             .scene_hash = scene::hash(settings.scene),
                             .seed = 1,
                             .task = wire::TaskName::from_text("T3").value()};
    settings.length = 24h;
    return settings;
}

/// A rig that applies the force unchanged.
class UngovernedRig {
public:
    explicit UngovernedRig(device::Device& device) : device_{device} {}

    [[nodiscard]] device::Sample read(base::TimePoint now) { return device_.read(now); }
    base::Force apply(const base::Force& wanted, bool /*permitted*/, base::TimePoint /*now*/)
    {
        device_.apply(device::ungoverned(wanted));
        return wanted;
    }
    [[nodiscard]] static device::GovernorState governor_state() { return {}; }
    void on_cue(const device::Cue& cue) { device_.on_cue(cue); }

private:
    device::Device& device_;
};

} // namespace

Ticks::Ticks(Load load)
    : load_{load},
      side_{settings_of(0)},
      other_{settings_of(1)},
      rig_{std::make_unique<EncodedHand>(load), {}}
{
    std::vector<double> unused;
    play(
        4000, [] { return std::int64_t{0}; }, unused); // until both play and push
}

Ticks::~Ticks() = default;

void Ticks::play(int ticks, const Clock& clock, std::vector<double>& nanoseconds)
{
    for (int i = 0; i < ticks; ++i) {
        now_ += 1ms;
        deliver();
        const std::int64_t begin = clock();
        tick();
        nanoseconds.push_back(static_cast<double>(clock() - begin));
        std::ignore = other_.tick(now_, hand_at(1, now_));
    }
}

void Ticks::deliver()
{
    while (const auto datagram = side_.poll()) other_.on_datagram(datagram->bytes(), now_);
    while (const auto datagram = other_.poll()) side_.on_datagram(datagram->bytes(), now_);
    while (side_.notice()) {}
    while (other_.notice()) {}
}

void Ticks::tick()
{
    if (load_ == Load::governed) {
        side_.step(now_, rig_);
    } else {
        UngovernedRig rig{rig_.device()};
        side_.step(now_, rig);
    }
}

} // namespace hapnet::bench

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/simulated/hand_motion.hpp"
#include "device/simulated/hand_noise.hpp"
#include "device/simulated/omni.hpp"
#include "device/simulated/script.hpp"
#include "device/velocity_filter.hpp"

#include <array>
#include <optional>
#include <string>

namespace hapnet::bench {

/// The reference for SimulatedOmni: the same hand and device, with each axis integrated by
/// symplectic Euler in equal steps from read to read, as is usual. It has no reflex and no will.
class SteppedHand final : public device::Device {
public:
    SteppedHand(const device::Performer& performer, int steps_a_read);

    [[nodiscard]] device::Sample read(base::TimePoint now) override;
    void apply(const device::GovernedForce& force) override;
    void halt() noexcept override {}
    void on_cue(const device::Cue& cue) override;
    [[nodiscard]] const device::Identity& identity() const override { return identity_; }
    [[nodiscard]] const device::Capabilities& capabilities() const override
    {
        return capabilities_;
    }

private:
    struct Job {
        device::Script script;
        device::HandNoise noise;
        base::TimePoint start;
    };

    [[nodiscard]] device::Intention intention(base::TimePoint now) const;
    void advance(const base::Position& target, double seconds);

    device::Performer performer_;
    device::Identity identity_{.backend = "steps", .model = "a hand in steps"};
    device::Capabilities capabilities_{};
    int steps_a_read_;
    std::uint64_t reads_ = 0;
    glm::dvec3 centre_{0.0}; // of the workspace
    glm::dvec3 position_{0.0, 0.0, 0.035};
    glm::dvec3 motion_{0.0};
    glm::dvec3 force_{0.0};
    glm::dvec3 rest_{0.0, 0.0, 0.035};
    device::VelocityFilter velocity_;
    std::optional<base::TimePoint> last_read_;
    std::optional<Job> part_;
    std::optional<base::TimePoint> cued_at_;
};

} // namespace hapnet::bench

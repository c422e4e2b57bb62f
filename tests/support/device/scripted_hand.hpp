// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"

#include <limits>
#include <optional>

namespace hapnet::device {

/// A device that reports the `sample` of its test, and keeps the commands that it gets. It has no
/// limits of its own.
class ScriptedHand final : public Device {
public:
    ScriptedHand()
    {
        constexpr double unlimited = std::numeric_limits<double>::infinity();
        capabilities_.force_max_n = unlimited;
        capabilities_.force_continuous_n = unlimited;
        capabilities_.workspace_min = {glm::dvec3{-unlimited}};
        capabilities_.workspace_max = {glm::dvec3{unlimited}};
    }

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] Sample read(base::TimePoint /*now*/) override { return sample; }
    void apply(const GovernedForce& force) override { told = force.force(); }
    void halt() noexcept override { told = base::Force{}; }
    void on_cue(const Cue& cue) override { last_cue = cue; }

    Sample sample;
    base::Force told;
    std::optional<Cue> last_cue;

private:
    Identity identity_;
    Capabilities capabilities_;
};

} // namespace hapnet::device

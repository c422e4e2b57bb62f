// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/simulated/hand_motion.hpp"
#include "device/simulated/omni_plant.hpp"
#include "device/simulated/person.hpp"
#include "device/velocity_filter.hpp"

#include <array>
#include <atomic>
#include <memory>
#include <optional>

namespace hapnet::device {

/// A simulated person and the task to play.
struct Performer {
    Task task = Task::p1;
    TaskOptions options{};
    Operator person{};
    OmniPlant plant{};
    std::shared_ptr<const HandTrace> way{}; // path that the person follows instead of the task's
};

/// A simulated Omni held by a simulated hand that plays its part of a task. Not a human being: a
/// linear hand with scripted intentions.
class SimulatedOmni final : public Device {
public:
    explicit SimulatedOmni(const Performer& performer);

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] Sample read(base::TimePoint now) override;
    void apply(const GovernedForce& force) override;
    void halt() noexcept override { halted_.store(true, std::memory_order_relaxed); }
    void on_cue(const Cue& cue) override;
    void on_fault(bool is_latched) override { person_.on_fault(is_latched); }

    /// The greatest step that read() simulates at once. A longer time since the last read() is
    /// divided into steps.
    static constexpr base::Duration step_max{std::chrono::milliseconds{2}};
    /// The longest time between two reads that is simulated. A longer one is skipped.
    static constexpr base::Duration gap_max{std::chrono::milliseconds{100}};

private:
    void advance(const Person::Aim& aim, base::TimePoint now);
    [[nodiscard]] const glm::dvec3& force_at_grip(base::Duration elapsed);
    void go_on(const base::Position& target, const glm::dvec3& force, base::Duration elapsed);
    void stop_at_workspace_end(int axis);
    [[nodiscard]] glm::dvec3 position() const;
    [[nodiscard]] glm::dvec3 quantised(const glm::dvec3& position) const;

    Performer performer_;
    Identity identity_;
    Capabilities capabilities_;
    std::atomic<bool> halted_{false};
    std::uint64_t reads_ = 0;
    glm::dvec3 centre_{0.0}; // centre of the workspace, in the scene
    HandMotion motion_;
    Person person_;
    std::array<HandAxis, 3> axes_{HandAxis{}, HandAxis{}, HandAxis{.position_m = 0.035}};
    glm::dvec3 force_{0.0};                      // the force that is asked for
    glm::dvec3 at_grip_{0.0};                    // the force at the grip, if it follows late
    base::Position intended_{{0.0, 0.0, 0.035}}; // intended position at simulated_to_
    std::optional<base::TimePoint> simulated_to_;
    VelocityFilter velocity_;
};

} // namespace hapnet::device

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/omni/tracker.hpp"
#include "device/simulated/joints/injected_fault.hpp"
#include "device/simulated/joints/plant.hpp"
#include "device/simulated/person.hpp"

#include <atomic>
#include <optional>

namespace hapnet::device {

/// A simulated Omni, joint by joint, and the person who holds it.
struct JointOmniSettings {
    Role role{};
    JointPlantFigures plant{};
    InjectedFaults injected_faults{};
};

/// A simulated Omni with its encoders, motors, friction, stops and inkwell, held by a simulated
/// person. It is for the conformance tests of devices, and for cases that the Cartesian one does
/// not show. It starts docked, which calibrates it. On its cue the person takes the stylus out, and
/// plays the task. Not a human being: a linear hand with scripted intentions.
class JointOmni final : public Device {
public:
    explicit JointOmni(const JointOmniSettings& settings);

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] CalibrationStep calibrate(base::TimePoint now) override;
    [[nodiscard]] Sample read(base::TimePoint now) override;
    void apply(const GovernedForce& force) override;
    void halt() noexcept override { halted_.store(true, std::memory_order_relaxed); }
    void on_cue(const Cue& cue) override;
    void on_fault(bool is_latched) override { person_.on_fault(is_latched); }

    /// Moves the hand by a script instead of the person, at constant speed to `place` within one
    /// second. It stays there.
    void lead_to(const base::Position& place);
    /// Holds these buttons down from now on, one bit each.
    void press(std::uint8_t buttons) { pressed_ = buttons; }
    void set_injected_faults(InjectedFaults injected_faults)
    {
        injected_faults_ = std::move(injected_faults);
    }

    [[nodiscard]] const JointPlant& plant() const { return plant_; }

    /// The longest time between two reads that is simulated. A longer one is skipped.
    static constexpr base::Duration gap_max{std::chrono::milliseconds{100}};

private:
    /// A movement of the hand outside of any task.
    struct Walk {
        base::Position from;
        base::Position to;
        std::optional<base::TimePoint> start; // nullopt: the walk starts with the next read
    };
    [[nodiscard]] Grip grip_at(base::TimePoint now, base::Duration elapsed);
    [[nodiscard]] base::Position walked(base::TimePoint now);
    void advance(base::TimePoint now);
    void speak(base::TimePoint now);

    Identity identity_;
    Capabilities capabilities_;
    JointPlant plant_;
    Person person_;
    InjectedFaults injected_faults_;
    omni::Tracker tracker_;
    std::atomic<bool> halted_{false};
    std::optional<Walk> walk_;
    bool is_cued_ = false;
    bool is_gripping_ = false; // the person intends to grip
    std::uint8_t pressed_ = 0; // buttons that a script holds down
    base::Position intended_;  // intended position at lived_to_
    std::uint64_t words_ = 0;
    std::optional<base::TimePoint> start_;
    std::optional<base::TimePoint> lived_to_;
};

} // namespace hapnet::device

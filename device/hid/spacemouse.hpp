// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/buttons.hpp"
#include "device/device.hpp"
#include "device/hid/spacemouse_report.hpp"
#include "device/hid/wire.hpp"

#include <chrono>
#include <memory>
#include <optional>

namespace hapnet::device::hid {

/// A SpaceMouse: a cap to push and pull, without motors. The displacement of the cap sets the
/// velocity of the position, which starts in the middle of a box of a PHANToM Omni's workspace and
/// stays inside it. Only translation counts. The left button grips.
///
/// The device is silent while its cap rests, so silence is no fault. A displacement that the device
/// does not repeat within 200 ms ends, as if the cap had been let go.
class SpaceMouse final : public Device {
public:
    SpaceMouse(Identity identity, std::unique_ptr<Wire> wire);

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] Sample read(base::TimePoint now) override;
    void apply(const GovernedForce& /*force*/) override {} // it has no motors
    void halt() noexcept override {}

    static constexpr double speed_max_m_per_s = 0.1; // at full deflection
    static constexpr int deflection_full = 350;
    static constexpr int deflection_least = 10; // a smaller deflection means a cap at rest
    static constexpr base::Duration deflection_lasts{std::chrono::milliseconds{200}};
    /// The greatest pause between two reads that counts. Without this limit the position would
    /// jump.
    static constexpr base::Duration pause_max{std::chrono::milliseconds{20}};
    static constexpr int reports_per_read_max = 64; // the kernel's queue holds this many

private:
    void drain(base::TimePoint now);
    void on_report(std::span<const std::byte> report, base::TimePoint now);
    void move(base::Duration passed);

    Identity identity_;
    Capabilities capabilities_;
    std::unique_ptr<Wire> wire_;
    Buttons buttons_;
    Sample sample_;
    std::optional<base::TimePoint> read_at_;
    base::TimePoint deflected_at_{};
    glm::dvec3 speed_{0.0}; // speed that the cap sets, m/s
    std::uint8_t buttons_down_ = 0;
    bool is_garbled_ = false; // the last report was garbled
    bool is_gone_ = false;
};

} // namespace hapnet::device::hid

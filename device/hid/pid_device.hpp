// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/buttons.hpp"
#include "device/device.hpp"
#include "device/hid/mailbox.hpp"
#include "device/hid/options.hpp"
#include "device/hid/pid_layout.hpp"
#include "device/hid/wire.hpp"
#include "device/velocity_filter.hpp"

#include <chrono>
#include <memory>

namespace hapnet::device::hid {

/// The parts of an opened PID device.
struct PidParts {
    Identity identity{};
    InputLayout input{};
    Options options{};
    std::unique_ptr<Wire> wire{};           // source of the input reports
    std::unique_ptr<ReportSender> outbox{}; // nullptr: no force
};

/// A joystick or wheel base with force feedback by USB HID PID, as a device of one or two degrees
/// of freedom. Its axis X is x. Its axis Y, which grows toward the user, is -y, so that away from
/// the user is up, as on a screen. Positions are uncalibrated shares of the reach, and forces are
/// uncalibrated shares of full scale.
///
/// Many such devices send nothing while nothing moves. So after 8 ms of silence, a report that the
/// device accepts counts as a sign that it has not moved. Under force it gets reports in each tick;
/// at rest it then gets a report that its actuators are disabled. A device that neither sends nor
/// accepts reports is silent. A device that is only read may be silent.
///
/// When this program is killed, the force ends by itself 100 ms later if the device respects the
/// duration of its effects. Otherwise only its power switch stops it.
class PidDevice final : public Device {
public:
    explicit PidDevice(PidParts parts);
    ~PidDevice() override;
    PidDevice(const PidDevice&) = delete;
    PidDevice& operator=(const PidDevice&) = delete;

    [[nodiscard]] const Identity& identity() const override { return parts_.identity; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] Sample read(base::TimePoint now) override;
    void apply(const GovernedForce& force) override;
    void halt() noexcept override;

    static constexpr base::Duration silence_max{std::chrono::milliseconds{20}};
    static constexpr base::Duration probe_after{std::chrono::milliseconds{8}};
    /// The greatest pause between two reads that counts as time of the device. The rest of a longer
    /// pause was caused by the host.
    static constexpr base::Duration pause_max{std::chrono::milliseconds{5}};
    static constexpr int reports_per_read_max = 64; // the kernel's queue holds this many
    static constexpr double velocity_cutoff_hz = 30.0;

private:
    void drain();
    void on_report(std::span<const std::byte> report);
    void watch(base::Duration passed);
    void probe(base::Duration passed);
    [[nodiscard]] Fault fault() const;

    PidParts parts_;
    Capabilities capabilities_;
    VelocityFilter velocity_{velocity_cutoff_hz};
    Buttons buttons_;
    Sample sample_;
    std::optional<base::TimePoint> read_at_;
    Progress progress_{};
    base::Duration silent_{};  // time since the device last reported, or took a report while silent
    base::Duration unmoved_{}; // time for which waiting reports were not accepted
    base::Duration since_probed_{};
    std::uint8_t buttons_down_ = 0;
    bool was_garbled_ = false; // the last report was garbled
    bool is_garbled_ = false;  // a report in or just before the latest read() was garbled
    bool is_refusing_ = false;
    bool is_gone_ = false;
};

} // namespace hapnet::device::hid

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/buttons.hpp"
#include "device/device.hpp"
#include "device/falcon/link.hpp"
#include "device/falcon/packet.hpp"
#include "device/velocity_filter.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace hapnet::device::falcon {

/// Motor counts per newton metre at a leg's arm. This is libnifalcon's factor
/// (src/kinematic/FalconKinematicStamper.cpp), which names no source; no measurement is known. With
/// it, the largest motor force is 7.4 N sideways at the middle of the workspace (computed), near
/// the 8 N that CHAI3D states. Forces in newtons are therefore nominal.
inline constexpr double counts_per_newton_metre = 10000.0;

/// Returns the identity that the catalogue shows; "" stands for an unknown serial.
[[nodiscard]] Identity identity_of(std::string serial);

/// A Novint Falcon whose firmware runs. Positions are meaningless until its three legs have touched
/// their stops once: calibrate() asks the person to do this, and the device's light is red until
/// then. The device answers each packet with one packet, so the host sets the rate.
///
/// When the program is killed, the motors probably keep the last torque: no watchdog in the
/// firmware is documented. Unplugging the power supply stops them.
class Falcon final : public Device {
public:
    Falcon(std::unique_ptr<Link> link, std::string serial);
    ~Falcon() override;
    Falcon(const Falcon&) = delete;
    Falcon& operator=(const Falcon&) = delete;

    [[nodiscard]] const Identity& identity() const override { return identity_; }
    [[nodiscard]] const Capabilities& capabilities() const override { return capabilities_; }
    [[nodiscard]] CalibrationStep calibrate(base::TimePoint now) override;
    [[nodiscard]] Sample read(base::TimePoint now) override;
    void apply(const GovernedForce& force) override;
    void halt() noexcept override;

    /// Silence, or invalid reports, for longer than silence_max is a fault, if the device was read
    /// at least silent_reads_min times in that time. A host that did not read in time cannot detect
    /// a silence.
    static constexpr base::Duration silence_max{std::chrono::milliseconds{20}};
    static constexpr int silent_reads_min = 5;
    /// A packet without an answer after this time counts as lost.
    static constexpr base::Duration lost_after{std::chrono::milliseconds{10}};

private:
    void take(const Report& report, base::TimePoint now);
    [[nodiscard]] Fault fault_at(base::TimePoint now) const;
    [[nodiscard]] Command command_for(const GovernedForce& force) const;
    [[nodiscard]] Command resting() const;

    std::unique_ptr<Link> link_;
    Identity identity_;
    Capabilities capabilities_;
    PacketFinder finder_;
    VelocityFilter velocity_;
    Buttons buttons_;
    Sample sample_;
    base::TimePoint now_{};                    // time of the last read
    std::optional<base::TimePoint> last_word_; // last valid report; before one: first read
    int silent_reads_ = 0;                     // number of reads since last_word_
    std::uint64_t nonsense_ = 0;               // number of reports that no arm can give
    std::uint64_t nonsense_before_ = 0; // nonsense_ and skipped bytes at the last valid report
    bool was_calibrated_ = false;
    bool homes_ = false;
    std::optional<base::TimePoint> unanswered_since_;
    bool pushes_ = false; // the last packet that was sent drives the motors
};

} // namespace hapnet::device::falcon

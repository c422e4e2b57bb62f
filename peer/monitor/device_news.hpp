// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::peer::monitor {

/// The ways in which the holder of a device can end its fault.
struct Recovery {
    bool by_holder = false; // the device has a holder for its stylus
    bool by_button = true;
    bool by_simulated_hand = false; // a simulated hand ends the fault by itself
};
[[nodiscard]] Recovery recovery_of(const device::Device& device);

/// The kind of change in a device.
enum class DeviceChange : std::uint8_t { fault, calibration, energy };

/// A change of the device that a person, or a program, should be told of.
struct DeviceNews {
    device::CalibrationStep calibration = device::CalibrationStep::done;
    device::Latched fault{};                // none: the device has no fault, or no longer has one
    std::uint64_t energy_limited_ticks = 0; // since the program's start
    DeviceChange change = DeviceChange::fault;
    Recovery recovery{};
};

/// The change and what to do about it on this device, for a person; "" where a person need not be
/// told while the session lasts.
[[nodiscard]] std::string describe(const DeviceNews& news);

/// An error text for a session that ends with a fault of its device; "" without a fault. A fault
/// that an operator has ended does not count.
[[nodiscard]] std::string fault_at_the_end(const device::Governor& governor);

/// Finds changes of a device's state, tick by tick. It reports at most one change of calibration,
/// one of faults and one of energy a second, the first at once. When changes are faster it reports
/// the newest state.
class DeviceReporter {
public:
    explicit DeviceReporter(const Recovery& recovery) : told_{.recovery = recovery} {}

    [[nodiscard]] std::optional<DeviceNews> look(device::CalibrationStep calibration,
                                                 const device::Latched& fault, base::TimePoint now);
    /// `limited_ticks`: in which the force was reduced for the energy into the hand.
    [[nodiscard]] std::optional<DeviceNews> look_at_energy(std::uint64_t limited_ticks,
                                                           base::TimePoint now);

    static constexpr base::Duration at_most_every{std::chrono::seconds{1}};

private:
    [[nodiscard]] bool is_time(std::optional<base::TimePoint>& last, base::TimePoint now) const;

    DeviceNews told_;
    std::optional<base::TimePoint> fault_told_;
    std::optional<base::TimePoint> calibration_told_;
    std::optional<base::TimePoint> energy_told_;
};

} // namespace hapnet::peer::monitor

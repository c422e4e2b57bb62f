// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::peer::monitor {

/// The ways in which the fault of a device can be ended.
struct Recovery {
    bool by_holder = false; // the device has a holder that its stylus can be put into
    bool by_button = true;
    bool by_simulated_hand = false; // a simulated hand ends the fault by itself
};
[[nodiscard]] Recovery recovery_of(const device::Device& device);

/// The kind of change in a device.
enum class DeviceChange : std::uint8_t { fault, calibration, energy };

/// A change of the device to report to a person or a program.
struct DeviceNews {
    device::CalibrationStep calibration = device::CalibrationStep::done;
    device::Latched fault{};                // none: the device has no fault
    std::uint64_t energy_limited_ticks = 0; // since the program's start
    DeviceChange change = DeviceChange::fault;
    Recovery recovery{};
};

/// Returns text about the change and what to do about it on this device; "" if a person need not
/// know it during the session.
[[nodiscard]] std::string describe(const DeviceNews& news);

/// An error text for a session that ends with a fault of its device; "" without a fault. A fault
/// that an operator has ended does not count.
[[nodiscard]] std::string fault_at_the_end(const device::Governor& governor);

/// Finds changes of a device's state, tick by tick. It reports at most one change of calibration,
/// one of faults and one of energy a second, and the first of each at once. If changes are faster,
/// it reports the newest state.
class DeviceReporter {
public:
    explicit DeviceReporter(const Recovery& recovery) : told_{.recovery = recovery} {}

    [[nodiscard]] std::optional<DeviceNews> look(device::CalibrationStep calibration,
                                                 const device::Latched& fault, base::TimePoint now);
    /// Reports a change of energy. `limited_ticks` counts the ticks in which the force was reduced
    /// to limit the energy into the hand.
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

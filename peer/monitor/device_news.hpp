// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"

#include <optional>
#include <string>

namespace hapnet::peer::monitor {

/// The ways in which the holder of a device can end its fault.
struct Recovery {
    bool by_holder = false; // it has one for its stylus
    bool by_button = true;
    bool by_simulated_hand = false; // which does it by itself
};
[[nodiscard]] Recovery recovery_of(const device::Device& device);

/// A change of the device that a person should be told of.
struct DeviceNews {
    device::CalibrationStep calibration = device::CalibrationStep::done;
    device::Latched fault{}; // none: it is, or is again, without one
    bool is_of_calibration = false;
    Recovery recovery{};
};

/// The change and what to do about it on this device, for a person.
[[nodiscard]] std::string describe(const DeviceNews& news);

/// An error text for a session that ends with a fault of its device; "" without a fault. A fault
/// that an operator has ended does not count.
[[nodiscard]] std::string fault_at_the_end(const device::Governor& governor);

/// Finds changes of a device's state, tick by tick. It reports at most one change of calibration
/// and one of faults a second, the first at once. Of faster changes it reports the newest state.
class DeviceReporter {
public:
    explicit DeviceReporter(const Recovery& recovery) : told_{.recovery = recovery} {}

    [[nodiscard]] std::optional<DeviceNews> look(device::CalibrationStep calibration,
                                                 const device::Latched& fault, base::TimePoint now);

    static constexpr base::Duration at_most_every{std::chrono::seconds{1}};

private:
    [[nodiscard]] bool is_time(std::optional<base::TimePoint>& last, base::TimePoint now) const;

    DeviceNews told_;
    std::optional<base::TimePoint> fault_told_;
    std::optional<base::TimePoint> calibration_told_;
};

} // namespace hapnet::peer::monitor

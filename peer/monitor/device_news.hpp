// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/rig.hpp"

#include <optional>
#include <string>

namespace hapnet::peer {

/// How a fault of a device can be ended, by who holds it.
struct WaysBack {
    bool by_holder = false; // it has one for its stylus
    bool by_button = true;
    bool by_simulated_hand = false; // which does it by itself
};
[[nodiscard]] WaysBack ways_back_of(const device::Device& device);

/// Something about the device that a person should be told.
struct DeviceNews {
    device::CalibrationStep calibration = device::CalibrationStep::done;
    device::Latched fault{}; // none: it is, or is again, without one
    bool is_of_calibration = false;
    WaysBack ways_back{};
};

/// What to tell: what it is, and what to do about it, with what the device has.
[[nodiscard]] std::string words_for(const DeviceNews& news);

/// Why a session whose device has a fault by the end was no success; "" when it has none. A fault
/// that an operator has ended is none.
[[nodiscard]] std::string fault_at_the_end(const device::Governor& governor);

/// Finds news in a device's state, tick by tick. Of its calibration and of its faults it tells one
/// a second at most, and the first at once: of what changes faster, how it is by then.
class DeviceReporter {
public:
    explicit DeviceReporter(const WaysBack& ways_back) : told_{.ways_back = ways_back} {}

    [[nodiscard]] std::optional<DeviceNews> look(device::CalibrationStep calibration,
                                                 const device::Latched& fault, base::TimePoint now);

    static constexpr base::Duration at_most_every{std::chrono::seconds{1}};

private:
    [[nodiscard]] bool is_time(std::optional<base::TimePoint>& last, base::TimePoint now) const;

    DeviceNews told_;
    std::optional<base::TimePoint> fault_told_;
    std::optional<base::TimePoint> calibration_told_;
};

} // namespace hapnet::peer

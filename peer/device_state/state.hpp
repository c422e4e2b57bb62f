// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::peer::device_state {

/// The state that outlives a program which drove a real device. Times are seconds of the wall
/// clock.
struct DeviceState {
    struct Heat {
        double heat = 0.0; // heat of the motors, as device::MotorHeat counts it
        double at_s = 0.0;
    };

    std::optional<double> self_test_passed_s{};
    std::optional<Heat> heat{}; // nullopt: not known, such as during a session
};

/// Now, and when the machine was started.
struct Moment {
    double now_s = 0.0;
    double booted_s = 0.0;
};

inline constexpr double self_test_valid_s = 30.0 * 24 * 3600;
/// The heat of motors about which nothing is known. The limit then starts at the force that they
/// bear for ever.
inline constexpr double unknown_heat = 1.1;

/// Why no session may begin without being asked for: the device has passed no self-test, or not
/// within 30 days, or one in the future. "" when it may.
[[nodiscard]] std::string_view why_untested(const DeviceState& state, double now_s);

/// The heat with which the motors start, cooled down since it was noted. A note from before the
/// machine's start or from the future is not believed: the heat is then unknown.
[[nodiscard]] double heat_at_start(const DeviceState& state, const Moment& moment,
                                   base::Duration heat_time);

/// JSON, and back. The error says what is wrong.
[[nodiscard]] std::string to_text(const DeviceState& state);
[[nodiscard]] base::Result<DeviceState> parse(std::string_view text);

/// The file's name: "falcon-A1B2.json". `place` stands in for a serial number that there is not;
/// what is no letter, digit, '-' or '_' is written as "%2F".
[[nodiscard]] std::string file_name(const device::Identity& identity, std::string_view place);

} // namespace hapnet::peer::device_state

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

/// The state of a real device that outlives the program. Times are wall clock times in seconds.
struct DeviceState {
    struct Heat {
        double heat = 0.0; // heat of the motors, as device::MotorHeat counts it
        double at_s = 0.0;
    };

    std::optional<double> self_test_passed_s{};
    std::optional<Heat> heat{}; // nullopt: unknown, for example during a session
};

/// The present time, and the time of the machine's start.
struct Moment {
    double now_s = 0.0;
    double booted_s = 0.0;
};

inline constexpr double self_test_valid_s = 30.0 * 24 * 3600;
/// The assumed heat of motors whose heat is unknown. The limit then starts at the force that they
/// bear permanently.
inline constexpr double unknown_heat = 1.1;

/// Returns why no session may begin unless the user explicitly permits it: the device has not
/// passed a self-test, or not within 30 days, or its date is in the future. Returns "" if a session
/// may begin.
[[nodiscard]] std::string_view why_untested(const DeviceState& state, double now_s);

/// Returns the heat of the motors at the start, cooled down since it was stored. A value from
/// before the machine's start or from the future is ignored: the heat is then unknown.
[[nodiscard]] double heat_at_start(const DeviceState& state, const Moment& moment,
                                   base::Duration heat_time);

/// Converts the state to JSON. The reverse function fails with an error that says what is wrong.
[[nodiscard]] std::string to_text(const DeviceState& state);
[[nodiscard]] base::Result<DeviceState> parse(std::string_view text);

/// Returns the file's name, such as "falcon-A1B2.json". `place` is used if the device has no serial
/// number. Characters other than letters, digits, '-' and '_' are written as "%2F".
[[nodiscard]] std::string file_name(const device::Identity& identity, std::string_view place);

} // namespace hapnet::peer::device_state

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/capabilities.hpp"
#include "device/dhd/library.hpp"
#include "device/fault.hpp"
#include "device/polled/exchange.hpp"
#include "proto/base/space.hpp"

#include <array>
#include <cstdint>
#include <string>

namespace hapnet::device::dhd {

/// Returns the fault for one of the library's error codes.
[[nodiscard]] Fault fault_of(int code);

/// Returns a vector of the library's frame in the device frame.
[[nodiscard]] constexpr glm::dvec3 from_library(const std::array<double, 3>& it)
{
    return {it[1], it[2], it[0]};
}
/// Returns a vector of the device frame in the library's frame.
[[nodiscard]] constexpr std::array<double, 3> to_library(const glm::dvec3& it)
{
    return {it.z, it.x, it.y};
}

/// Returns the assumed abilities of any device behind the library, because the library does not
/// state them: peak force, continuous force and stiffness of an Omni's data sheet, within a cube of
/// 80 mm around the device's origin.
[[nodiscard]] Capabilities capabilities();

/// The results of one round of calls.
struct Reading {
    int result = 0;          // result of the first call that failed; 0 or more: all calls succeeded
    int error = error::none; // error code of the call that failed
    std::array<double, 3> position{};
    std::array<double, 3> velocity{};
    std::uint8_t buttons = 0;
    Status status{};
};

/// Converts readings to reports, and counts consecutive failures.
class Interpreter {
public:
    /// `wants_force`: this round requested that the motors be on.
    [[nodiscard]] polled::Report report_of(const Reading& reading, bool wants_force);

    /// After this many consecutive rounds with a communication error, the device counts as gone.
    static constexpr int gone_after = 100;

private:
    [[nodiscard]] Fault fault_of_status(const Status& status, bool wants_force);

    int failures_ = 0;       // communication errors in a row
    bool had_force_ = false; // the motors were requested and on in the last round
};

/// Returns the message about a device that does not open, with the remedy.
[[nodiscard]] std::string describe_error(const std::string& serial, int code);

} // namespace hapnet::device::dhd

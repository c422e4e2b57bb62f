// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/names.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace hapnet::device {

/// The faults of a device: a closed set. Every backend maps the errors of its library, of the
/// kernel and of the device itself to one of them.
enum class Fault : std::uint8_t {
    none,
    not_found,
    permission,       // the system refuses access
    in_use,           // another program uses the device
    firmware_missing, // the device needs firmware that the user has to supply
    library_missing,  // the vendor's library is missing
    communication,    // reports make no sense, or the library reports a communication error
    timeout,          // the device no longer answers
    overheat,
    over_force,
    over_velocity,
    not_calibrated, // the device lost its calibration
    disconnected,
    internal, // an error inside a library or this program
};

/// The names of faults in statistics.
constexpr auto names_of(base::Tag<Fault> /*enum*/)
{
    return base::names("none", "not-found", "permission", "in-use", "firmware-missing",
                       "library-missing", "communication", "timeout", "overheat", "over-force",
                       "over-velocity", "not-calibrated", "disconnected", "internal");
}
using base::name_of;
/// Returns the fault as words, with what to do about it: one sentence or two; "" for none.
[[nodiscard]] std::string_view describe(Fault fault);

/// The remedy for a device that was not found.
inline constexpr std::string_view cure_of_not_found =
    "check its cable and power; hapnet-peer list-devices shows what is connected";

/// The reason why a device cannot be used.
struct DeviceError {
    Fault fault = Fault::internal;
    std::string message;   // what happened, and the remedy
    std::int64_t code = 0; // error number of the library or the kernel; 0: none
};

/// A value, or the reason why opening a device failed.
template <typename T>
using Opened = tl::expected<T, DeviceError>;

/// Returns the error of an Opened.
[[nodiscard]] inline tl::unexpected<DeviceError> device_error(Fault fault, std::string message,
                                                              std::int64_t code = 0)
{
    return tl::unexpected<DeviceError>{DeviceError{fault, std::move(message), code}};
}

} // namespace hapnet::device

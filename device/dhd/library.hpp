// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace hapnet::device::dhd {

// The used part of the binary interface of libdhd, the haptic library of Force Dimension's SDK. The
// numbers are facts of that interface, as public bindings list them (forcedimension_core for
// Python, sawForceDimensionSDK); the names are ours. Units are metres and newtons; x points toward
// the user, y to the right, z up.

/// The number of an open device. This program never uses -1, which means the default device.
using Id = char;

/// The result of a function that has failed; see last_error(). Results above 0 are harmless, such
/// as a saturated motor.
inline constexpr int failed = -1;

/// Error codes.
namespace error {
inline constexpr int none = 0;
inline constexpr int communication = 2;
inline constexpr int busy = 3; // the controller is busy
inline constexpr int no_driver = 4;
inline constexpr int no_device = 5;
inline constexpr int not_available = 6;
inline constexpr int timeout = 7;
inline constexpr int not_ready = 12; // the device is not ready
inline constexpr int redundancy_failed = 18;
inline constexpr int in_use = 20;
} // namespace error

/// Indices in the status of a device; the value 1 means yes. Libraries since 3.0 fill in 12 to 17
/// of them.
namespace status {
inline constexpr std::size_t power = 0;
inline constexpr std::size_t connected = 1;
inline constexpr std::size_t needs_calibration = 3; // "RESET": the pole must be put into its pit
inline constexpr std::size_t force = 5;             // the motors are on
inline constexpr std::size_t error = 9;             // an error of the controller
inline constexpr std::size_t force_off_cause = 14;
} // namespace status
using Status = std::array<int, 32>; // larger than today's libraries need, for later ones

/// The causes for which the device itself switches its motors off.
namespace force_off {
inline constexpr int velocity = 2;
} // namespace force_off

/// The functions of the library.
struct Functions {
    int (*device_count)() = nullptr;
    int (*open_id)(Id index) = nullptr; // returns the number of the opened device, below 0: failed
    int (*close)(Id device) = nullptr;
    int (*serial_number)(unsigned short* serial, Id device) = nullptr;
    const char* (*system_name)(Id device) = nullptr;
    int (*enable_force)(unsigned char on, Id device) = nullptr;
    int (*get_status)(int* status, Id device) = nullptr;
    int (*get_position)(double* x, double* y, double* z, Id device) = nullptr;
    int (*get_velocity)(double* x, double* y, double* z, Id device) = nullptr;
    int (*set_force)(double x, double y, double z, Id device) = nullptr;
    int (*get_button)(int index, Id device) = nullptr; // returns 1 if the button is pressed
    int (*last_error)() = nullptr; // returns the last error of the calling thread
};

} // namespace hapnet::device::dhd

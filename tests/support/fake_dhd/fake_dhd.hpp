// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

/// States of the fake library's two devices: 0 has the serial number 4711, 1 has 4712.
enum class FakeDhdFate : int {
    calibrated, // its pole has been in the pit
    pressed,
    unplugged,
    garbled,  // positions are no numbers
    stalled,  // calls do not return
    tripped,  // its controller has switched the motors off: too fast
    in_error, // its controller
};

/// A force that a call sent to the device, in the library's frame.
struct FakeDhdCommand {
    double force_n[3];
    bool motors_on;
};

extern "C" {
/// Restores the state after loading. Call it only while no device is open.
void fakedhd_reset();
void fakedhd_set(int device, FakeDhdFate fate, bool on);
/// Copies up to `room` commands from number `first` on. Returns how many there are in total.
std::size_t fakedhd_commands(int device, std::size_t first, FakeDhdCommand* to, std::size_t room);
}

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

/// States of the fake library's two devices: 0 is "Default Device", 1 is "Left".
enum class FakeHdFate : int {
    docked, // the stylus is in its inkwell
    calibrated,
    pressed, // button 1
    unplugged,
    garbled, // positions are no numbers
    warm,    // an error of warm motors in each frame
    stalled, // affects both devices: the scheduler makes no calls
};

/// A force that a frame sent to the device.
struct FakeHdCommand {
    double force_n[3];
    bool motors_on;
};

/// Violations of the interface's rules.
struct FakeHdMisuse {
    std::uint64_t force_outside_frame;
    std::uint64_t nested_frames;
    std::uint64_t frames_off_scheduler; // opened by another thread than the scheduler's
    std::uint64_t initialised_while_running;
};

/// For other processes, which cannot call the functions below. If this environment variable names a
/// file, each frame appends a line "DEVICE X Y Z MOTORS", in newtons and 0 or 1. Each stylus begins
/// in its inkwell, and is moved to the middle of the workspace after 100 calibrated frames there.
inline constexpr const char* fake_hd_log_variable = "HAPNET_FAKE_HD_LOG";

extern "C" {
/// Restores the state after loading. Call it only while no device is open.
void fakehd_reset();
void fakehd_set(std::size_t device, FakeHdFate fate, bool on);
/// Makes the n-th frame from now fail with one error of the line.
void fakehd_fail_frame(std::size_t device, std::uint64_t n);
/// Reports an error at once. It belongs to neither device if `device` is 2 or more.
void fakehd_complain(std::size_t device, unsigned int code);
/// Copies up to `room` commands from number `first` on. Returns how many there are in total.
std::size_t fakehd_commands(std::size_t device, std::size_t first, FakeHdCommand* to,
                            std::size_t room);
FakeHdMisuse fakehd_misuse();
}

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

/// Fate, for the fake library's two devices: 0 is "Default Device", 1 is "Left".
enum class FakeHdFate : int {
    docked, // the stylus is in its inkwell
    calibrated,
    pressed, // button 1
    unplugged,
    garbled, // positions are no numbers
    warm,    // an error of warm motors in each frame
    stalled, // of either device: the scheduler calls nobody
};

/// A force as a frame took it to the device.
struct FakeHdCommand {
    double force_n[3];
    bool motors_on;
};

/// How the rules of the interface were kept.
struct FakeHdMisuse {
    std::uint64_t force_outside_frame;
    std::uint64_t nested_frames;
    std::uint64_t frames_off_scheduler; // opened by another thread than the scheduler's
    std::uint64_t initialised_while_running;
};

/// For who cannot call the functions below, being another process: where this variable of the
/// environment names a file, each frame adds a line "DEVICE X Y Z MOTORS" to it, in newtons and 0
/// or 1, and each stylus begins in its inkwell and is taken out of it, to the middle of the
/// workspace, when it has been calibrated there for 100 frames.
inline constexpr const char* fake_hd_log_variable = "HAPNET_FAKE_HD_LOG";

extern "C" {
/// As it was when it was loaded; only while no device is open.
void fakehd_reset();
void fakehd_set(std::size_t device, FakeHdFate fate, bool on);
/// One error of the line, in the n-th frame from now.
void fakehd_fail_frame(std::size_t device, std::uint64_t n);
/// An error at once, whatever goes on. Of neither device where `device` is 2 or more.
void fakehd_complain(std::size_t device, unsigned int code);
/// Copies up to `room` commands from number `first` on; gives how many there are in all.
std::size_t fakehd_commands(std::size_t device, std::size_t first, FakeHdCommand* to,
                            std::size_t room);
FakeHdMisuse fakehd_misuse();
}

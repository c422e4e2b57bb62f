// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hdapi/library.hpp"

#include <array>
#include <cstdint>
#include <optional>

namespace hapnet::device::hdapi {

/// A command to the device, in newtons.
struct Command {
    std::array<double, 3> force_n{};
    bool motors_on = false;
};

/// The device's report in a cycle of the library, in the library's units.
struct Report {
    std::uint64_t cycle = 0; // counted from 1; 0: no report yet
    std::array<double, 3> position_mm{};
    std::array<double, 3> velocity_mm_per_s{};
    int buttons = 0;
    bool inkwell_switch = false;
    unsigned int calibration = calibration::needs_update;
    unsigned int error = error::none;    // latest error of this device
    std::uint64_t error_cycle = 0;       // cycle of that error
    std::uint64_t failures_in_a_row = 0; // consecutive latest cycles with a communication error
};

/// The work for one device in each cycle of the library's scheduler, in its callback. It follows
/// the library's rules: state and force are accessed only within a frame, one frame at a time.
class DeviceCycle {
public:
    DeviceCycle(const Functions& functions, Handle handle, int style)
        : functions_{&functions}, handle_{handle}, style_{style}
    {}

    /// The scheduler is about to start, which by the vendor's reference switches the motors on.
    void on_start() { motors_on_.reset(); }
    /// Continues the calibration, opens the frame, and reads. The motors are off in the first frame
    /// after a start.
    const Report& begin();
    /// Sets the force and closes the frame. The force is zero while the library reports that the
    /// device is not calibrated. It is also zero once no command was `is_new` for 20 cycles,
    /// because the thread that gives commands has then stopped.
    void end(const Command& command, bool is_new);
    /// Notes an error of this device, after end(). The last call of a cycle counts.
    void note(unsigned int code) { happened_ = code; }

    [[nodiscard]] Handle handle() const { return handle_; }
    /// Returns the number of consecutive frames that sent the device zero force with its motors
    /// off.
    [[nodiscard]] std::uint64_t silent_frames() const { return silent_frames_; }

    static constexpr std::uint64_t stale_after_cycles = 20; // 20 ms at 1 kHz

private:
    void calibrate();
    void switch_motors(bool on);
    void settle_errors();

    const Functions* functions_;
    Handle handle_;
    int style_;
    Report report_;
    unsigned int happened_ = error::none; // error in the cycle that has ended
    std::uint64_t stale_cycles_ = 0;
    std::uint64_t silent_frames_ = 0;
    std::optional<bool> motors_on_; // nullopt: not set since the scheduler's start
};

/// The greatest number of errors that one cycle reads from the library's stack, which may refill
/// itself.
inline constexpr int errors_max = 64;

/// Removes all errors from the library's stack. Returns the first one that occurred, as the others
/// follow from it.
[[nodiscard]] ErrorInfo first_error(const Functions& functions);

} // namespace hapnet::device::hdapi

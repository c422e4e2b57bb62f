// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

namespace hapnet::device::hdapi {

// The used part of the binary interface of libHD, the vendor's library for the PHANToM family. The
// numbers are facts of that interface, as public bindings list them (pyOpenHaptics,
// OpenHaptics4CSharp; both MIT); the names are ours. Lengths are in millimetres.

using Handle = unsigned int;
inline constexpr Handle no_device = 0xffffffffU;

struct ErrorInfo {
    unsigned int code;
    int internal;
    Handle handle;
};

/// Returns callback_continue to be called again in the next cycle.
using Callback = unsigned int (*)(void*);
inline constexpr unsigned int callback_continue = 1;
inline constexpr unsigned short priority_max = 65535;

/// Error codes.
namespace error {
inline constexpr unsigned int none = 0;
inline constexpr unsigned int warm_motors = 0x200;
inline constexpr unsigned int force_too_large = 0x201;
inline constexpr unsigned int impulse_too_large = 0x202;
inline constexpr unsigned int velocity_too_large = 0x203;
inline constexpr unsigned int force_error = 0x204;
inline constexpr unsigned int device_fault = 0x300;
inline constexpr unsigned int already_open = 0x301;
inline constexpr unsigned int communication = 0x302;
inline constexpr unsigned int communication_set_up = 0x303;
inline constexpr unsigned int timer = 0x304;
inline constexpr unsigned int licence = 0x600;
} // namespace error

/// Parameters that can be read or set.
namespace parameter {
inline constexpr unsigned int buttons = 0x2000;           // int: one bit each
inline constexpr unsigned int inkwell_switch = 0x2002;    // boolean
inline constexpr unsigned int position = 0x2050;          // 3 doubles, mm
inline constexpr unsigned int velocity = 0x2051;          // 3 doubles, mm/s, smoothed
inline constexpr unsigned int model = 0x2501;             // text
inline constexpr unsigned int serial = 0x2504;            // text
inline constexpr unsigned int usable_workspace = 0x2551;  // 6 doubles, mm: least, then most
inline constexpr unsigned int calibration_style = 0x2555; // int: bits, see calibration::style_*
inline constexpr unsigned int update_rate = 0x2600;       // int, Hz
inline constexpr unsigned int stiffness_max = 0x2602;     // double, N/mm
inline constexpr unsigned int force_max = 0x2603;         // double, N
inline constexpr unsigned int force_continuous = 0x2604;  // double, N
inline constexpr unsigned int velocity_limit = 0x2606;    // double, mm/s
inline constexpr unsigned int damping_max = 0x2609;       // double, N s/mm
inline constexpr unsigned int force = 0x2700;             // 3 doubles, N; only within a frame
} // namespace parameter

/// Features that can be switched on.
namespace capability {
inline constexpr unsigned int force_output = 0x4000;
inline constexpr unsigned int force_clamping = 0x4001;
} // namespace capability

namespace calibration {
inline constexpr unsigned int done = 0x5000;
inline constexpr unsigned int needs_update = 0x5001; // the person has done their part
inline constexpr unsigned int needs_person = 0x5002;
inline constexpr int style_encoder_reset = 1;
inline constexpr int style_automatic = 2;
inline constexpr int style_inkwell = 4;
} // namespace calibration

/// The functions of the library. Call those of state and force between begin_frame() and
/// end_frame(). All refer to the device that was made current last.
struct Functions {
    /// Opens a device and makes it current; nullptr: the default device.
    Handle (*init_device)(const char* name) = nullptr;
    void (*disable_device)(Handle device) = nullptr;
    void (*make_current_device)(Handle device) = nullptr;
    void (*begin_frame)(Handle device) = nullptr;
    void (*end_frame)(Handle device) = nullptr;
    ErrorInfo (*get_error)() = nullptr; // takes the latest error off a stack
    const char* (*get_error_string)(unsigned int code) = nullptr;
    void (*enable)(unsigned int capability) = nullptr;
    void (*disable)(unsigned int capability) = nullptr;
    void (*get_booleans)(unsigned int parameter, unsigned char* values) = nullptr;
    void (*get_integers)(unsigned int parameter, int* values) = nullptr;
    void (*get_doubles)(unsigned int parameter, double* values) = nullptr;
    void (*set_doubles)(unsigned int parameter, const double* values) = nullptr;
    const char* (*get_string)(unsigned int parameter) = nullptr;
    unsigned int (*check_calibration)() = nullptr;
    void (*update_calibration)(unsigned int style) = nullptr;
    void (*start_scheduler)() = nullptr;
    void (*stop_scheduler)() = nullptr;
    void (*set_scheduler_rate)(unsigned long hertz) = nullptr;
    unsigned long (*schedule_asynchronous)(Callback callback, void* data,
                                           unsigned short priority) = nullptr;
    void (*unschedule)(unsigned long scheduled) = nullptr;
};

} // namespace hapnet::device::hdapi

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/descriptor.hpp"

namespace hapnet::device::hid::usage {

// USB HID Usage Tables: Generic Desktop, Button.
inline constexpr Usage multi_axis_controller = 0x0001'0008;
inline constexpr Usage x = 0x0001'0030;
inline constexpr Usage y = 0x0001'0031;
inline constexpr Usage button_1 = 0x0009'0001;

// USB Device Class Definition for Physical Interface Devices (PID) 1.0: page 0x0f.
inline constexpr Usage set_effect_report = 0x000f'0021;
inline constexpr Usage effect_block_index = 0x000f'0022;
inline constexpr Usage constant_force = 0x000f'0026;
inline constexpr Usage duration = 0x000f'0050;
inline constexpr Usage gain = 0x000f'0052;
inline constexpr Usage axes_enable = 0x000f'0055;
inline constexpr Usage direction_enable = 0x000f'0056;
inline constexpr Usage direction = 0x000f'0057;
inline constexpr Usage magnitude = 0x000f'0070;
inline constexpr Usage set_constant_force_report = 0x000f'0073;
inline constexpr Usage effect_operation_report = 0x000f'0077;
inline constexpr Usage effect_start = 0x000f'0079;
inline constexpr Usage effect_stop = 0x000f'007b;
inline constexpr Usage loop_count = 0x000f'007c;
inline constexpr Usage device_gain = 0x000f'007e;
inline constexpr Usage block_load_report = 0x000f'0089;
inline constexpr Usage load_success = 0x000f'008c;
inline constexpr Usage load_full = 0x000f'008d;
inline constexpr Usage load_error = 0x000f'008e;
inline constexpr Usage block_free_report = 0x000f'0090;
inline constexpr Usage enable_actuators = 0x000f'0097;
inline constexpr Usage disable_actuators = 0x000f'0098;
inline constexpr Usage stop_all_effects = 0x000f'0099;
inline constexpr Usage device_reset = 0x000f'009a;
inline constexpr Usage create_new_effect_report = 0x000f'00ab;

} // namespace hapnet::device::hid::usage

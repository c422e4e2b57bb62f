// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hapnet::hid_double {

/// Report IDs of the doubles: those of OpenFFBoard's source, plus `moved`, because other devices
/// have other IDs.
struct ReportIds {
    std::uint8_t moved = 0;

    [[nodiscard]] std::uint8_t input() const { return id(0x01); }
    [[nodiscard]] std::uint8_t state() const { return id(0x02); }
    [[nodiscard]] std::uint8_t set_effect() const { return id(0x01); }
    [[nodiscard]] std::uint8_t set_constant_force() const { return id(0x05); }
    [[nodiscard]] std::uint8_t effect_operation() const { return id(0x0a); }
    [[nodiscard]] std::uint8_t block_free() const { return id(0x0b); }
    [[nodiscard]] std::uint8_t device_control() const { return id(0x0c); }
    [[nodiscard]] std::uint8_t device_gain() const { return id(0x0d); }
    [[nodiscard]] std::uint8_t create_new_effect() const { return id(0x11); }
    [[nodiscard]] std::uint8_t block_load() const { return id(0x12); }
    [[nodiscard]] std::uint8_t pool() const { return id(0x13); }

private:
    [[nodiscard]] std::uint8_t id(unsigned number) const
    {
        return static_cast<std::uint8_t>(number + moved);
    }
};

/// The report descriptor of a joystick of two axes that is a PID device, written from the standard
/// in the manner of OpenFFBoard's: 16 buttons and six axes of 16 bits; device controls are bits.
[[nodiscard]] std::vector<std::byte> pid_descriptor(ReportIds ids = {});

/// The report descriptor of a SpaceMouse, as far as it is read: a multi-axis controller with
/// translation and rotation in one report each, and buttons.
[[nodiscard]] std::vector<std::byte> spacemouse_descriptor();

/// The report descriptor of an ordinary mouse with three buttons: USB HID 1.11, appendix E.10.
[[nodiscard]] std::vector<std::byte> mouse_descriptor();

[[nodiscard]] std::vector<std::byte> bytes_of(const std::vector<unsigned>& values);

} // namespace hapnet::hid_double

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "proto/base/time.hpp"

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace hapnet::device {

/// The debounced switches of a device. A switch counts as pressed or released once the device has
/// reported this for 5 ms without interruption. At first all switches count as released, so that a
/// switch that is held from the start on is a press. Switches that bounce longer are worn out, and
/// no finger presses for a shorter time.
class Buttons {
public:
    static constexpr base::Duration settling{std::chrono::milliseconds{5}};

    /// Takes the current state of the switches, one bit each, 1 for down. `now` never runs
    /// backwards. Call it once for each report from the device.
    void update(std::uint8_t down, base::TimePoint now)
    {
        for (std::size_t i = 0; i < since_.size(); ++i) {
            const auto bit = static_cast<std::uint8_t>(1U << i);
            if ((down & bit) == (held_ & bit)) {
                changing_ = static_cast<std::uint8_t>(changing_ & ~bit);
            } else if ((changing_ & bit) == 0) {
                changing_ = static_cast<std::uint8_t>(changing_ | bit);
                since_[i] = now;
            } else if (now - since_[i] >= settling) {
                changing_ = static_cast<std::uint8_t>(changing_ & ~bit);
                held_ = static_cast<std::uint8_t>(held_ ^ bit);
                if (bit == 1 && (held_ & bit) != 0) ++presses_;
            }
        }
    }

    /// Returns the buttons that are held, one bit each; bit 0 is the primary one.
    [[nodiscard]] std::uint8_t held() const { return held_; }
    /// Returns the number of presses of the primary button. It wraps around after 65535.
    [[nodiscard]] std::uint16_t presses() const { return presses_; }

    /// Writes the buttons, the grip and the presses into a sample.
    void tell(Sample& sample) const
    {
        sample.buttons = held_;
        sample.gripping = (held_ & 1U) != 0;
        sample.presses = presses_;
    }

private:
    std::uint8_t held_ = 0;
    std::uint8_t changing_ = 0; // switches that differ from held_; switch i differs since since_[i]
    std::array<base::TimePoint, 8> since_{};
    std::uint16_t presses_ = 0;
};

} // namespace hapnet::device

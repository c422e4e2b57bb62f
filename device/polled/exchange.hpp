// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/fault.hpp"
#include "proto/base/space.hpp"

#include <cstdint>
#include <optional>

namespace hapnet::device::polled {

/// A force for the device, in the frame of Sample.
struct Command {
    base::Force force{};
    bool motors_on = false;

    friend bool operator==(const Command&, const Command&) = default;
};

/// An answer of the device, in the frame and the units of Sample.
struct Report {
    std::uint64_t cycle = 0; // counted from 1; 0: no report yet
    base::Position hip{};
    base::Velocity velocity{};
    std::uint8_t buttons = 0; // one bit each, not debounced; bit 0 is the primary one
    bool calibrated = false;
    Fault fault = Fault::none;
};

/// One request to the device and its answer, over any kind of connection.
class Exchange {
public:
    Exchange() = default;
    virtual ~Exchange() = default;
    Exchange(const Exchange&) = delete;
    Exchange& operator=(const Exchange&) = delete;

    /// Sends the device the force, then reads its report. The caller counts the cycles. nullopt:
    /// the device did not answer in time. May wait. Must not throw.
    [[nodiscard]] virtual std::optional<Report> tell(const Command& command) = 0;
};

} // namespace hapnet::device::polled

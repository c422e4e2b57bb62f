// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/polled/exchange.hpp"
#include "proto/base/time.hpp"

#include <chrono>
#include <optional>

namespace hapnet::device::polled {

/// Decides which force each exchange sends. The force is zero and the motors are off before the
/// first answer, after an exchange without an answer, while the device has a fault or is not
/// calibrated, and for a force that is not finite or older than 20 ms.
class Gate {
public:
    /// Returns the command to send at `now`. `newest` is the latest command; `is_new` is true if it
    /// has changed since the last call.
    [[nodiscard]] Command pass(const Command& newest, bool is_new, base::TimePoint now);
    /// Returns the answer to the command that was sent last, with its fault or that of an answer in
    /// the last 20 ms. So code that reads less often than the device is asked misses no fault.
    [[nodiscard]] std::optional<Report> heard(std::optional<Report> report, base::TimePoint now);

    static constexpr base::Duration fresh_for{std::chrono::milliseconds{20}};
    static constexpr base::Duration fault_held_for{std::chrono::milliseconds{20}};

private:
    std::optional<base::TimePoint> given_; // time at which the newest command arrived
    bool is_trusted_ = false;              // the last answer was calibrated and had no fault
    Fault fault_ = Fault::none;            // the latest fault in an answer
    base::TimePoint fault_at_{};
};

} // namespace hapnet::device::polled

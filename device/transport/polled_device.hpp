// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "device/polled/exchange.hpp"

#include <memory>

namespace hapnet::device {

/// A device that is polled by a thread of its own, because an answer may take longer than a tick
/// allows, and a hang of the connection must not block the loop. The thread only transfers samples:
/// two thousand exchanges a second at most.
class PolledDevice final : public Device {
public:
    PolledDevice(std::unique_ptr<polled::Exchange> exchange, Identity identity,
                 const Capabilities& capabilities);
    /// Waits until three exchanges have sent zero force, but no longer than close_max. A thread
    /// that hangs releases the device when its call returns.
    ~PolledDevice() override;
    PolledDevice(const PolledDevice&) = delete;
    PolledDevice& operator=(const PolledDevice&) = delete;

    [[nodiscard]] const Identity& identity() const override;
    [[nodiscard]] const Capabilities& capabilities() const override;
    [[nodiscard]] CalibrationStep calibrate(base::TimePoint now) override;
    [[nodiscard]] Sample read(base::TimePoint now) override;
    void apply(const GovernedForce& force) override;
    void halt() noexcept override;

    static constexpr std::chrono::milliseconds close_max{500};

private:
    struct Shared;
    struct Own;
    std::shared_ptr<Shared> shared_;
    std::unique_ptr<Own> own_;
};

} // namespace hapnet::device

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/mailbox.hpp"
#include "device/hid/pid_sender.hpp"
#include "device/hid/wire.hpp"

#include <chrono>
#include <memory>

namespace hapnet::device::hid {

/// An outbox with a thread of its own. The kernel makes a write to hidraw wait for the device, for
/// up to 5 s and whatever the file's flags are, and no tick may wait that long.
class SenderThread final : public ReportSender {
public:
    SenderThread(std::unique_ptr<Wire> wire, PidSender sender);
    /// Waits for the last order to be sent, but no longer than close_max. A thread that is still
    /// blocked in a write then ends, and closes the node, when the kernel gives up.
    ~SenderThread() override;
    SenderThread(const SenderThread&) = delete;
    SenderThread& operator=(const SenderThread&) = delete;

    [[nodiscard]] Mailbox& mailbox() override;
    void wake() noexcept override;

    static constexpr std::chrono::milliseconds close_max{250};

private:
    struct Shared;
    std::shared_ptr<Shared> shared_;
};

} // namespace hapnet::device::hid

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/mailbox.hpp"
#include "device/hid/pid_sender.hpp"
#include "device/hid/wire.hpp"
#include "tests/support/hid/fake_pid.hpp"

#include <algorithm>
#include <deque>
#include <utility>

namespace hapnet::hid_double {

/// The reports of a double that are not read yet, and faults for a test to set.
struct Line {
    FakePid pid{};
    std::deque<std::vector<std::byte>> waiting{};
    bool is_gone = false;
    bool refuses = false;  // every write
    bool is_mute = false;  // answers no question
    bool is_stuck = false; // takes no reports for the time being
    std::size_t questions = 0;
};

/// A wire without an operating system below it.
class MemoryWire final : public device::hid::Wire {
public:
    explicit MemoryWire(Line& line) : line_{line} {}

    device::hid::ReadResult read(std::span<std::byte> into) override
    {
        using device::hid::TransferResult;
        if (line_.is_gone) return {TransferResult::gone, 0};
        if (line_.waiting.empty()) return {TransferResult::nothing, 0};
        const auto report = std::exchange(line_.waiting.front(), {});
        line_.waiting.pop_front();
        const std::size_t size = std::min(report.size(), into.size());
        std::copy_n(report.begin(), size, into.begin());
        return {TransferResult::yes, size};
    }
    device::hid::TransferResult write(std::span<const std::byte> report) override
    {
        if (!moves()) return failure();
        line_.pid.on_output(report);
        return device::hid::TransferResult::yes;
    }
    device::hid::TransferResult set_feature(std::span<const std::byte> report) override
    {
        if (!moves()) return failure();
        line_.pid.on_feature(report);
        return device::hid::TransferResult::yes;
    }
    device::hid::TransferResult get_feature(std::span<std::byte> report) override
    {
        ++line_.questions;
        if (!moves() || line_.is_mute) return failure();
        const auto answer = line_.pid.feature(std::to_integer<std::uint8_t>(report[0]));
        if (!answer || answer->size() > report.size()) return device::hid::TransferResult::failed;
        std::copy(answer->begin(), answer->end(), report.begin());
        return device::hid::TransferResult::yes;
    }

private:
    [[nodiscard]] bool moves() const { return !line_.is_gone && !line_.refuses; }
    [[nodiscard]] device::hid::TransferResult failure() const
    {
        return line_.is_gone ? device::hid::TransferResult::gone
                             : device::hid::TransferResult::failed;
    }

    Line& line_;
};

/// Sends at once, unless the line is stuck.
class MemoryOutbox final : public device::hid::ReportSender {
public:
    MemoryOutbox(Line& line, device::hid::PidSender sender)
        : line_{line}, wire_{line}, sender_{std::move(sender)}
    {}

    device::hid::Mailbox& mailbox() override { return mailbox_; }
    void wake() noexcept override
    {
        while (!line_.is_stuck && device::hid::send_next(mailbox_, sender_, wire_)) {}
    }

private:
    Line& line_;
    MemoryWire wire_;
    device::hid::PidSender sender_;
    device::hid::Mailbox mailbox_;
};

} // namespace hapnet::hid_double

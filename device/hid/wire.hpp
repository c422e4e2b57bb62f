// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace hapnet::device::hid {

/// The result of transferring a report.
enum class TransferResult : std::uint8_t {
    yes,
    nothing, // no report was waiting
    failed,  // the device refused it or did not answer
    gone,    // the device has gone
};

/// The result of a read.
struct ReadResult {
    TransferResult moved = TransferResult::nothing;
    std::size_t size = 0; // bytes, with the ID where reports are numbered
};

/// Transfers reports to and from a device, and takes no decisions. Used by one thread at a time.
class Wire {
public:
    Wire() = default;
    virtual ~Wire() = default;
    Wire(const Wire&) = delete;
    Wire& operator=(const Wire&) = delete;

    /// Reads the oldest waiting input report. Never waits for one. It begins with its ID only if
    /// the device numbers its reports.
    [[nodiscard]] virtual ReadResult read(std::span<std::byte> into) = 0;

    // In these calls a report always begins with an ID, 0 when reports have none. They wait as long
    // as the system does: the kernel gives up after 5 s.
    [[nodiscard]] virtual TransferResult write(std::span<const std::byte> report) = 0;
    [[nodiscard]] virtual TransferResult set_feature(std::span<const std::byte> report) = 0;
    /// Requests the report whose ID is the first byte, and stores it in `report`. Use it only while
    /// a device is being opened: a request without an answer delays all later reports, including
    /// those that would stop the device.
    [[nodiscard]] virtual TransferResult get_feature(std::span<std::byte> report) = 0;
};

} // namespace hapnet::device::hid

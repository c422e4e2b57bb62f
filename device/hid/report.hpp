// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/pid_layout.hpp"

#include <array>
#include <cstddef>
#include <span>

namespace hapnet::device::hid {

/// A report to be sent: its ID, or 0 where reports have none, and its data.
struct Report {
    std::array<std::byte, report_bytes_max> bytes{};
    std::size_t size = 0; // length in bytes, with the ID

    Report() = default;
    /// Makes a report with zeros as data.
    explicit Report(const ReportPlace& place) : size{place.bytes + 1}
    {
        bytes[0] = std::byte{place.id};
    }

    [[nodiscard]] std::span<const std::byte> all() const { return std::span{bytes}.first(size); }
    [[nodiscard]] std::span<std::byte> all() { return std::span{bytes}.first(size); }
    [[nodiscard]] std::span<const std::byte> data() const { return all().subspan(1); }
    [[nodiscard]] std::span<std::byte> data() { return all().subspan(1); }
};

} // namespace hapnet::device::hid

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hapnet::device::hid {

/// The usage of an item: page << 16 | id, as in the HID usage tables.
using Usage = std::uint32_t;

/// The three sets of reports of a device.
enum class ReportKind : std::uint8_t { input, output, feature };

/// Consecutive usages, both ends included.
struct UsageRange {
    Usage first = 0;
    Usage last = 0;

    friend bool operator==(const UsageRange&, const UsageRange&) = default;
};

/// One value in a report, at most 32 bits long, and its meaning.
struct Field {
    ReportKind kind = ReportKind::input;
    std::uint8_t report_id = 0;   // 0: the device does not number its reports
    std::uint32_t bit_offset = 0; // offset in the report's data, after its ID
    std::uint32_t bit_size = 0;
    std::int64_t logical_min = 0;
    std::int64_t logical_max = 0;
    std::int64_t physical_min = 0; // both 0: equal to the logical range
    std::int64_t physical_max = 0;
    std::uint32_t unit = 0;
    int unit_exponent = 0; // power of ten
    bool is_array = false; // the value selects one of the usages: see value_of()
    /// The usage of a variable, or the usages of an array in the order of the values; may be empty.
    std::vector<UsageRange> usages{};
    std::vector<Usage> collections{}; // usages of the enclosing collections, outermost first

    friend bool operator==(const Field&, const Field&) = default;
};

/// True if the field is a variable with this usage.
[[nodiscard]] bool is_variable_of(const Field& field, Usage usage);
/// True if an enclosing collection of the field has this usage.
[[nodiscard]] bool lies_in(const Field& field, Usage collection);
/// Returns the value by which an array field represents `usage`; nullopt if it cannot.
[[nodiscard]] std::optional<std::int64_t> value_of(const Field& array, Usage usage);

/// The length of a report.
struct ReportSize {
    ReportKind kind = ReportKind::input;
    std::uint8_t report_id = 0;
    std::uint32_t bits = 0; // length without the ID

    friend bool operator==(const ReportSize&, const ReportSize&) = default;
};

/// A device's description of the reports that it sends and accepts.
struct Descriptor {
    std::vector<Field> fields{}; // in the order of the descriptor; without padding
    std::vector<ReportSize> reports{};
    std::vector<Usage> collections{}; // each usage once, in the order of appearance
    bool is_numbered = false;         // reports begin with their ID

    /// Returns the length of the data of a report, without its ID, in bytes; 0: there is no such
    /// report.
    [[nodiscard]] std::size_t bytes_of(ReportKind kind, std::uint8_t report_id) const;

    friend bool operator==(const Descriptor&, const Descriptor&) = default;
};

/// The greatest length of a descriptor. Longer ones are refused, as the kernel refuses them
/// (HID_MAX_DESCRIPTOR_SIZE).
inline constexpr std::size_t descriptor_bytes_max = 4096;

/// Reads a report descriptor: USB Device Class Definition for HID 1.11, section 6.2.2. Refuses
/// descriptors that are truncated, unbalanced or out of bounds, or that have delimiters. Fields of
/// more than 32 bits occupy their bits but are not listed.
[[nodiscard]] base::Result<Descriptor> parse_descriptor(std::span<const std::byte> bytes);

} // namespace hapnet::device::hid

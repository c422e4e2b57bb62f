// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hid/field.hpp"
#include "device/hid/pid_reports.hpp"
#include "device/hid/pid_sender.hpp"
#include "device/hid/spacemouse_report.hpp"
#include "proto/base/ensure.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <array>
#include <vector>

namespace {

using namespace hapnet::device::hid;
using hapnet::base::ensure;

/// Every accepted description allows messages to its device.
void speak(const ForceLayout& layout)
{
    const std::array<std::uint32_t, 2> blocks{1, 2};
    PidSender sender{layout, blocks};
    Order order{.levels = {32767, -32767}, .motors_on = true, .probes = 1, .number = 1};
    int reports = 0;
    while (const auto report = sender.next(order)) ensure(report->size > 0 && ++reports < 100);
    order.motors_on = false;
    order.is_last = true;
    while (const auto report = sender.next(order)) ensure(report->size > 0 && ++reports < 100);
    for (const Axis axis : {Axis::right, Axis::away}) {
        ensure(set_effect_report(layout, 1, axis).size > 0);
    }
    ensure(create_report(layout).size > 0);
    const BlockLoadResult loaded = read_block_load(layout, Report{layout.block_load.place});
    ensure(loaded.load != Load::success || loaded.block > 0);
}

} // namespace

/// Accepted fields lie inside their reports: all values can be read, and written back to the same
/// bits. A device whose description gives a layout of forces can be driven. Errors are not empty.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const auto bytes = hapnet::fuzz::bytes_of(data, size);
    const auto word = read_spacemouse(bytes);
    ensure(!word || !word->deflection || std::abs(word->deflection->x) <= deflection_valid_max);
    const auto descriptor = parse_descriptor(bytes);
    ensure(descriptor || !descriptor.error().message.empty());
    if (!descriptor) return 0;
    for (const Field& field : descriptor->fields) {
        std::vector<std::byte> report(descriptor->bytes_of(field.kind, field.report_id));
        for (std::size_t i = 0; i < report.size(); ++i) report[i] = bytes[i % bytes.size()];
        const auto before = report;
        const auto value = unpack(field, report);
        if (value) pack_bits(field, static_cast<std::uint32_t>(*value), report);
        ensure(report == before);
        ensure(!unpack(field, std::span{report}.first(field.bit_offset / 8)));
    }
    ensure(find_input(*descriptor) || !find_input(*descriptor).error().message.empty());
    if (const auto force = find_force(*descriptor)) speak(*force);
    return 0;
}

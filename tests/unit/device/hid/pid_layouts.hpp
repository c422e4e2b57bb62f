// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/hid/pid_reports.hpp"
#include "device/hid/recognise.hpp"
#include "tests/support/hid/memory_pid.hpp"

#include <cstddef>
#include <vector>

namespace hapnet::device::hid {

[[nodiscard]] inline ForceLayout layout_of(hid_double::ReportIds ids)
{
    return find_force(parse_descriptor(hid_double::pid_descriptor(ids)).value()).value();
}

[[nodiscard]] inline std::vector<std::byte> bytes(const Report& report)
{
    return {report.all().begin(), report.all().end()};
}

} // namespace hapnet::device::hid

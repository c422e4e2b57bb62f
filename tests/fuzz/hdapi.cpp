// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/hdapi/mapping.hpp"
#include "device/hdapi/stylus.hpp"
#include "tests/fuzz/fuzz_target.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <string>
#include <type_traits>

namespace {

using namespace hapnet;
using namespace device::hdapi;

/// Fills a value from the front of the bytes; from what is left of them where they end.
template <typename T>
T taken_from(std::span<const std::byte>& bytes)
{
    static_assert(std::is_trivially_copyable_v<T>);
    T value{};
    const std::size_t size = std::min(sizeof value, bytes.size());
    if (size > 0) std::memcpy(&value, bytes.data(), size);
    bytes = bytes.subspan(size);
    return value;
}

bool is_a_figure(double value) { return std::isfinite(value) && value > 0.0; }

void expect_capabilities_that_make_sense(const Properties& properties)
{
    const device::Capabilities can = capabilities_of(properties);
    for (const int axis : {0, 1, 2}) {
        const double length = can.workspace_max.value[axis] - can.workspace_min.value[axis];
        base::ensure(length > 0.009 && length < 11.0);
    }
    base::ensure(is_a_figure(can.force_max_n) && is_a_figure(can.force_continuous_n));
    base::ensure(can.force_continuous_n <= can.force_max_n);
    base::ensure(is_a_figure(can.stiffness_max_n_per_m) && is_a_figure(can.damping_max_ns_per_m));
    base::ensure(is_a_figure(can.speed_max_m_per_s) && is_a_figure(can.rate_hz));
}

Report report_from(std::span<const std::byte>& bytes)
{
    Report report;
    report.cycle = taken_from<std::uint8_t>(bytes);
    for (double& value : report.position_mm) value = taken_from<double>(bytes);
    for (double& value : report.velocity_mm_per_s) value = taken_from<double>(bytes);
    report.buttons = taken_from<int>(bytes);
    report.calibration = 0x5000U + taken_from<std::uint8_t>(bytes) % 4U;
    report.error = taken_from<std::uint16_t>(bytes);
    report.error_cycle = taken_from<std::uint8_t>(bytes);
    report.failures_in_a_row = taken_from<std::uint8_t>(bytes);
    return report;
}

} // namespace

/// Whatever the library reports, its errors become faults, its figures make sense or are not used,
/// its texts are one line that is safe for terminals and JSON, and samples are finite.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    auto bytes = fuzz::bytes_of(data, size);
    const std::string said{reinterpret_cast<const char*>(data), size};
    const std::string text = text_of(said.c_str());
    base::ensure(text.size() <= text_bytes_max);
    base::ensure(
        std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; }));
    base::ensure(text_of(text.c_str()) == text);

    const auto code = taken_from<unsigned int>(bytes);
    base::ensure((code == error::none) == (fault_of(code) == device::Fault::none));
    base::ensure(!describe_error("", code, text).empty());

    Properties properties;
    for (double& value : properties.workspace_mm) value = taken_from<double>(bytes);
    for (double* value : {&properties.force_max_n, &properties.force_continuous_n,
                          &properties.stiffness_max_n_per_mm, &properties.damping_max_ns_per_mm,
                          &properties.velocity_limit_mm_per_s}) {
        *value = taken_from<double>(bytes);
    }
    properties.update_rate_hz = taken_from<int>(bytes);
    properties.calibration_styles = taken_from<int>(bytes);
    expect_capabilities_that_make_sense(properties);
    const int style = preferred_style(properties.calibration_styles);
    base::ensure(style == calibration::style_inkwell || style == calibration::style_automatic ||
                 style == calibration::style_encoder_reset);

    Stylus stylus{style};
    base::TimePoint now{std::chrono::hours{1}};
    std::uint64_t seen = 0;
    while (!bytes.empty()) {
        now += std::chrono::milliseconds{1};
        const Report report = report_from(bytes);
        const device::Sample& sample = stylus.read(report, now);
        base::ensure(base::is_finite(sample.hip) && base::is_finite(sample.velocity));
        base::ensure(sample.sequence >= report.cycle);
        if (report.cycle <= seen) continue;
        seen = report.cycle;
        base::ensure(sample.calibrated == (report.calibration == calibration::done));
    }
    return 0;
}

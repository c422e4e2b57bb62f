// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "device/device.hpp"
#include "peer/self_test/self_test.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/value_kind.hpp"
#include "proto/base/version.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hapnet::peer::self_test {

/// Returns the report for people.
[[nodiscard]] std::string report_text(const device::Device& device, const SelfTest& test);

/// The device's capabilities.
struct CapabilitiesReport : device::Capabilities {};
constexpr auto fields_of(base::Tag<CapabilitiesReport>)
{
    using C = CapabilitiesReport;
    return base::fields(
        "capabilities", base::member("axes_in", &C::axes_in, "Axes that it measures."),
        base::member("axes_out", &C::axes_out, "Axes with a motor."),
        base::member("buttons", &C::buttons, "Its buttons."),
        base::member("force_max_n", &C::force_max_n, "The peak of its force."),
        base::member("force_continuous_n", &C::force_continuous_n,
                     "What its motors bear for ever."),
        base::member("force_is_calibrated", &C::force_is_calibrated, "Whether a newton is one."),
        base::member("stiffness_max_n_per_m", &C::stiffness_max_n_per_m,
                     "Of a contact that stays stable; 0: not known."),
        base::member("damping_max_ns_per_m", &C::damping_max_ns_per_m, "Likewise."),
        base::member("resolution_m", &C::resolution_m, "Of positions."),
        base::member("rate_hz", &C::rate_hz, "The nominal rate of its reports."));
}

/// The device that was tested.
struct TestedDevice {
    device::Identity identity;
    CapabilitiesReport can;
};
constexpr auto fields_of(base::Tag<TestedDevice>)
{
    using T = TestedDevice;
    return base::fields(
        "device",
        base::computed<T>(
            "backend", [](const T& one) -> const auto& { return one.identity.backend; },
            "As in `--device BACKEND:SERIAL`."),
        base::computed<T>(
            "serial", [](const T& one) -> const auto& { return one.identity.serial; },
            "Empty: it has none."),
        base::computed<T>(
            "model", [](const T& one) -> const auto& { return one.identity.model; },
            "What it is called."),
        base::computed<T>(
            "note", [](const T& one) -> const auto& { return one.identity.note; },
            "What its user should know."),
        base::member("capabilities", &T::can, "What it can do."));
}

/// The report that docs/use/hardware.md asks people to send.
struct SelfTestReport {
    TestedDevice device;
    std::string_view version = base::version();
    std::string_view commit = base::commit();
    std::vector<Outcome> steps;
    bool is_finished = false;
    bool has_failed = false;
    bool has_passed = false;
};
constexpr auto fields_of(base::Tag<SelfTestReport>)
{
    using R = SelfTestReport;
    return base::fields(
        "self-test", base::member("device", &R::device, "The device that was tested."),
        base::member("version", &R::version, "The version of the program."),
        base::member("commit", &R::commit, "The commit that it was built from."),
        base::member("steps", &R::steps, "What came of each step."),
        base::member("finished", &R::is_finished, "Whether the test came to its end."),
        base::member("failed", &R::has_failed, "Whether a step failed."),
        base::member("passed", &R::has_passed, "Finished, and no step failed."));
}
[[nodiscard]] SelfTestReport report_of(const device::Device& device, const SelfTest& test);
/// True if the test was completed and no step failed.
[[nodiscard]] bool has_passed(const SelfTest& test);
/// True if the step with force was done and passed.
[[nodiscard]] bool has_shown_force(const SelfTest& test);

} // namespace hapnet::peer::self_test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/report.hpp"

#include "proto/base/version.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::self_test {

namespace {

bool has_failed(const SelfTest& test)
{
    const auto& outcomes = test.outcomes();
    return std::any_of(outcomes.begin(), outcomes.end(),
                       [](const Outcome& one) { return one.verdict == Verdict::failed; });
}

nlohmann::json capabilities_json(const device::Capabilities& can)
{
    return {{"axes_in", can.axes_in},
            {"axes_out", can.axes_out},
            {"buttons", can.buttons},
            {"force_max_n", can.force_max_n},
            {"force_continuous_n", can.force_continuous_n},
            {"force_is_calibrated", can.force_is_calibrated},
            {"stiffness_max_n_per_m", can.stiffness_max_n_per_m},
            {"damping_max_ns_per_m", can.damping_max_ns_per_m},
            {"resolution_m", can.resolution_m},
            {"rate_hz", can.rate_hz}};
}

} // namespace

std::string report_text(const device::Device& device, const SelfTest& test)
{
    std::string text = fmt::format("self-test of {}\n", device::description(device));
    for (const Outcome& one : test.outcomes()) {
        text += fmt::format("{:<7}  {:<9}  {}\n", name_of(one.verdict), one.step, one.text);
        std::string_view rest = one.drawing;
        while (!rest.empty()) {
            const auto end = std::min(rest.find('\n'), rest.size() - 1);
            text += fmt::format("{:20}{}", "", rest.substr(0, end + 1));
            rest.remove_prefix(end + 1);
        }
    }
    if (!test.is_finished()) text += "NOT FINISHED: the remaining steps were not tested\n";
    return text;
}

nlohmann::json report_json(const device::Device& device, const SelfTest& test)
{
    const device::Identity& identity = device.identity();
    auto steps = nlohmann::json::array();
    for (const Outcome& one : test.outcomes()) {
        nlohmann::json step{
            {"step", one.step}, {"verdict", name_of(one.verdict)}, {"text", one.text}};
        for (const Figure& figure : one.figures) step[std::string{figure.name}] = figure.value;
        steps.push_back(std::move(step));
    }
    return {{"device",
             {{"backend", identity.backend},
              {"serial", identity.serial},
              {"model", identity.model},
              {"note", identity.note},
              {"capabilities", capabilities_json(device.capabilities())}}},
            {"version", base::version()},
            {"commit", base::commit()},
            {"steps", steps},
            {"finished", test.is_finished()},
            {"failed", has_failed(test)},
            {"passed", has_passed(test)}};
}

bool has_passed(const SelfTest& test) { return test.is_finished() && !has_failed(test); }

bool has_shown_force(const SelfTest& test)
{
    const auto& outcomes = test.outcomes();
    return std::any_of(outcomes.begin(), outcomes.end(), [](const Outcome& outcome) {
        return outcome.step == "force" && outcome.verdict == Verdict::passed;
    });
}

} // namespace hapnet::peer::self_test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/report.hpp"

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

SelfTestReport report_of(const device::Device& device, const SelfTest& test)
{
    return {.device = {device.identity(), {device.capabilities()}},
            .steps = test.outcomes(),
            .is_finished = test.is_finished(),
            .has_failed = has_failed(test),
            .has_passed = has_passed(test)};
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

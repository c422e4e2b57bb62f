// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/self_test/report.hpp"

#include "proto/base/version.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>

namespace hapnet::peer::self_test {

std::string report_text(const std::string& device, const std::vector<Outcome>& outcomes)
{
    std::string text = fmt::format("self-test of {}\n", device);
    for (const Outcome& one : outcomes) {
        text += fmt::format("{:<7}  {:<9}  {}\n", name_of(one.verdict), one.step, one.text);
        std::string_view rest = one.drawing;
        while (!rest.empty()) {
            const auto end = std::min(rest.find('\n'), rest.size() - 1);
            text += fmt::format("{:20}{}", "", rest.substr(0, end + 1));
            rest.remove_prefix(end + 1);
        }
    }
    return text;
}

nlohmann::json report_json(const device::Device& device, const std::vector<Outcome>& outcomes)
{
    const device::Identity& identity = device.identity();
    auto steps = nlohmann::json::array();
    for (const Outcome& one : outcomes) {
        nlohmann::json step{
            {"step", one.step}, {"verdict", name_of(one.verdict)}, {"text", one.text}};
        for (const Figure& figure : one.figures) step[std::string{figure.name}] = figure.value;
        steps.push_back(std::move(step));
    }
    return {{"device",
             {{"backend", identity.backend},
              {"serial", identity.serial},
              {"model", identity.model},
              {"note", identity.note}}},
            {"version", base::version()},
            {"commit", base::commit()},
            {"steps", steps},
            {"failed", has_failed(outcomes)}};
}

bool has_failed(const std::vector<Outcome>& outcomes)
{
    return std::any_of(outcomes.begin(), outcomes.end(),
                       [](const Outcome& one) { return one.verdict == Verdict::failed; });
}

} // namespace hapnet::peer::self_test

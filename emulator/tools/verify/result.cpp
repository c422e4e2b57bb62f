// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/tools/verify/result.hpp"

#include <utility>

namespace hapnet::emulator::tools {

TestResult by_chance(std::string name, double statistic, double p_value, double alpha)
{
    // This form makes a p-value that is not a number fail.
    const bool passes = p_value >= alpha;
    return {std::move(name), statistic, p_value, passes ? Outcome::passed : Outcome::failed, {}};
}

TestResult exactly(std::string name, bool holds, std::string sentence)
{
    return {
        std::move(name), 0.0, {}, holds ? Outcome::passed : Outcome::failed, std::move(sentence)};
}

TestResult unable(std::string name, std::string sentence)
{
    return {std::move(name), 0.0, {}, Outcome::unable, std::move(sentence)};
}

} // namespace hapnet::emulator::tools

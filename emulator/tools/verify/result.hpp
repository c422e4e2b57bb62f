// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <cstdint>
#include <optional>
#include <string>

namespace hapnet::emulator::tools {

enum class Outcome : std::uint8_t {
    passed,
    failed,
    unable, // the test has too little evidence, or the wrong kind
};
constexpr auto names_of(base::Tag<Outcome>) { return base::names("passed", "failed", "unable"); }

/// The result of one test on the observations.
struct TestResult {
    std::string name;                // "share lost"
    double statistic = 0.0;          // its meaning is in `sentence`
    std::optional<double> p_value{}; // two-sided; nullopt: exact, or unable
    Outcome outcome = Outcome::unable;
    std::string sentence; // expected and observed, in words
};
constexpr auto fields_of(base::Tag<TestResult>)
{
    using R = TestResult;
    return base::fields(
        "test", base::member("test", &R::name, "Its name."),
        base::member("outcome", &R::outcome,
                     "`unable`: there is too little evidence for it, or of the wrong kind."),
        base::member("statistic", &R::statistic, "What it is says `says`."),
        base::member("p_value", &R::p_value,
                     "Two-sided; null for an exact comparison, and for a test that is unable."),
        base::member("says", &R::sentence, "What was expected and observed, in words."));
}

/// Fails when p < alpha. If the law is right, this happens with the probability alpha.
[[nodiscard]] TestResult by_chance(std::string name, double statistic, double p_value,
                                   double alpha);

/// Fails if the property does not hold exactly.
[[nodiscard]] TestResult exactly(std::string name, bool holds, std::string sentence);

[[nodiscard]] TestResult unable(std::string name, std::string sentence);

} // namespace hapnet::emulator::tools

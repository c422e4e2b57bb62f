// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::emulator::tools {

enum class Outcome : std::uint8_t {
    passed,
    failed,
    unable, // the evidence is too little, or of the wrong kind, for this test
};
[[nodiscard]] std::string_view to_text(Outcome outcome);

/// What one test says of what was observed.
struct TestResult {
    std::string name;                // "share lost"
    double statistic = 0.0;          // what it is says the sentence
    std::optional<double> p_value{}; // two-sided; nullopt: exact, or unable
    Outcome outcome = Outcome::unable;
    std::string sentence; // expected and observed, in words
};

/// Fails when p < alpha: for a law that is right, this happens with the probability alpha.
[[nodiscard]] TestResult by_chance(std::string name, double statistic, double p_value,
                                   double alpha);

/// Fails on the first deviation.
[[nodiscard]] TestResult exactly(std::string name, bool holds, std::string sentence);

[[nodiscard]] TestResult unable(std::string name, std::string sentence);

} // namespace hapnet::emulator::tools

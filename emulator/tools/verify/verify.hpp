// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/fate.hpp"
#include "emulator/tools/verify/result.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hapnet::emulator::tools {

/// The intended conditions of a run, constant from its first datagram to its last.
struct Claim {
    Path path;
    std::optional<base::Seed> seed{};        // if known, the fates are drawn again and compared
    std::optional<base::Duration> spacing{}; // between datagrams, if they came evenly; > 0
    double alpha = 1e-6;                     // how often a test fails if the law is right
    std::string name{};                      // name of the path, if there are several
};

/// The test results for the fates of a run.
struct Verification {
    std::vector<TestResult> up;
    std::vector<TestResult> down;
    std::vector<TestResult> between; // tests of both directions together

    [[nodiscard]] bool failed() const;
};
constexpr auto fields_of(base::Tag<Verification>)
{
    using V = Verification;
    return base::fields(
        "verification",
        base::computed<V>(
            "passed", [](const V& of) { return !of.failed(); }, "No test failed."),
        base::member("up", &V::up, "The tests of A to B."),
        base::member("down", &V::down, "Those of B to A."),
        base::member("between", &V::between, "Those of the two against each other."));
}

/// Runs every test that applies. Fate n is that of datagram n of its direction.
[[nodiscard]] Verification verify(const Claim& claim, std::span<const Fate> up,
                                  std::span<const Fate> down);

/// Returns the tests of one direction.
[[nodiscard]] std::vector<TestResult> verify_direction(const Claim& claim, Direction direction,
                                                       std::span<const Fate> fates);

/// Returns one line per test, and one with the verdict.
[[nodiscard]] std::string to_text(const Verification& verification);

} // namespace hapnet::emulator::tools

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <variant>

namespace hapnet::emulator {

class QuantileTable;
class DelayTrace;

/// No delay is longer: what a law draws beyond ends here.
inline constexpr base::Duration longest_delay = std::chrono::seconds{1'000'000};

// The laws that a delay or a jitter may follow, as a person states them. Each parameter is called
// what it is: no law has a bare "jitter". `mean` may be zero (a jitter around the delay) or
// negative for the symmetric laws only; widths and deviations are not negative.

/// Always the same.
struct ConstantLaw {
    base::Duration value{};

    friend bool operator==(const ConstantLaw&, const ConstantLaw&) = default;
};

/// Uniform on [mean - half_width, mean + half_width]; standard deviation half_width / sqrt(3).
struct UniformLaw {
    base::Duration mean{};
    base::Duration half_width{};

    friend bool operator==(const UniformLaw&, const UniformLaw&) = default;
};

/// Gaussian.
struct NormalLaw {
    base::Duration mean{};
    base::Duration sd{};

    friend bool operator==(const NormalLaw&, const NormalLaw&) = default;
};

/// exp of a Gaussian; mean and sd are those of the delay itself, not of its logarithm. mean > 0.
struct LogNormalLaw {
    base::Duration mean{};
    base::Duration sd{};

    friend bool operator==(const LogNormalLaw&, const LogNormalLaw&) = default;
};

/// Exponential on [0, infinity); standard deviation = mean.
struct ExponentialLaw {
    base::Duration mean{};

    friend bool operator==(const ExponentialLaw&, const ExponentialLaw&) = default;
};

/// Pareto (of the first kind) on [mean (shape - 1) / shape, infinity); shape > 1. Its standard
/// deviation is infinite for shape <= 2.
struct ParetoLaw {
    base::Duration mean{};
    double shape = 3.0;

    friend bool operator==(const ParetoLaw&, const ParetoLaw&) = default;
};

/// Gamma on [0, infinity); mean > 0, 0 < sd <= 10 mean.
struct GammaLaw {
    base::Duration mean{};
    base::Duration sd{};

    friend bool operator==(const GammaLaw&, const GammaLaw&) = default;
};

/// Drawn from a table: a netem .dist file, which is in units of its own, or a file of measured
/// delays. Stretched and moved until its mean and sd are exactly these; measured delays are taken
/// as they are when both are zero.
struct TableLaw {
    std::string file;
    base::Duration mean{};
    base::Duration sd{};
    std::shared_ptr<const QuantileTable> table; // never null

    friend bool operator==(const TableLaw&, const TableLaw&);
};

/// Read off a trace instead of drawn: value n for datagram n, or the value at its time; either
/// begins again at its end.
struct TraceLaw {
    std::string file;
    std::shared_ptr<const DelayTrace> trace; // never null

    friend bool operator==(const TraceLaw&, const TraceLaw&);
};

using DelayLaw = std::variant<ConstantLaw, UniformLaw, NormalLaw, LogNormalLaw, ExponentialLaw,
                              ParetoLaw, GammaLaw, TableLaw, TraceLaw>;

/// How a delay, or the jitter around it, varies from datagram to datagram.
struct Variation {
    DelayLaw law = ConstantLaw{};
    /// Draws that lie t apart in arrival time are correlated by exp(-t / correlation_time)
    /// (Gaussian copula: the law itself stays exact); zero: independent. Not for traces.
    base::Duration correlation_time{};

    friend bool operator==(const Variation&, const Variation&) = default;
};

[[nodiscard]] inline Variation constant(base::Duration value) { return {ConstantLaw{value}, {}}; }
/// Around zero.
[[nodiscard]] inline Variation uniform(base::Duration half_width)
{
    return {UniformLaw{{}, half_width}, {}};
}

/// What is wrong with it, in words that follow the name of the setting ("sd must be more than
/// 0"); nullopt when it can be drawn. Whoever makes a law from what a person typed asks here.
[[nodiscard]] std::optional<std::string> objection(const Variation& variation);

/// Whether it adds nothing to any datagram.
[[nodiscard]] bool is_nothing(const Variation& variation);

} // namespace hapnet::emulator

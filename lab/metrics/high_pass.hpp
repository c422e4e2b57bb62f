// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace hapnet::lab::metrics {

/// The cutoff frequency of a filter, in hertz, and its sampling.
struct Cutoff {
    double hertz = 20.0;
    double tick_s = 0.001;
};

/// A filter section of second order, or of first order with b2 = a2 = 0: y = b0 x + b1 x' + b2 x''
/// - a1 y' - a2 y''. It has the transposed direct form II, whose rounding stays small at low
/// cutoffs.
class Section {
public:
    struct Coefficients {
        double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
    };

    explicit Section(const Coefficients& coefficients) : c_{coefficients} {}

    double step(double x)
    {
        const double y = c_.b0 * x + first_;
        first_ = c_.b1 * x - c_.a1 * y + second_;
        second_ = c_.b2 * x - c_.a2 * y;
        return y;
    }

    /// Sets the state as if the input had been `x` for ever. Returns the output.
    double settle(double x);

private:
    Coefficients c_;
    double first_ = 0.0;
    double second_ = 0.0;
};

// Butterworth filters by the bilinear transform, prewarped so that the gain at the cutoff is
// exactly 1/sqrt(2). The bits are the same everywhere.

[[nodiscard]] Section first_order_high_pass(const Cutoff& cutoff);
/// Makes a section. `quality` is 1/sqrt(2) for a filter of this section alone.
[[nodiscard]] Section second_order_high_pass(const Cutoff& cutoff, double quality);
[[nodiscard]] Section second_order_low_pass(const Cutoff& cutoff, double quality);

/// A value for each of the filter orders in which vibration is measured.
struct ByOrder {
    double first = 0.0;
    double second = 0.0;
    double fourth = 0.0;

    friend bool operator==(const ByOrder&, const ByOrder&) = default;
};

inline constexpr base::Quantity vibration_format{base::length_kind, 0.0};
/// In a text the values are lengths.
constexpr auto fields_of(base::Tag<ByOrder>)
{
    return base::fields(
        "by order",
        base::field("first", &ByOrder::first, vibration_format, "with a filter of first order"),
        base::field("second", &ByOrder::second, vibration_format, "with a filter of second order"),
        base::field("fourth", &ByOrder::fourth, vibration_format, "with a filter of fourth order"));
}

/// Returns the root mean square of the part of `signal` above `cutoff`, in the signal's unit, by
/// Butterworth high-passes of first, second and fourth order. The filters see every sample. Only
/// the samples that `counts` marks enter the mean; all do when `counts` is empty. Before its first
/// sample, the signal is assumed to have had that value. nullopt when no sample counts.
[[nodiscard]] std::optional<ByOrder> vibration_of(std::span<const double> signal,
                                                  std::span<const std::uint8_t> counts,
                                                  const Cutoff& cutoff);

/// Returns the root mean square of `signal` between two cutoffs, by a high-pass and a low-pass of
/// second order. nullopt when the signal is empty.
[[nodiscard]] std::optional<double> band_vibration_of(std::span<const double> signal,
                                                      const Cutoff& from, const Cutoff& to);

} // namespace hapnet::lab::metrics

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/high_pass.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace hapnet::lab {

enum class FilterOrder : std::uint8_t { first, second, fourth };

[[nodiscard]] double at_order(const ByOrder& values, FilterOrder order);

/// The two-tier convention: what a session must keep to be usable, and what besides to be good.
/// A convention and not a finding about people; print_criteria() says where each number comes
/// from. SI units, ratios and shares as fractions.
struct Criteria {
    /// Of the high-pass by which vibration is judged.
    FilterOrder filter_order = FilterOrder::first;
    /// A, for each order of the filter: calibrated.
    ByOrder vibration_max_m{.first = 1.05e-3, .second = 1.01e-3, .fourth = 1.0e-3};
    /// B at 1 Hz: calibrated.
    double stiffness_ratio_min = 0.049;
    /// E, in excess of the perfect network's: a tap on a rigid cube alone has more than 0.1 N.
    double force_vibration_max_n = 0.1;
    /// Of the time that both sides run on a perfect network, what they must run.
    double scored_share_min = 0.95;

    double good_stiffness_ratio_min = 0.77;  // B
    double good_force_discrepancy_max = 0.1; // C
    double good_contact_lost_max = 0.05;     // F
    double good_drag_max_n = 0.3;            // I

    friend bool operator==(const Criteria&, const Criteria&) = default;
};

/// `source` names the text in errors, which say line and column. What is left out has its default.
[[nodiscard]] base::Result<Criteria> parse_criteria(std::string_view text,
                                                    const std::string& source);

/// TOML that reads back as the same criteria; its comments say where each number comes from.
[[nodiscard]] std::string print_criteria(const Criteria& criteria);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/high_pass.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/result.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace hapnet::lab::metrics {

enum class FilterOrder : std::uint8_t { first, second, fourth };

/// The orders as numbers, in the order of FilterOrder.
inline constexpr std::array<std::uint32_t, 3> filter_order_counts{1, 2, 4};
[[nodiscard]] constexpr std::uint32_t count_of(FilterOrder order)
{
    return filter_order_counts[static_cast<std::size_t>(order)];
}

/// The order of a filter in a text: 1, 2 or 4.
struct FilterOrderFormat {
    void read(const base::Node& node, FilterOrder& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(FilterOrder order) const;
    [[nodiscard]] std::string describe() const { return "the filter order 1, 2 or 4"; }
};

[[nodiscard]] double at_order(const ByOrder& values, FilterOrder order);

/// The limits that a usable session must keep.
struct UsableCriteria {
    ByOrder vibration_max_m{.first = 1.0e-3, .second = 0.97e-3, .fourth = 0.95e-3};
    double slow_stiffness_error_max = 0.859;
    /// The greatest force vibration that the network may add to the vibration on the perfect
    /// network, where a tap on a rigid cube alone has more than 0.1 N.
    double force_vibration_max_n = 0.1;
    double scored_share_min = 0.95;
    double discrepancy_max_m = 13.8e-3;
    std::optional<double> turned_apart_max_rad{};

    friend bool operator==(const UsableCriteria&, const UsableCriteria&) = default;
};

/// The further limits that a good session must keep.
struct GoodCriteria {
    double stiffness_error_max = 0.23;
    double force_discrepancy_max = 0.1;
    double contact_lost_max = 0.05;
    double drag_max_n = 0.3;
    double discrepancy_max_m = 5e-3;
    std::optional<double> turned_apart_max_rad{};

    friend bool operator==(const GoodCriteria&, const GoodCriteria&) = default;
};

/// The two-tier convention. It is a convention and not a finding about people: the descriptions of
/// the fields below say where each number comes from. SI units; ratios and shares are fractions.
struct Criteria {
    FilterOrder filter_order = FilterOrder::first; // order of the high-pass filter for vibration
    UsableCriteria usable{};
    GoodCriteria good{};

    friend bool operator==(const Criteria&, const Criteria&) = default;
};

inline constexpr base::Number ratio_format{0.0, 1.0};
inline constexpr base::Number error_format{0.0, 100.0};
inline constexpr base::Quantity newton_format{base::force_kind, 0.0};
inline constexpr base::Quantity turn_format{base::angle_kind, 0.0};
inline constexpr std::string_view about_usable_discrepancy =
    "D, the mean distance in x of the two copies farthest apart: that of base in the paper's "
    "Table 1, measured at the delay that its Fig. 6a calls the limit.";
inline constexpr std::string_view about_good_discrepancy =
    "D, the mean distance in x of the two copies farthest apart: a convention, the radius of the "
    "haptic interface point.";
inline constexpr std::string_view about_turned_apart =
    "D of a body that turns, the mean angle between the two copies farthest apart. Without it not "
    "judged.";

constexpr auto fields_of(base::Tag<UsableCriteria>)
{
    using Usable = UsableCriteria;
    return base::fields(
        "usable",
        base::field("vibration_max", &Usable::vibration_max_m, base::Table{},
                    "A. Calibrated: half of base's sessions of T1 are usable at 93 % random loss."),
        base::field("slow_stiffness_error_max", &Usable::slow_stiffness_error_max, error_format,
                    "B at 0.5 Hz. Calibrated: half of base's sessions of T2 are usable at 160 ms "
                    "of delay."),
        base::field("force_vibration_max", &Usable::force_vibration_max_n, newton_format,
                    "E, what the network adds of it. A working limit, from no source."),
        base::field("scored_share_min", &Usable::scored_share_min, ratio_format,
                    "Of the time that both sides would run: a session that hardly took place does "
                    "not count."),
        base::field("discrepancy_max", &Usable::discrepancy_max_m, vibration_format,
                    about_usable_discrepancy),
        base::field("turned_apart_max", &Usable::turned_apart_max_rad, turn_format,
                    about_turned_apart));
}

constexpr auto fields_of(base::Tag<GoodCriteria>)
{
    using Good = GoodCriteria;
    return base::fields(
        "good",
        base::field("stiffness_error_max", &Good::stiffness_error_max, error_format,
                    "B, the worst of 0.5, 1 and 2 Hz. The just noticeable difference of stiffness, "
                    "23 % (Jones and Hunter)."),
        base::field("force_discrepancy_max", &Good::force_discrepancy_max, ratio_format,
                    "C. The just noticeable difference of force, 7 to 10 % (Pang, Tan and "
                    "Durlach)."),
        base::field("contact_lost_max", &Good::contact_lost_max, ratio_format,
                    "F. A working limit, from no source."),
        base::field("drag_max", &Good::drag_max_n, newton_format,
                    "I. A working limit, from no source."),
        base::field("discrepancy_max", &Good::discrepancy_max_m, vibration_format,
                    about_good_discrepancy),
        base::field("turned_apart_max", &Good::turned_apart_max_rad, turn_format,
                    about_turned_apart));
}

constexpr auto fields_of(base::Tag<Criteria>)
{
    return base::fields(
        "criteria",
        base::field("filter_order", &Criteria::filter_order, FilterOrderFormat{},
                    "Of the 20 Hz high-pass that vibration is judged by: 1, 2 or 4. The first\n"
                    "estimates used 1."),
        base::field("usable", &Criteria::usable), base::field("good", &Criteria::good));
}

/// Reads criteria. `source` names the text in errors, which give line and column. A missing key
/// gets its default.
[[nodiscard]] base::Result<Criteria> parse_criteria(std::string_view text,
                                                    const std::string& source);

/// Returns the criteria as TOML that reads back as the same criteria. Its comments say where each
/// number comes from.
[[nodiscard]] std::string print_criteria(const Criteria& criteria);

} // namespace hapnet::lab::metrics

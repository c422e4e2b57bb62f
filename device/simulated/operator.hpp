// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/reading.hpp"
#include "proto/base/result.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace hapnet::device {

/// A hand on a stylus as a linear impedance: m h'' + b h' + k (h - intention) = force. The mass
/// contains the device's apparent 45 g. Nominal values for a relaxed pen grip; measured arms:
/// 0.554 kg, 6.45 N s/m, 135 N/m (Scientific Reports 6:18004).
struct HandImpedance {
    double mass_kg = 0.20;
    double damping_ns_per_m = 5.0;
    double stiffness_n_per_m = 200.0;

    friend bool operator==(const HandImpedance&, const HandImpedance&) = default;
};

/// A simulated person at a device: how the hand yields and how its will wavers, reacts and lags.
/// Not a human being: a linear hand with scripted intentions.
struct Operator {
    std::string name = "nominal";
    HandImpedance hand{};

    friend bool operator==(const Operator&, const Operator&) = default;
};

/// "relaxed", "nominal", "firm"
[[nodiscard]] base::Result<Operator> operator_named(std::string_view name);

/// A preset's name, or a table with `preset = "nominal"` and what differs from it; nullopt when a
/// complaint was made.
[[nodiscard]] std::optional<Operator> read_operator(const base::Node& node, base::Reading& reading);

/// TOML that reads back as the same operator.
[[nodiscard]] std::string print_operator(const Operator& person);

} // namespace hapnet::device

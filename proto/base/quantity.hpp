// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/result.hpp"

#include <array>
#include <string>
#include <string_view>

namespace hapnet::base {

// Physical quantities in the notation for people: "40mm", "-9.81m/s2", "1e6N/m". They are kept in
// SI units as doubles. A text becomes the double nearest to its value, because the decimal point is
// shifted before the number is rounded: "22.5mm" is 0.0225.

/// A unit of a quantity. Its size is 10^exponent SI units, times `factor`.
struct PhysicalUnit {
    std::string_view name;
    int exponent = 0;
    double factor = 1.0;
    bool is_printed = false; // true if quantity_text() may use it
};

/// A kind of quantity, with its name and its units.
struct QuantityKind {
    std::string_view name;             // name with its article: "a length"
    std::string_view examples;         // "40mm, 0.5m or 500um"
    std::array<PhysicalUnit, 4> units; // those that are printed are sorted from the largest
};

inline constexpr QuantityKind length_kind{
    "a length",
    "40mm, 4cm, 0.5m or 500um",
    {{{"m", 0, 1.0, true}, {"mm", -3, 1.0, true}, {"um", -6, 1.0, true}, {"cm", -2}}}};
inline constexpr QuantityKind mass_kind{
    "a mass",
    "100g, 0.1kg or 50mg",
    {{{"kg", 0, 1.0, true}, {"g", -3, 1.0, true}, {"mg", -6, 1.0, true}}}};
inline constexpr QuantityKind density_kind{
    "a density", "1000kg/m3 or 1g/cm3", {{{"kg/m3", 0, 1.0, true}, {"g/cm3", 3}}}};
inline constexpr QuantityKind stiffness_kind{"a stiffness",
                                             "500N/m, 0.5N/mm or 1e6N/m",
                                             {{{"N/m", 0, 1.0, true}, {"N/mm", 3}, {"kN/m", 3}}}};
inline constexpr QuantityKind damping_kind{
    "a damping", "2Ns/m or 0.5Ns/m", {{{"Ns/m", 0, 1.0, true}, {"Ns/mm", 3}}}};
inline constexpr QuantityKind force_kind{
    "a force", "3.3N, 500mN or 1kN", {{{"N", 0, 1.0, true}, {"mN", -3}, {"kN", 3}}}};
inline constexpr QuantityKind force_rate_kind{
    "a change of force", "500N/s or 0.5N/ms", {{{"N/s", 0, 1.0, true}, {"N/ms", 3}}}};
inline constexpr QuantityKind speed_kind{
    "a velocity", "0.2m/s or 200mm/s", {{{"m/s", 0, 1.0, true}, {"mm/s", -3}, {"cm/s", -2}}}};
inline constexpr QuantityKind acceleration_kind{
    "an acceleration", "-9.81m/s2", {{{"m/s2", 0, 1.0, true}, {"m/s^2", 0}, {"mm/s2", -3}}}};

inline constexpr QuantityKind frequency_kind{
    "a frequency", "0.5Hz or 10Hz", {{{"Hz", 0, 1.0, true}, {"mHz", -3}, {"kHz", 3}}}};
inline constexpr QuantityKind mobility_kind{
    "a mobility", "10mm/Ns", {{{"m/Ns", 0, 1.0, true}, {"mm/Ns", -3, 1.0, true}}}};

inline constexpr QuantityKind power_kind{
    "a power", "0.5W or 500mW", {{{"W", 0, 1.0, true}, {"mW", -3}}}};
inline constexpr QuantityKind energy_kind{
    "an energy", "0.15J or 150mJ", {{{"J", 0, 1.0, true}, {"mJ", -3}}}};

inline constexpr double radians_per_degree = 0.017453292519943295769; // pi / 180
inline constexpr QuantityKind angle_kind{
    "an angle",
    "90deg or 1.5rad",
    {{{"rad", 0, 1.0, true}, {"deg", 0, radians_per_degree}, {"mrad", -3}}}};
inline constexpr QuantityKind torsion_kind{
    "a torsional stiffness", "0.5Nm/rad", {{{"Nm/rad", 0, 1.0, true}, {"mNm/rad", -3}}}};
inline constexpr QuantityKind torsion_damping_kind{
    "a torsional damping", "0.01Nms/rad", {{{"Nms/rad", 0, 1.0, true}, {"mNms/rad", -3}}}};
inline constexpr QuantityKind turn_kind{
    "an angular velocity",
    "1rad/s or 90deg/s",
    {{{"rad/s", 0, 1.0, true}, {"deg/s", 0, radians_per_degree}}}};

/// Returns the value in SI units. A sign and an exponent ("1e6N/m") are allowed. The unit is
/// required, except with a bare 0. The error says what to write.
[[nodiscard]] Result<double> parse_quantity(std::string_view text, const QuantityKind& kind);

/// True if the word is one of the units of this project's texts: "ms", "%", "Mbit/s", "mm".
[[nodiscard]] bool is_unit(std::string_view word);

/// Returns a finite value with the largest unit in which it is at least 1. Parsing the text gives
/// the same bits.
[[nodiscard]] std::string quantity_text(double value, const QuantityKind& kind);

} // namespace hapnet::base

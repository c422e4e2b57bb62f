// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/fate.hpp"
#include "proto/base/formats.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace hapnet::emulator {

// Formats of parameters that only the emulator has.

/// A time or a whole number of datagrams: "20ms", 5.
struct TimeOrCount {
    using Value = std::variant<base::Duration, std::uint32_t>;

    void read(const base::Node& node, Value& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const Value& value) const;
    [[nodiscard]] std::string describe() const { return "a time, or a number of datagrams"; }
};

struct DisplacementFormat {
    void read(const base::Node& node, Displacement& target, base::Reading& reading) const;
    [[nodiscard]] std::string print(const Displacement& value) const;
    [[nodiscard]] std::string describe() const { return TimeOrCount{}.describe(); }
};

/// Interpolates for ramps, between two numbers of places or between two times.
[[nodiscard]] std::optional<Displacement> between(const Displacement& a, const Displacement& b,
                                                  double progress);

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/metrics/criteria.hpp"
#include "lab/metrics/scores.hpp"
#include "proto/base/names.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::metrics {

enum class Tier : std::uint8_t { unusable, usable, good };
constexpr auto names_of(base::Tag<Tier>) { return base::names("unusable", "usable", "good"); }

/// "unusable", "usable", "good"
[[nodiscard]] std::string_view to_text(Tier tier);

struct Judgement {
    Tier tier = Tier::unusable;
    /// The reasons why it is not `usable`, e.g. "vibration 1.31 mm > 0.95 mm"; empty when usable.
    std::vector<std::string> failures;
    /// The metrics of `failures`, in the same order, e.g. "vibration".
    std::vector<std::string_view> failed;
    /// Further reasons why it is not `good`, e.g. "contact lost 12 % > 5 %".
    std::vector<std::string> shortcomings;
    /// The metrics of `shortcomings`, in the same order.
    std::vector<std::string_view> short_of;
};

/// Judges the metrics that the task exercised. The other metrics count as kept.
[[nodiscard]] Judgement judge(const Scores& scores, const Criteria& criteria);

} // namespace hapnet::lab::metrics

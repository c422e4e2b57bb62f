// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/core/trace.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab {

/// What a session is measured by, A to L. SI units. What a task does not exercise is nullopt.
/// As measured: what has to be taken relative to the unimpaired session is, in scores_of().
struct Metrics {};

[[nodiscard]] Metrics metrics_of(const Trace& trace);

/// Exact: metrics_from(to_json(m)) == m.
[[nodiscard]] nlohmann::ordered_json to_json(const Metrics& metrics);
[[nodiscard]] std::optional<Metrics> metrics_from(const nlohmann::json& json);

/// Metrics against those of the same session (task, algorithm, hands, seed) on a perfect network.
struct Scores {};

[[nodiscard]] Scores scores_of(const Metrics& impaired, const Metrics& perfect);

/// The two-tier convention; see criteria.toml for where each number comes from.
struct Criteria {};

enum class Tier : std::uint8_t { unusable, usable, good };
[[nodiscard]] std::string_view to_text(Tier tier);

struct Judgement {
    Tier tier = Tier::unusable;
    /// What keeps it from `usable`, e.g. "vibration 1.31 mm > 0.95 mm"; empty when usable.
    std::vector<std::string> failures;
};

[[nodiscard]] Judgement judge(const Scores& scores, const Criteria& criteria);

} // namespace hapnet::lab

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/experiment/search.hpp"
#include "lab/experiment/spec.hpp"
#include "lab/metrics/verdict.hpp"

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace hapnet::lab {

// An experiment in parts that do not depend on one another: on whatever thread and in whatever
// order they are carried out, each finds the same.

/// One session and its perfect twin.
struct SessionPart {
    std::size_t algorithm = 0; // of the experiment's
    device::Task task{};
    SessionSpec spec{};
};

/// One limit.
struct SearchPart {
    std::size_t algorithm = 0;
    device::Task task{};
    SearchRange range{};
};

/// The same limit by other conventions: for these hands, and each order of the filter.
struct ConventionPart {
    std::size_t algorithm = 0;
    device::Task task{};
    SearchRange range{};
    Hands hands{};
};

using Part = std::variant<SessionPart, SearchPart, ConventionPart>;

/// The parts of an experiment in the order of its results.
[[nodiscard]] std::vector<Part> parts_of(const Experiment& experiment);

struct SessionFinding {
    Metrics metrics{};
    Metrics perfect{};
    std::string rows{};
};

/// A session that a search played.
struct CurvePoint {
    Level level{};
    std::uint32_t seed = 1;
    Scores scores{};
    Tier tier{};
};

struct SearchFinding {
    Limit limit{};
    std::vector<CurvePoint> curve{}; // ascending in level, then seed
};

/// The limits by the filter orders of the convention, in their order.
struct ConventionFinding {
    std::vector<Limit> limits{};
};

using Finding = std::variant<SessionFinding, SearchFinding, ConventionFinding>;

/// Carries out one part, playing by `play` what it needs. An error of `play` is passed on.
[[nodiscard]] base::Result<Finding> carry_out(const Part& part, const Experiment& experiment,
                                              const Criteria& criteria, const PlaySession& play);

} // namespace hapnet::lab

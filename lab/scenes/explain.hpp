// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "scene/description.hpp"
#include "scene/requirements.hpp"
#include "scene/tick_cost.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hapnet::lab::scenes {

/// A tick that would cost less than the one chosen, and what it cannot do for the scene.
struct CheaperTick {
    scene::StepperKind profile = scene::StepperKind::flight;
    std::vector<scene::Feature> lacks;
};

/// The least and the greatest of the masses that can move.
struct MassRange {
    double least_kg = 0.0;
    double most_kg = 0.0;
};

/// What a scene is, what it needs of a tick and why, and which tick it therefore gets.
struct Explanation {
    std::string name;
    std::uint64_t hash = 0; // peers compare it
    std::size_t movable = 0;
    std::size_t fixed = 0;
    std::size_t planes = 0;
    scene::HandDescription hands;
    std::optional<MassRange> mass; // nullopt: nothing is movable
    base::Duration tick{};
    std::optional<double> hand_factor; // k dt^2 / m of a hand on the lightest body; nullopt: none
    scene::Requirements needs;
    scene::StepperKind profile = scene::StepperKind::flight;
    std::vector<CheaperTick> cheaper; // the cheapest first
    scene::TickCost bound;            // the most that a tick takes
};

/// `description` is one that scene::check() accepts; bodies at rest fall asleep when `sleeping`.
[[nodiscard]] Explanation explain(const scene::Description& description, base::Duration tick,
                                  bool sleeping);

/// An explanation for programs: units in the names, null where there is nothing to say.
[[nodiscard]] nlohmann::ordered_json to_json(const Explanation& explanation);

/// An explanation for people: lines of text.
[[nodiscard]] std::string to_table(const Explanation& explanation);

} // namespace hapnet::lab::scenes

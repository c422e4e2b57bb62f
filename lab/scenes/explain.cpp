// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/scenes/explain.hpp"

#include "proto/base/fields_json.hpp"
#include "proto/base/quantity.hpp"
#include "proto/base/text.hpp"
#include "scene/world.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::scenes {

namespace {

std::optional<MassRange> masses_of(const scene::Description& description)
{
    std::optional<MassRange> range;
    for (const scene::BodyDescription& body : description.bodies) {
        if (!body.movable) continue;
        if (!range) range = MassRange{body.mass_kg, body.mass_kg};
        range->least_kg = std::min(range->least_kg, body.mass_kg);
        range->most_kg = std::max(range->most_kg, body.mass_kg);
    }
    return range;
}

std::vector<CheaperTick> cheaper_than(scene::StepperKind chosen, const scene::Requirements& needs)
{
    std::vector<CheaperTick> cheaper;
    for (std::size_t i = 0; i < static_cast<std::size_t>(chosen); ++i) {
        CheaperTick tick{static_cast<scene::StepperKind>(i), {}};
        const scene::FeatureSet can = scene::abilities_of(tick.profile);
        for (const scene::Requirement& need : needs) {
            if (need.is_required && !can.has(need.feature))
                tick.lacks.push_back(name_of(need.feature));
        }
        cheaper.push_back(std::move(tick));
    }
    return cheaper;
}

std::string bodies_text(const Explanation& of)
{
    const auto text = [](double kg) { return base::quantity_text(kg, base::mass_kind); };
    std::string masses;
    if (of.mass && of.mass->least_kg < of.mass->most_kg) {
        masses = fmt::format(" ({} to {}, 1:{:.4g})", text(of.mass->least_kg),
                             text(of.mass->most_kg), of.mass->most_kg / of.mass->least_kg);
    } else if (of.mass) {
        masses = fmt::format(" ({})", text(of.mass->least_kg));
    }
    return fmt::format("movable {}{}; fixed {}; planes {}", of.movable, masses, of.fixed,
                       of.planes);
}

std::string hips_text(const scene::HandDescription& hips)
{
    if (hips.count == 0) return "none";
    const auto text = [](double value, const base::QuantityKind& kind) {
        return base::quantity_text(value, kind);
    };
    const bool is_limited = std::isfinite(hips.force_max_n);
    return fmt::format("{}, of radius {}: {} and {}, {}", hips.count,
                       text(hips.radius_m, base::length_kind),
                       text(hips.stiffness_n_per_m, base::stiffness_kind),
                       text(hips.damping_ns_per_m, base::damping_kind),
                       is_limited ? "at most " + text(hips.force_max_n, base::force_kind)
                                  : std::string{"not limited"});
}

/// Returns a bound as a text without the parts that are zero.
std::string bound_text(const TickBound& bound)
{
    std::vector<std::string> parts;
    const auto add = [&](const auto& field, std::uint64_t count) {
        if (count > 0) parts.push_back(fmt::format("{} {}", count, *field.telling.words));
    };
    base::for_each_field(add, bound);
    if (parts.empty()) return "\nA tick moves each body once; nothing else can happen.\n";
    return fmt::format("\nA tick takes at most:\n  {}\n", fmt::join(parts, "\n  "));
}

} // namespace

Explanation explain(const scene::Description& description, base::Duration tick, bool sleeping)
{
    Explanation explanation;
    explanation.name = description.name;
    explanation.hash = scene::hash(description);
    explanation.movable = static_cast<std::size_t>(
        std::count_if(description.bodies.begin(), description.bodies.end(),
                      [](const scene::BodyDescription& body) { return body.movable; }));
    explanation.fixed = description.bodies.size() - explanation.movable;
    explanation.planes = description.planes.size();
    explanation.hands = description.hands;
    explanation.mass = masses_of(description);
    explanation.tick = tick;
    if (explanation.mass && description.hands.count > 0) {
        const double dt = base::to_seconds(tick);
        explanation.hand_factor =
            description.hands.stiffness_n_per_m * dt * dt / explanation.mass->least_kg;
    }
    explanation.needs = scene::requirements_of(description, sleeping);
    explanation.profile = scene::cheapest_stepper(scene::required_features(explanation.needs));
    if (const auto world =
            scene::World::freeze(description, {.tick = tick, .sleeping = sleeping})) {
        explanation.bound = {world->tick_cost_bound()};
    }
    explanation.cheaper = cheaper_than(explanation.profile, explanation.needs);
    return explanation;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

nlohmann::ordered_json to_json(const Explanation& explanation)
{
    return base::json_of(explanation);
}

std::string to_table(const Explanation& explanation)
{
    std::string text = fmt::format("scene   {}, hash {}\n",
                                   explanation.name.empty() ? "without a name" : explanation.name,
                                   hash_text(explanation.hash));
    text += fmt::format("bodies  {}\n", bodies_text(explanation));
    text += fmt::format("hands   {}\n", hips_text(explanation.hands));
    text += fmt::format("tick    {}", base::to_text(explanation.tick));
    if (explanation.hand_factor) {
        text += fmt::format("; k dt^2/m of a hand on the lightest body: {:.3g}",
                            *explanation.hand_factor);
    }
    text += "\n\nWhat the scene needs of a tick, and why:\n";
    for (const scene::Requirement& need : explanation.needs) {
        text += fmt::format("  {:<11}  {:<3}  {}\n", scene::name_of(need.feature),
                            need.is_required ? "on" : "off", need.because);
    }
    text += fmt::format("\nIts stepper: {}\n", scene::name_of(explanation.profile));
    for (const CheaperTick& tick : explanation.cheaper) {
        text += fmt::format("  cheaper: {:<15}  has no {}\n", scene::name_of(tick.profile),
                            fmt::join(tick.lacks, ", "));
    }
    return text + bound_text(explanation.bound);
}

} // namespace hapnet::lab::scenes

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/describe.hpp"
#include "proto/base/time.hpp"
#include "proto/base/value_kind.hpp"
#include "scene/description.hpp"
#include "scene/requirements.hpp"
#include "scene/tick_cost.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::scenes {

/// A feature that a tick may have to support, and the reason why the scene needs it or not.
struct FeatureReport {
    scene::Requirement of;
};
constexpr auto fields_of(base::Tag<FeatureReport>)
{
    using F = FeatureReport;
    return base::fields("feature",
                        base::computed<F>(
                            "feature", [](const F& one) { return name_of(one.of.feature); },
                            "What a tick may have to do."),
                        base::computed<F>(
                            "needed", [](const F& one) { return one.of.is_required; },
                            "Whether the scene needs it."),
                        base::computed<F>(
                            "because", [](const F& one) -> const auto& { return one.of.because; },
                            "Why, or why not."));
}

/// The greatest cost of a tick.
struct TickBound : scene::TickCost {};
constexpr auto fields_of(base::Tag<TickBound>)
{
    using B = TickBound;
    return base::fields(
        "bound", base::member("pairs", &B::pairs).told("pairs examined"),
        base::member("contacts", &B::contacts).told("contacts prepared"),
        base::member("visits", &B::visits).told("visits of the solver to a contact"),
        base::member("spring_rows", &B::spring_rows).told("rows of hands' springs solved"),
        base::member("events", &B::events).told("events"),
        base::member("looks", &B::looks).told("looks at bodies that go far"));
}

/// A tick that would cost less than the chosen one, and the features that it lacks for the scene.
struct CheaperTick {
    scene::StepperKind profile = scene::StepperKind::flight;
    std::vector<std::string_view> lacks; // names of the missing features
};
constexpr auto fields_of(base::Tag<CheaperTick>)
{
    using C = CheaperTick;
    return base::fields(
        "cheaper",
        base::computed<C>(
            "profile", [](const C& tick) { return name_of(tick.profile); }, "A cheaper stepper."),
        base::member("lacks", &C::lacks, "The features that it does not have."));
}

/// The least and the greatest mass of the movable bodies.
struct MassRange {
    double least_kg = 0.0;
    double most_kg = 0.0;
};
constexpr auto fields_of(base::Tag<MassRange>)
{
    return base::fields("masses", base::member("min", &MassRange::least_kg),
                        base::member("max", &MassRange::most_kg));
}

/// The hands of a scene.
struct HandsReport {
    const scene::HandDescription* of = nullptr;
};
constexpr auto fields_of(base::Tag<HandsReport>)
{
    using H = HandsReport;
    return base::fields(
        "hips",
        base::computed<H>(
            "count", [](const H& hands) { return hands.of->count; }, "How many it takes at most."),
        base::computed<H>("radius_m", [](const H& hands) { return hands.of->radius_m; }),
        base::computed<H>("stiffness_n_per_m",
                          [](const H& hands) { return hands.of->stiffness_n_per_m; }),
        base::computed<H>("damping_ns_per_m",
                          [](const H& hands) { return hands.of->damping_ns_per_m; }),
        base::computed<H>(
            "force_max_n", [](const H& hands) { return hands.of->force_max_n; },
            "Of one contact; null: not limited."));
}

/// Returns the hash in the form in which peers and pages print it.
[[nodiscard]] std::string hash_text(std::uint64_t hash);

/// A scene's properties, the features that it needs of a tick with the reasons, and the chosen
/// tick.
struct Explanation {
    std::string name;
    std::uint64_t hash = 0; // hash of the scene, which peers compare
    std::size_t movable = 0;
    std::size_t fixed = 0;
    std::size_t planes = 0;
    scene::HandDescription hands;
    std::optional<MassRange> mass; // nullopt: no body is movable
    base::Duration tick{};
    std::optional<double> hand_factor; // k dt^2 / m of a hand on the lightest body; nullopt: none
    scene::Requirements needs;
    scene::StepperKind profile = scene::StepperKind::flight;
    std::vector<CheaperTick> cheaper; // cheapest first
    TickBound bound;
};

constexpr auto fields_of(base::Tag<Explanation>)
{
    using E = Explanation;
    return base::fields(
        "explanation", base::member("scene", &E::name, "The name of the scene."),
        base::computed<E>(
            "hash", [](const E& one) { return hash_text(one.hash); }, "Peers compare it."),
        base::member("movable", &E::movable, "Bodies that can move."),
        base::member("fixed", &E::fixed, "Bodies that cannot."),
        base::member("planes", &E::planes, "Planes."),
        base::member("mass_kg", &E::mass,
                     "The least and the greatest mass that can move; null: nothing can."),
        base::computed<E>(
            "hips", [](const E& one) { return HandsReport{&one.hands}; }, "Hands."),
        base::member("tick_s", &E::tick, "The length of a tick."),
        base::member("hand_k_dt2_over_m", &E::hand_factor,
                     "k dt^2 / m of a hand on the lightest body; null: nothing can move, or no "
                     "hand is there."),
        base::computed<E>(
            "features",
            [](const E& one) {
                std::vector<FeatureReport> needs;
                for (const scene::Requirement& need : one.needs) needs.push_back({need});
                return needs;
            },
            "What the scene needs of a tick, and why."),
        base::computed<E>(
            "profile", [](const E& one) { return name_of(one.profile); }, "Its stepper."),
        base::member("cheaper", &E::cheaper, "Cheaper steppers, the cheapest first."),
        base::member("tick_bound", &E::bound, "The most that a tick takes."));
}

/// Explains a scene. scene::check() must accept `description`. Bodies at rest fall asleep if
/// `sleeping`.
[[nodiscard]] Explanation explain(const scene::Description& description, base::Duration tick,
                                  bool sleeping);

/// Returns an explanation for programs: units are in the names; null stands for a missing value.
[[nodiscard]] nlohmann::ordered_json to_json(const Explanation& explanation);

/// Returns an explanation for people: lines of text.
[[nodiscard]] std::string to_table(const Explanation& explanation);

} // namespace hapnet::lab::scenes

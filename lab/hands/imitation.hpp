// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "lab/hands/import.hpp"
#include "lab/hands/manifest.hpp"
#include "lab/hands/motion_figures.hpp"
#include "lab/hands/motion_model.hpp"
#include "lab/hands/population.hpp"
#include "proto/base/describe.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hapnet::lab::hands {

// Simulated hands that move as recorded people do. For each subject, models are fitted to a part of
// its trials. New trials are drawn from them, and their figures are compared with those of the
// trials that no fit saw. docs/formats/hands.md describes fit.json.

/// The models of a subject.
struct SubjectModels {
    std::string subject;
    MotionModel middle;
    std::optional<MotionModel> apart;
};
constexpr auto fields_of(base::Tag<SubjectModels>)
{
    using S = SubjectModels;
    return base::fields(
        "subject models", base::member("subject", &S::subject, "Who moved."),
        base::member("middle", &S::middle,
                     "Motion of the middle between the two hands; of a single hand, its own."),
        base::member("apart", &S::apart, "Motion of A as seen from B; null: there is no B."));
}

/// The fewest unseen trials whose range judges a figure.
inline constexpr std::uint64_t judging_trials_min = 3;

/// A figure of recorded and of simulated motion: means over subjects.
struct ComparedFigure {
    std::string motion;
    std::string figure;
    double seen = 0.0;
    double unseen = 0.0;
    double unseen_min = 0.0;
    double unseen_max = 0.0;
    double simulated = 0.0;

    /// True if the simulated mean is among the values of the unseen trials.
    [[nodiscard]] bool is_inside() const
    {
        return simulated >= unseen_min && simulated <= unseen_max;
    }
};
constexpr auto fields_of(base::Tag<ComparedFigure>)
{
    using C = ComparedFigure;
    return base::fields(
        "compared figure",
        base::member("motion", &C::motion,
                     "`middle`, `apart`, or `both` for what concerns both hands."),
        base::member("figure", &C::figure, "Which figure."),
        base::member("seen", &C::seen,
                     "Mean over the subjects of the trials to which the models were fitted.")
            .rounded(4),
        base::member("unseen", &C::unseen, "Mean over the subjects of the trials that no fit saw.")
            .rounded(4),
        base::member("unseen_min", &C::unseen_min, "Least value of an unseen trial.").rounded(4),
        base::member("unseen_max", &C::unseen_max, "Largest value of an unseen trial.").rounded(4),
        base::member("simulated", &C::simulated, "Mean over the subjects of the simulated trials.")
            .rounded(4));
}

/// The contents of fit.json.
struct Imitation {
    std::string kind{"fitted-hands"};
    std::uint64_t version = 1;
    std::uint64_t seed = 1;
    std::uint64_t seen_trials = 0;
    std::uint64_t unseen_trials = 0;
    std::uint64_t simulated_trials = 0;
    std::vector<SubjectModels> subjects;
    std::vector<ComparedFigure> figures;
};
constexpr auto fields_of(base::Tag<Imitation>)
{
    using I = Imitation;
    return base::fields(
        "fitted hands", base::member("kind", &I::kind, "`fitted-hands`"),
        base::member("version", &I::version, "Version of this format: 1."),
        base::member("seed", &I::seed, "Seed of the simulated trials."),
        base::member("seen_trials", &I::seen_trials, "Trials to which the models were fitted."),
        base::member("unseen_trials", &I::unseen_trials, "Trials that no fit saw."),
        base::member("simulated_trials", &I::simulated_trials, "Trials drawn from the models."),
        base::member("subjects", &I::subjects, "Models of each subject with a seen trial."),
        base::member("figures", &I::figures, "How the three kinds of trials compare."));
}

/// The trials that no fit sees: each second one of every subject, or all of some subjects.
struct Unseen {
    std::vector<std::string> subjects; // empty: each second trial
};

/// Reads "half", or names of subjects with commas between them.
[[nodiscard]] base::Result<Unseen> parse_unseen(std::string_view text);

struct ImitationRules {
    Unseen unseen{};
    std::optional<std::uint32_t> trials{}; // for each subject; nullopt: as many as were recorded
    std::uint64_t seed = 1;
    /// Called with each subject before its models are fitted.
    std::function<void(const std::string& subject)> on_subject{};
};

/// The result of an imitation: what a folder of it has.
struct Imitated {
    Imitation imitation;
    Manifest seen;
    Manifest unseen;
    Manifest simulated;
    std::vector<TextFile> scripts; // of the simulated trials
};

/// Fits models to recorded hands and draws trials from them. `population` has the trials of the
/// manifest, in its order. A simulated trial is as long as one of the subject's seen trials, has
/// their smoothing and is fitted into the scene as they were. If it has to be scaled down for that,
/// it is drawn again, up to 20 times. Errors say why nothing can be fitted or judged.
[[nodiscard]] base::Result<Imitated> imitate(const Manifest& manifest, const Population& population,
                                             const ImitationRules& rules);

/// Returns the comparison as a table, in lines for a person.
[[nodiscard]] std::string told(const Imitation& imitation);

/// Returns the contents of fit.json.
[[nodiscard]] std::string to_text(const Imitation& imitation);

} // namespace hapnet::lab::hands

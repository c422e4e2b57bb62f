// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/imitation.hpp"

#include "proto/base/fields_json.hpp"
#include "proto/base/lines.hpp"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::hands {

namespace {

/// The motions of a trial whose figures are compared.
struct Views {
    Places middle;
    std::optional<Places> apart;
};

Motion motion_of(const device::HandTrace& trace)
{
    Motion motion;
    for (const device::HandMoment& moment : trace) motion.push_back(moment.hip.value);
    return motion;
}

Views views_of(const Trial& trial)
{
    Places a = sampled(motion_of(*trial.ways[0]));
    if (!trial.ways[1]) return {std::move(a), std::nullopt};
    const Places b = sampled(motion_of(*trial.ways[1]));
    Places middle, apart;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        middle.push_back(0.5 * (a[i] + b[i]));
        apart.push_back(a[i] - b[i]);
    }
    return {std::move(middle), std::move(apart)};
}

/// A recorded trial: its row of the manifest, and its motion.
struct Recorded {
    const ImportedTrial* imported;
    const Trial* trial;
};

struct Split {
    std::vector<Recorded> seen;
    std::vector<Recorded> unseen;
};

base::Result<Split> split_trials(const Manifest& manifest, const Population& population,
                                 const Unseen& unseen)
{
    Split parts;
    std::map<std::string_view, std::size_t> counts;
    std::set<std::string_view> known;
    for (std::size_t i = 0; i < manifest.trials.size(); ++i) {
        const Recorded recorded{&manifest.trials[i], &population.trials[i]};
        const std::string& subject = recorded.imported->subject;
        known.insert(subject);
        const bool is_second = counts[subject]++ % 2 == 1;
        const bool is_named = std::ranges::find(unseen.subjects, subject) != unseen.subjects.end();
        const bool is_unseen = unseen.subjects.empty() ? is_second : is_named;
        (is_unseen ? parts.unseen : parts.seen).push_back(recorded);
    }
    for (const std::string& subject : unseen.subjects) {
        if (known.contains(subject)) continue;
        return base::fail(fmt::format("--unseen {}: the folder has no such subject: its subjects "
                                      "are {}",
                                      subject, fmt::join(known, ", ")));
    }
    if (parts.seen.empty())
        return base::fail("no trial is left to fit a hand to: name fewer subjects for --unseen");
    if (parts.unseen.empty()) {
        return base::fail("no trial is left to judge the fitted hands by: every subject has a "
                          "single one; import more, or keep subjects back by --unseen NAME");
    }
    return parts;
}

/// The seen trials of a subject.
struct Seen {
    std::vector<Recorded> trials;
    std::vector<Places> middles;
    std::vector<Places> aparts;
};

/// Returns the seen trials of each subject, in the order of their first trials.
base::Result<std::vector<std::pair<std::string, Seen>>>
by_subject(const std::vector<Recorded>& seen)
{
    std::vector<std::pair<std::string, Seen>> subjects;
    for (const Recorded& recorded : seen) {
        const std::string& name = recorded.imported->subject;
        auto subject = std::ranges::find(subjects, name, &std::pair<std::string, Seen>::first);
        if (subject == subjects.end()) subject = subjects.insert(subjects.end(), {name, Seen{}});
        Seen& of = subject->second;
        if (!of.trials.empty() &&
            of.trials[0].imported->b.has_value() != recorded.imported->b.has_value()) {
            return base::fail(fmt::format("subject {} has trials of one hand and of two: import "
                                          "them as two subjects",
                                          name));
        }
        of.trials.push_back(recorded);
        Views views = views_of(*recorded.trial);
        of.middles.push_back(std::move(views.middle));
        if (views.apart) of.aparts.push_back(*std::move(views.apart));
    }
    return subjects;
}

Motion simulated_motion(const MotionModel& model, std::size_t count,
                        const base::RandomStream& seeds, std::uint32_t draw)
{
    return simulated(model, count, motion_rate_hz, base::Seed{seeds.bits(0, draw)});
}

/// Draws a trial of a subject from its models, as long as a seen one.
base::Result<Imported> drawn_trial(const SubjectModels& models, const Recorded& like,
                                   std::uint32_t number, std::uint64_t seed)
{
    constexpr double apart_m = 1.0; // puts B to the right of A; fit() moves both where they belong
    const auto name = fmt::format("{}", number);
    const auto seeds = base::Seed{seed}.stream(fmt::format("hands/{}/{}", models.subject, name));
    const std::size_t count = like.trial->ways[0]->size();
    std::vector<Motion> motions{simulated_motion(models.middle, count, seeds, 0)};
    ImportedTrial trial = *like.imported;
    trial.trial = name;
    trial.rate_hz = motion_rate_hz;
    trial.from_s = 0.0;
    trial.a = ImportedHand{};
    trial.a.source = "fit.json";
    if (models.apart) {
        trial.b = trial.a;
        const Motion apart = simulated_motion(*models.apart, count, seeds, 1);
        motions.push_back(motions[0]);
        for (std::size_t i = 0; i < count; ++i) {
            motions[0][i] += 0.5 * apart[i] - glm::dvec3{apart_m, 0.0, 0.0};
            motions[1][i] += glm::dvec3{apart_m, 0.0, 0.0} - 0.5 * apart[i];
        }
    }
    for (Motion& motion : motions) smooth(motion, trial.smooth_hz);
    return fitted_trial(std::move(trial), std::move(motions),
                        {.press_m = 1e-3 * like.imported->press_mm,
                         .speed_max_m_per_s = 1e-3 * like.imported->speed_limit_mm_s});
}

/// The figures of trials, in the order in which they are described.
class Figures {
public:
    /// A figure, and its value in each trial.
    struct Row {
        std::string motion;
        std::string figure;
        std::vector<double> values;
    };

    void add(const Trial& trial, double touching_share)
    {
        const Views views = views_of(trial);
        add("middle", figures_of(views.middle));
        if (views.apart) add("apart", figures_of(*views.apart));
        add("both", "touching_share", touching_share);
    }

    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

    /// Returns the row of the same figure; nullptr if there is none.
    [[nodiscard]] const Row* find(const std::string& motion, const std::string& figure) const
    {
        const auto row = std::ranges::find_if(
            rows_, [&](const Row& one) { return one.motion == motion && one.figure == figure; });
        return row == rows_.end() ? nullptr : &*row;
    }

private:
    void add(const std::string& motion, const std::string& figure, double value)
    {
        if (find(motion, figure) == nullptr) rows_.push_back({motion, figure, {}});
        for (Row& row : rows_)
            if (row.motion == motion && row.figure == figure) row.values.push_back(value);
    }
    void add(const std::string& motion, const MotionFigures& figures)
    {
        const auto json = base::json_of(figures);
        for (const auto& [name, value] : json.items()) add(motion, name, value.get<double>());
    }

    std::vector<Row> rows_;
};

Figures figures_of_all(const std::vector<Recorded>& trials)
{
    Figures figures;
    for (const Recorded& recorded : trials)
        figures.add(*recorded.trial, recorded.imported->touching_share);
    return figures;
}

double mean_of(const std::vector<double>& values)
{
    double sum = 0.0;
    for (const double value : values) sum += value;
    return sum / static_cast<double>(values.size());
}

std::vector<ComparedFigure> compared(const Figures& seen, const Figures& unseen,
                                     const Figures& simulated)
{
    std::vector<ComparedFigure> rows;
    for (const Figures::Row& row : seen.rows()) {
        const auto* judged = unseen.find(row.motion, row.figure);
        const auto* drawn = simulated.find(row.motion, row.figure);
        if (judged == nullptr || drawn == nullptr) continue;
        rows.push_back({.motion = row.motion,
                        .figure = row.figure,
                        .seen = mean_of(row.values),
                        .unseen = mean_of(judged->values),
                        .unseen_min = *std::ranges::min_element(judged->values),
                        .unseen_max = *std::ranges::max_element(judged->values),
                        .simulated = mean_of(drawn->values)});
    }
    return rows;
}

std::string trials_of_subjects(const Imitation& imitation)
{
    const auto counted = [](std::size_t count, std::string_view noun) {
        return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
    };
    return counted(imitation.seen_trials, "trial") + " of " +
           counted(imitation.subjects.size(), "subject");
}

/// Returns the trial that imported scripts make.
base::Result<Trial> trial_of(const Imported& imported)
{
    Trial trial{imported.trial.subject, imported.trial.trial, {}};
    for (std::size_t i = 0; i < imported.scripts.size(); ++i) {
        auto way = device::parse_hand_trace(imported.scripts[i].text, imported.scripts[i].name);
        if (!way) return tl::unexpected{way.error()};
        trial.ways.at(i) = std::make_shared<const device::HandTrace>(*std::move(way));
    }
    return trial;
}

} // namespace

base::Result<Unseen> parse_unseen(std::string_view text)
{
    Unseen unseen;
    if (text == "half") return unseen;
    while (!text.empty()) {
        const auto comma = std::min(text.find(','), text.size());
        const auto name = base::trimmed(text.substr(0, comma));
        if (!is_plain_name(name)) {
            return base::fail(fmt::format("'{}' names no subject: write half, or names of subjects "
                                          "with commas between them",
                                          base::shortened(name)));
        }
        unseen.subjects.emplace_back(name);
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    if (unseen.subjects.empty())
        return base::fail("write half, or names of subjects with commas between them");
    return unseen;
}

base::Result<Imitated> imitate(const Manifest& manifest, const Population& population,
                               const ImitationRules& rules)
{
    const auto parts = split_trials(manifest, population, rules.unseen);
    if (!parts) return tl::unexpected{parts.error()};
    const auto subjects = by_subject(parts->seen);
    if (!subjects) return tl::unexpected{subjects.error()};
    Imitated imitated;
    Imitation& imitation = imitated.imitation;
    imitation.seed = rules.seed;
    Figures simulated;
    for (const auto& [name, seen] : *subjects) {
        if (rules.on_subject) rules.on_subject(name);
        SubjectModels models{name, fitted_model(seen.middles), std::nullopt};
        if (!seen.aparts.empty()) models.apart = fitted_model(seen.aparts);
        const auto recorded = static_cast<std::uint32_t>(
            std::ranges::count(manifest.trials, name, &ImportedTrial::subject));
        for (std::uint32_t i = 0; i < rules.trials.value_or(recorded); ++i) {
            const Recorded& like = seen.trials[i % seen.trials.size()];
            auto drawn = drawn_trial(models, like, i + 1, rules.seed);
            if (!drawn) return tl::unexpected{drawn.error()};
            const auto trial = trial_of(*drawn);
            if (!trial) return tl::unexpected{trial.error()};
            simulated.add(*trial, drawn->trial.touching_share);
            put(imitated.simulated, std::move(drawn->trial));
            std::ranges::move(drawn->scripts, std::back_inserter(imitated.scripts));
        }
        imitation.subjects.push_back(std::move(models));
    }
    for (const Recorded& recorded : parts->seen) put(imitated.seen, *recorded.imported);
    for (const Recorded& recorded : parts->unseen) put(imitated.unseen, *recorded.imported);
    imitation.seen_trials = parts->seen.size();
    imitation.unseen_trials = parts->unseen.size();
    imitation.simulated_trials = imitated.simulated.trials.size();
    imitation.figures =
        compared(figures_of_all(parts->seen), figures_of_all(parts->unseen), simulated);
    return imitated;
}

std::string told(const Imitation& imitation)
{
    auto text = fmt::format("fitted to {}; judged by {} other{}\n", trials_of_subjects(imitation),
                            imitation.unseen_trials, imitation.unseen_trials == 1 ? "" : "s");
    text += fmt::format("{:24}{:>10}{:>10}{:>21}{:>11}\n", "", "seen", "unseen",
                        "(least to largest)", "simulated");
    std::size_t inside = 0;
    for (const ComparedFigure& row : imitation.figures) {
        inside += row.is_inside() ? 1U : 0U;
        const auto range = fmt::format("({:.4g} to {:.4g})", row.unseen_min, row.unseen_max);
        text += fmt::format("{:24}{:>10.4g}{:>10.4g}{:>21}{:>11.4g}{}\n",
                            row.motion + ' ' + row.figure, row.seen, row.unseen, range,
                            row.simulated, row.is_inside() ? "" : "  outside");
    }
    text += fmt::format("{} of {} simulated means are among the values of the unseen trials\n",
                        inside, imitation.figures.size());
    return text;
}

std::string to_text(const Imitation& imitation) { return base::json_of(imitation).dump(2) + '\n'; }

} // namespace hapnet::lab::hands

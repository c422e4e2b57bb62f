// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/hands/imitation.hpp"

#include "lab/metrics/subjects.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/lines.hpp"

#include <algorithm>
#include <cmath>
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

/// Reports what import hands does not write, and what cannot be compared with the first trial.
base::Result<void> check(const Recorded& recorded, const ImportedTrial& first)
{
    constexpr double tick_s = 1.0 / motion_rate_hz;
    const ImportedTrial& imported = *recorded.imported;
    const auto fail = [&](const std::string& why) {
        return base::fail(
            fmt::format("trial {} of subject {}: {}", imported.trial, imported.subject, why));
    };
    for (const auto& way : recorded.trial->ways) {
        if (!way) continue;
        const double end_s = way->back().time_s - way->front().time_s;
        const auto ticks = static_cast<double>(way->size() - 1);
        if (std::abs(end_s - ticks * tick_s) > tick_s)
            return fail("its script does not have a row for each millisecond");
        if (end_s < 1.0) return fail(fmt::format("its script lasts {:g} s, less than 1 s", end_s));
    }
    const auto& [a, b] = recorded.trial->ways;
    if (b && a->size() != b->size()) return fail("its two scripts are not equally long");
    if (imported.b.has_value() != first.b.has_value())
        return fail("some trials are of one hand and some of two: import them into two folders");
    const bool is_sane = imported.smooth_hz >= 0.5 && imported.smooth_hz <= 50.0 &&
                         imported.speed_limit_mm_s >= 1.0 && imported.speed_limit_mm_s <= 1e5 &&
                         std::abs(imported.press_mm) <= 20.0 && imported.touching_share >= 0.0 &&
                         imported.touching_share <= 1.0;
    if (is_sane) return {};
    return fail("smooth_hz, speed_limit_mm_s, press_mm or touching_share is out of the range of "
                "import hands");
}

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
std::vector<std::pair<std::string, Seen>> by_subject(const std::vector<Recorded>& seen)
{
    std::vector<std::pair<std::string, Seen>> subjects;
    for (const Recorded& recorded : seen) {
        const std::string& name = recorded.imported->subject;
        auto subject = std::ranges::find(subjects, name, &std::pair<std::string, Seen>::first);
        if (subject == subjects.end()) subject = subjects.insert(subjects.end(), {name, Seen{}});
        Seen& of = subject->second;
        of.trials.push_back(recorded);
        Views views = views_of(*recorded.trial);
        of.middles.push_back(std::move(views.middle));
        if (views.apart) of.aparts.push_back(*std::move(views.apart));
    }
    return subjects;
}

/// Draws a trial of a subject from its models, as long as a seen one, and fits it into the scene.
base::Result<Imported> drawn_once(const SubjectModels& models, const Recorded& like,
                                  const std::string& name, const base::RandomStream& seeds,
                                  std::uint32_t attempt)
{
    constexpr double apart_m = 1.0; // puts B to the right of A; fit() moves both where they belong
    const auto drawn = [&](const MotionModel& model, std::uint32_t draw) {
        return simulated(model, like.trial->ways[0]->size(), motion_rate_hz,
                         base::Seed{seeds.bits(attempt, draw)});
    };
    std::vector<Motion> motions{drawn(models.middle, 0)};
    ImportedTrial trial = *like.imported;
    trial.trial = name;
    trial.rate_hz = motion_rate_hz;
    trial.from_s = 0.0;
    trial.a = ImportedHand{};
    trial.a.source = "fit.json";
    if (models.apart) {
        trial.b = trial.a;
        const Motion apart = drawn(*models.apart, 1);
        motions.push_back(motions[0]);
        for (std::size_t i = 0; i < apart.size(); ++i) {
            motions[0][i] += 0.5 * apart[i] - glm::dvec3{apart_m, 0.0, 0.0};
            motions[1][i] += glm::dvec3{apart_m, 0.0, 0.0} - 0.5 * apart[i];
        }
    }
    for (Motion& motion : motions) smooth(motion, trial.smooth_hz);
    return fitted_trial(std::move(trial), std::move(motions),
                        {.press_m = 1e-3 * like.imported->press_mm,
                         .speed_max_m_per_s = 1e-3 * like.imported->speed_limit_mm_s});
}

/// Draws a trial that keeps its size in the scene. After some attempts in vain, returns the one
/// that is scaled the least.
base::Result<Imported> drawn_trial(const SubjectModels& models, const Recorded& like,
                                   std::uint32_t number, std::uint64_t seed)
{
    constexpr std::uint32_t attempts = 20;
    const auto name = fmt::format("{}", number);
    const auto seeds = base::Seed{seed}.stream(fmt::format("hands/{}/{}", models.subject, name));
    auto best = drawn_once(models, like, name, seeds, 0);
    for (std::uint32_t i = 1; i < attempts && best && best->trial.scale < 1.0; ++i) {
        auto other = drawn_once(models, like, name, seeds, i);
        if (!other || other->trial.scale > best->trial.scale) best = std::move(other);
    }
    return best;
}

/// The figures of trials, in the order in which they are described.
class Figures {
public:
    /// A figure: its value in each trial, and the means of the subjects.
    struct Row {
        std::string motion;
        std::string figure;
        std::vector<double> values{};
        metrics::SubjectMeans subjects{};
    };

    void add(const Trial& trial, double touching_share)
    {
        const Views views = views_of(trial);
        add("middle", figures_of(views.middle), trial.subject);
        if (views.apart) add("apart", figures_of(*views.apart), trial.subject);
        add("both", "touching_share", touching_share, trial.subject);
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
    void add(const std::string& motion, const std::string& figure, double value,
             const std::string& subject)
    {
        if (find(motion, figure) == nullptr) rows_.push_back({motion, figure});
        for (Row& row : rows_) {
            if (row.motion != motion || row.figure != figure) continue;
            row.values.push_back(value);
            row.subjects.add(subject, value);
        }
    }
    void add(const std::string& motion, const MotionFigures& figures, const std::string& subject)
    {
        const auto json = base::json_of(figures);
        for (const auto& [name, value] : json.items())
            add(motion, name, value.get<double>(), subject);
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

/// Returns the mean between subjects: each counts once.
double mean_of(const Figures::Row& row)
{
    double sum = 0.0;
    for (const double value : row.subjects.means()) sum += value;
    return sum / static_cast<double>(row.subjects.count());
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
                        .seen = mean_of(row),
                        .unseen = mean_of(*judged),
                        .unseen_min = *std::ranges::min_element(judged->values),
                        .unseen_max = *std::ranges::max_element(judged->values),
                        .simulated = mean_of(*drawn)});
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
    for (std::size_t i = 0; i < manifest.trials.size(); ++i) {
        auto fine = check({&manifest.trials[i], &population.trials[i]}, manifest.trials[0]);
        if (!fine) return tl::unexpected{fine.error()};
    }
    const auto parts = split_trials(manifest, population, rules.unseen);
    if (!parts) return tl::unexpected{parts.error()};
    const auto subjects = by_subject(parts->seen);
    Imitated imitated;
    Imitation& imitation = imitated.imitation;
    imitation.seed = rules.seed;
    Figures simulated;
    for (const auto& [name, seen] : subjects) {
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
    const bool is_judged = imitation.unseen_trials >= judging_trials_min;
    std::size_t inside = 0;
    for (const ComparedFigure& row : imitation.figures) {
        inside += row.is_inside() ? 1U : 0U;
        const auto range = fmt::format("({:.4g} to {:.4g})", row.unseen_min, row.unseen_max);
        text += fmt::format("{:24}{:>10.4g}{:>10.4g}{:>21}{:>11.4g}{}\n",
                            row.motion + ' ' + row.figure, row.seen, row.unseen, range,
                            row.simulated, row.is_inside() || !is_judged ? "" : "  outside");
    }
    if (!is_judged)
        return text + fmt::format("fewer than {} unseen trials: no figure is judged\n",
                                  judging_trials_min);
    text += fmt::format("{} of {} simulated means are among the values of the unseen trials; the "
                        "model misses what is outside\n",
                        inside, imitation.figures.size());
    return text;
}

std::string to_text(const Imitation& imitation) { return base::json_of(imitation).dump(2) + '\n'; }

} // namespace hapnet::lab::hands

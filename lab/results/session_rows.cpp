// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/session_rows.hpp"

#include "lab/metrics/subjects.hpp"

#include <algorithm>
#include <map>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>

namespace hapnet::lab::results {

namespace {

std::optional<double> constant_ms(const emulator::Variation& delay)
{
    const auto* law = std::get_if<emulator::ConstantLaw>(&delay.law);
    if (law == nullptr) return std::nullopt;
    return 1e3 * base::to_seconds(law->value);
}

/// Returns the half width of a uniform jitter whose datagrams overtake one another; 0 without
/// jitter.
std::optional<double> jitter_ms(const emulator::Conditions& conditions)
{
    if (is_nothing(conditions.jitter)) return 0.0;
    const auto* law = std::get_if<emulator::UniformLaw>(&conditions.jitter.law);
    const bool is_plain = law != nullptr && conditions.order == emulator::Order::free &&
                          conditions.jitter == emulator::uniform(law->half_width);
    return is_plain ? std::optional{1e3 * base::to_seconds(law->half_width)} : std::nullopt;
}

/// Returns the only loss model of that kind; nullptr: there is none.
template <typename Law>
const Law* loss_of(const emulator::Conditions& conditions)
{
    for (const emulator::LossLaw& law : conditions.loss) {
        if (const auto* one = std::get_if<Law>(&law)) return one;
    }
    return nullptr;
}

bool is_simple_loss(const emulator::Conditions& conditions)
{
    const auto is_known = [](const emulator::LossLaw& law) {
        const auto* burst = std::get_if<emulator::Burst>(&law);
        return std::holds_alternative<emulator::RandomLoss>(law) ||
               (burst != nullptr && burst->of == 100);
    };
    const auto count = conditions.loss.size();
    const bool are_alike = count == 2 && conditions.loss[0].index() == conditions.loss[1].index();
    return count <= 2 && !are_alike && std::ranges::all_of(conditions.loss, is_known);
}

void note_network(const emulator::Profile& profile, SessionRow& row)
{
    row.network = experiment::network_text(profile);
    const emulator::Conditions& conditions = profile.path.up;
    if (conditions != profile.path.down || !profile.paths.empty()) return;
    row.delay_ms = constant_ms(conditions.delay);
    row.jitter_ms = jitter_ms(conditions);
    if (!is_simple_loss(conditions)) return;
    const auto* random = loss_of<emulator::RandomLoss>(conditions);
    const auto* burst = loss_of<emulator::Burst>(conditions);
    row.loss_percent = random == nullptr ? 0.0 : 100.0 * random->share.fraction();
    row.burst_of_100 = burst == nullptr ? 0.0 : static_cast<double>(burst->lost);
}

std::optional<double> times(double factor, std::optional<double> value)
{
    return value ? std::optional{factor * *value} : std::nullopt;
}

void note_scores(const metrics::Scores& scores, const metrics::Criteria& criteria, SessionRow& row)
{
    constexpr double mm = 1e3;
    if (scores.discrepancy_m) {
        row.mean_mm = mm * scores.discrepancy_m->mean;
        row.std_mm = mm * scores.discrepancy_m->std;
        row.max_mm = mm * scores.discrepancy_m->max;
    }
    if (scores.vibration_m)
        row.vibration_mm = mm * at_order(*scores.vibration_m, criteria.filter_order);
    row.stiffness_ratio = scores.stiffness_ratio[metrics::judged_press];
    if (scores.force_vibration_added_n)
        row.force_vibration_n = at_order(*scores.force_vibration_added_n, criteria.filter_order);
    if (scores.force_above_2hz_added_n)
        row.force_above_2hz_n = at_order(*scores.force_above_2hz_added_n, criteria.filter_order);
    row.force_discrepancy = scores.force_discrepancy;
    row.contact_lost = scores.contact_lost;
    if (scores.force_steps) row.force_step_n = scores.force_steps->largest_n;
    row.drag_n = scores.drag_n;
    row.energy_mj = times(1e3, scores.energy_taken_j);
    row.scored_share = scores.scored_share;
    row.tier = judge(scores, criteria).tier;
    row.stiffness_error = scores.stiffness_error;
    row.slow_stiffness_error = scores.slow_stiffness_error;
    row.rate_kbit_s = times(1e-3, scores.rate_bit_per_s);
}

/// Returns the cells of a row that are known before a session of an algorithm is played.
SessionRow started(const experiment::Experiment& experiment, std::size_t algorithm,
                   device::Task task, const experiment::Party& party)
{
    return {.algorithm = experiment.algorithms[algorithm].name,
            .task = std::string{name_of(task)},
            .hands = name_of(experiment.hands),
            .peers = party.peers,
            .scene = party.scene ? experiment.scenes[*party.scene].name
                                 : std::string{device::scene_of(task, party.peers)},
            .duration_s = base::to_seconds(experiment.duration)};
}

/// The rows of an experiment, job after job.
class SessionRows {
public:
    SessionRows(const experiment::Experiment& experiment, const metrics::Criteria& criteria)
        : experiment_{experiment}, criteria_{criteria}
    {}

    void add(const experiment::SessionJob& job, const experiment::SessionResult& result)
    {
        const auto scores = scores_of(result.metrics, result.reference);
        rows_.push_back(make_session_row(experiment_, job, scores, criteria_));
    }

    void add(const experiment::SearchJob& job, const experiment::SearchResult& result)
    {
        const SessionRow row = started(experiment_, job.algorithm, job.task, job.party);
        for (const experiment::CurvePoint& point : result.curve) {
            SessionRow& one = rows_.emplace_back(row);
            const auto order = std::get<experiment::Limits>(experiment_.kind).jitter_order;
            const auto path = impaired(experiment_.path, job.range.impairment, point.level, order);
            note_network(
                {.name = {}, .seed = {}, .path = path, .timeline = {}, .paths = experiment_.links},
                one);
            one.seed = point.seed;
            note_scores(point.scores, criteria_, one);
        }
    }

    std::vector<SessionRow> rows() && { return std::move(rows_); }

private:
    const experiment::Experiment& experiment_;
    const metrics::Criteria& criteria_;
    std::vector<SessionRow> rows_;
};

/// The conditions that two algorithms must share to be compared.
using SharedCondition =
    std::tuple<std::string, std::string, std::uint32_t, std::string, std::string>;

SharedCondition condition_of(const SessionRow& row)
{
    return {row.task, row.hands, row.peers, row.scene, row.network};
}

struct PairedMeasure {
    std::string_view name;
    std::optional<double> SessionRow::*value;
};
constexpr std::array paired_measures{
    PairedMeasure{"mean_mm", &SessionRow::mean_mm},
    PairedMeasure{"vibration_mm", &SessionRow::vibration_mm},
    PairedMeasure{"stiffness_ratio", &SessionRow::stiffness_ratio},
    PairedMeasure{"stiffness_error", &SessionRow::stiffness_error},
    PairedMeasure{"force_vibration_n", &SessionRow::force_vibration_n},
    PairedMeasure{"force_above_2hz_n", &SessionRow::force_above_2hz_n}};

/// The values of both algorithms, where both have one.
struct Pairs {
    std::vector<double> a;
    std::vector<double> b;
};

/// The identity of a session under one condition: subject, trial and seed.
using SessionId = std::tuple<std::string, std::string, std::uint64_t>;
using ById = std::map<SessionId, const SessionRow*>;

SessionId id_of(const SessionRow& row)
{
    return {row.subject.value_or(""), row.trial.value_or(""), row.seed};
}

/// Returns a pair for each seed; for people, a pair for each subject with the means of its
/// sessions.
Pairs pairs_of(const ById& a, const ById& b, const PairedMeasure& measure)
{
    metrics::SubjectMeans of_a, of_b;
    for (const auto& [id, row] : a) {
        const auto other = b.find(id);
        if (other == b.end()) continue;
        const auto x = row->*measure.value, y = other->second->*measure.value;
        if (!x || !y) continue;
        of_a.add(row->subject, *x);
        of_b.add(row->subject, *y);
    }
    return {of_a.means(), of_b.means()};
}

} // namespace

SessionRow make_session_row(const experiment::Experiment& experiment,
                            const experiment::SessionJob& job, const metrics::Scores& scores,
                            const metrics::Criteria& criteria)
{
    SessionRow row = started(experiment, job.algorithm, job.task, job.party);
    note_network(job.spec.setting.profile, row);
    row.seed = job.spec.setting.seed.value();
    row.duration_s = base::to_seconds(job.spec.setting.length);
    if (const hands::Trial* trial = experiment.hands.trial(job.trial)) {
        row.subject = trial->subject;
        row.trial = trial->name;
    }
    note_scores(scores, criteria, row);
    return row;
}

std::vector<SessionRow> make_session_rows(const experiment::Experiment& experiment,
                                          const metrics::Criteria& criteria,
                                          std::span<const experiment::JobResult> results)
{
    SessionRows rows{experiment, criteria};
    const auto jobs = make_jobs(experiment);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        if (const auto* one = std::get_if<experiment::SessionJob>(&jobs[i])) {
            rows.add(*one, std::get<experiment::SessionResult>(results[i]));
        } else if (const auto* search = std::get_if<experiment::SearchJob>(&jobs[i])) {
            rows.add(*search, std::get<experiment::SearchResult>(results[i]));
        }
    }
    return std::move(rows).rows();
}

Table paired_table(const std::vector<SessionRow>& sessions)
{
    std::map<std::pair<SharedCondition, std::string>, ById> played;
    std::vector<std::pair<SharedCondition, std::string>> order; // in the order of the sessions
    for (const SessionRow& row : sessions) {
        const std::pair key{condition_of(row), row.algorithm};
        ById& rows = played[key];
        if (rows.empty()) order.push_back(key);
        rows.emplace(id_of(row), &row);
    }
    Table table{"paired", columns_in(paired_columns)};
    for (const auto& key : order) {
        const std::string& reference = sessions.front().algorithm;
        const auto against = played.find({key.first, reference});
        if (key.second == reference || against == played.end()) continue;
        for (const PairedMeasure& measure : paired_measures) {
            const auto pairs = pairs_of(played.at(key), against->second, measure);
            if (pairs.a.size() < 2) continue;
            const auto test = metrics::paired_test(pairs.a, pairs.b);
            table.add(key.second, reference, std::get<0>(key.first), measure.name, test.seeds,
                      test.median, test.interval.low, test.interval.high, test.p);
        }
    }
    return table;
}

} // namespace hapnet::lab::results

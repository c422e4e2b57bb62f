// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis.hpp"

#include "lab/metrics/worse.hpp"

#include <algorithm>
#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::lab::records {

namespace {

using namespace std::chrono_literals;
using metrics::worse;

// A run that exceeds these limits is not valid.
constexpr double missed_share_max = 0.005;
constexpr double overlap_min = 0.95;

void judge(std::string_view name, const Loop& loop, std::vector<std::string>& objections)
{
    if (loop.late && loop.late->p99 > tick_lateness_max) {
        objections.push_back(fmt::format("{}: p99 tick lateness {:.3f} ms is above 1 ms", name,
                                         1e3 * base::to_seconds(loop.late->p99)));
    }
    if (loop.missed_share() > missed_share_max) {
        objections.push_back(fmt::format("{}: {:.2f} % of the ticks missed, more than 0.5 %", name,
                                         1e2 * loop.missed_share()));
    }
}

void judge(const Agreement& agreement, std::vector<std::string>& objections)
{
    if (agreement.overlap < overlap_min) {
        objections.push_back(
            fmt::format("the sessions overlap {:.1f} %, less than 95 %", 1e2 * agreement.overlap));
    }
    const bool finite =
        (!agreement.discrepancy_x || std::isfinite(agreement.discrepancy_x->std)) &&
        (!agreement.force_discrepancy || std::isfinite(agreement.force_discrepancy->mean)) &&
        (!agreement.contact_force_discrepancy ||
         std::isfinite(agreement.contact_force_discrepancy->mean)) &&
        std::isfinite(agreement.settled_discrepancy.value_or(0.0)) &&
        std::isfinite(agreement.settled_turned_apart.value_or(0.0));
    if (!finite) objections.emplace_back("positions or forces were not finite");
}

std::int64_t id_of(const record::Record& record)
{
    const auto id = record.config.value("peer_id", nlohmann::json{});
    return id.is_number_integer() ? id.get<std::int64_t>() : 0;
}

/// Returns the worse of the values of two pairs of copies of one body, for each quantity. If only
/// one pair has a quantity, its value is taken.
BodyAgreement worse_of(const BodyAgreement& a, const BodyAgreement& b)
{
    return {.body = a.body,
            .discrepancy_x = worse(a.discrepancy_x, b.discrepancy_x),
            .discrepancy = worse(a.discrepancy, b.discrepancy),
            .turned_apart = worse(a.turned_apart, b.turned_apart),
            .settled_discrepancy = worse(a.settled_discrepancy, b.settled_discrepancy),
            .settled_turned_apart = worse(a.settled_turned_apart, b.settled_turned_apart),
            .handovers = std::max(a.handovers, b.handovers),
            .same_owner = a.same_owner && b.same_owner ? std::min(a.same_owner, b.same_owner)
                                                       : std::max(a.same_owner, b.same_owner)};
}

} // namespace

std::string PairAnalysis::name() const { return fmt::format("{}-{}", id_a, id_b); }

const PairAnalysis* CircleAnalysis::worst() const
{
    const PairAnalysis* worst = nullptr;
    const auto mean_of = [](const PairAnalysis& pair) {
        return pair.analysis.agreement.discrepancy_x->mean;
    };
    for (const PairAnalysis& pair : pairs) {
        if (!pair.analysis.agreement.discrepancy_x) continue;
        if (worst == nullptr || mean_of(pair) > mean_of(*worst)) worst = &pair;
    }
    return worst;
}

std::optional<double> CircleAnalysis::settled_discrepancy() const
{
    std::optional<double> largest;
    for (const PairAnalysis& pair : pairs)
        largest = worse(largest, pair.analysis.agreement.settled_discrepancy);
    return largest;
}

std::optional<double> CircleAnalysis::settled_turned_apart() const
{
    std::optional<double> largest;
    for (const PairAnalysis& pair : pairs)
        largest = worse(largest, pair.analysis.agreement.settled_turned_apart);
    return largest;
}

std::vector<BodyAgreement> CircleAnalysis::bodies() const
{
    std::vector<BodyAgreement> bodies;
    for (const PairAnalysis& pair : pairs) {
        for (const BodyAgreement& one : pair.analysis.agreement.bodies) {
            const auto known = std::ranges::find_if(bodies, [&](const BodyAgreement& other) {
                return other.body.number == one.body.number;
            });
            if (known == bodies.end()) {
                bodies.push_back(one);
            } else {
                *known = worse_of(*known, one);
            }
        }
    }
    return bodies;
}

base::Result<CircleAnalysis> analyse_circle(std::span<const record::Record> records)
{
    std::vector<const record::Record*> by_id;
    for (const record::Record& record : records) by_id.push_back(&record);
    std::ranges::stable_sort(by_id, {}, [](const auto* record) { return id_of(*record); });
    CircleAnalysis circle;
    for (std::size_t i = 0; i < by_id.size(); ++i) {
        for (std::size_t j = i + 1; j < by_id.size(); ++j) {
            PairAnalysis pair{id_of(*by_id[i]), id_of(*by_id[j]), {}};
            auto analysis = analyse(*by_id[i], *by_id[j]);
            if (!analysis) {
                return base::fail(fmt::format("peers {} (A) and {} (B): {}", pair.id_a, pair.id_b,
                                              analysis.error().message));
            }
            pair.analysis = *std::move(analysis);
            circle.loops.try_emplace(pair.id_a, pair.analysis.a);
            circle.loops.try_emplace(pair.id_b, pair.analysis.b);
            circle.pairs.push_back(std::move(pair));
        }
    }
    for (const auto& [id, loop] : circle.loops)
        judge(fmt::format("peer {}", id), loop, circle.invalid_because);
    for (const PairAnalysis& pair : circle.pairs) {
        std::vector<std::string> objections;
        judge(pair.analysis.agreement, objections);
        for (const std::string& objection : objections)
            circle.invalid_because.push_back(fmt::format("{}: {}", pair.name(), objection));
    }
    return circle;
}

base::Result<Analysis> analyse(const record::Record& a, const record::Record& b)
{
    const auto session = common_session(a, b);
    if (!session) return tl::unexpected{session.error()};
    Analysis analysis{.agreement = agreement_of(*session),
                      .a_to_b = path_of(*session, Way::a_to_b),
                      .b_to_a = path_of(*session, Way::b_to_a),
                      .a = loop_of(session->a),
                      .b = loop_of(session->b),
                      .clock = session->clock,
                      .invalid_because{}};
    judge("A", analysis.a, analysis.invalid_because);
    judge("B", analysis.b, analysis.invalid_because);
    judge(analysis.agreement, analysis.invalid_because);
    return analysis;
}

} // namespace hapnet::lab::records

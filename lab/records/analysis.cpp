// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/analysis.hpp"

#include <cmath>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::lab::records {

namespace {

using namespace std::chrono_literals;

// A run that exceeds these is not worth a number: one tick of lateness is a tick of error.
constexpr base::Duration lateness_max = 1ms;
constexpr double missed_share_max = 0.005;
constexpr double overlap_min = 0.95;

void judge(std::string_view name, const Loop& loop, std::vector<std::string>& objections)
{
    if (loop.late && loop.late->p99 > lateness_max) {
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
        std::isfinite(agreement.settled_discrepancy.value_or(0.0));
    if (!finite) objections.emplace_back("positions or forces were not finite");
}

} // namespace

base::Result<Analysis> analyse(const record::Record& a, const record::Record& b)
{
    const auto session = common_session(a, b);
    if (!session) return tl::unexpected{session.error()};
    Analysis analysis{.agreement = agreement_of(*session),
                      .a_to_b = path_a_to_b(*session),
                      .b_to_a = path_b_to_a(*session),
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

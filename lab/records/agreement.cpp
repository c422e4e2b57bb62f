// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/agreement.hpp"

#include "lab/metrics/worse.hpp"
#include "lab/records/bodies.hpp"
#include "lab/records/moments.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hapnet::lab::records {

namespace {

using namespace std::chrono_literals;
using metrics::worse;
using record::Phase;
using record::TickRow;

// The time that the copies have to agree again after both hands let go.
constexpr base::Duration settling_time = 2s;

std::optional<ForceDiscrepancy> force_discrepancy_of(const std::vector<Moment>& moments,
                                                     base::Force TickRow::*force)
{
    std::vector<double> distances;
    for (const Moment& moment : moments) {
        if (moment.both_in(Phase::running) && moment.both_touch()) {
            distances.push_back(moment.force_distance(force));
        }
    }
    const auto spread = metrics::spread_of(distances);
    if (!spread) return std::nullopt;
    return ForceDiscrepancy{spread->mean, spread->max};
}

/// Returns the moments at which the copies should agree again.
std::vector<const Moment*> settled_moments(const std::vector<Moment>& moments)
{
    std::optional<base::TimePoint> let_go;
    std::vector<const Moment*> settled;
    for (const Moment& moment : moments) {
        if (!moment.both_in(Phase::hands_off)) continue;
        if (!let_go) let_go = moment.a->due;
        if (moment.a->due >= *let_go + settling_time) settled.push_back(&moment);
    }
    return settled;
}

/// Counts the moments at which one side names another owner than before.
class Handovers {
public:
    void note(std::uint16_t owner)
    {
        if (owner == 0) return;
        if (last_ != 0 && owner != last_) ++count_;
        last_ = owner;
    }
    /// Returns the number of handovers; nullopt: the side never named an owner.
    [[nodiscard]] std::optional<std::uint64_t> count() const
    {
        return last_ == 0 ? std::nullopt : std::optional{count_};
    }

private:
    std::uint16_t last_ = 0;
    std::uint64_t count_ = 0;
};

void add_owners(const Copies& copies, const std::vector<Moment>& moments, BodyAgreement& agreement)
{
    Handovers of_a, of_b;
    double same = 0.0, known = 0.0;
    for (const Moment& moment : moments) {
        if (!moment.both_in(Phase::running)) continue;
        const std::uint16_t a = copies.a().owner_at(*moment.a);
        const std::uint16_t b = copies.b().owner_at(*moment.before);
        of_a.note(a);
        of_b.note(b);
        if (a == 0 || b == 0) continue;
        known += 1.0;
        same += a == b ? 1.0 : 0.0;
    }
    agreement.handovers = std::max(of_a.count(), of_b.count());
    if (known > 0.0) agreement.same_owner = same / known;
}

BodyAgreement agreement_of(const Session& session, const RecordedBody& body,
                           const std::vector<Moment>& moments)
{
    BodyAgreement agreement{.body = body};
    const Copies copies{session, body};
    std::vector<double> along_x, distances, angles;
    for (const Moment& moment : moments) {
        if (!moment.both_in(Phase::running)) continue;
        const auto apart = copies.apart_at(moment);
        if (!apart) continue;
        along_x.push_back(std::abs(apart->distance.x()));
        distances.push_back(norm(apart->distance));
        if (body.can_turn) angles.push_back(apart->angle_rad);
    }
    agreement.discrepancy_x = metrics::spread_of(along_x);
    agreement.discrepancy = metrics::spread_of(distances);
    agreement.turned_apart = metrics::spread_of(angles);
    add_owners(copies, moments, agreement);
    for (const Moment* moment : settled_moments(moments)) {
        const auto apart = copies.apart_at(*moment);
        if (!apart) continue;
        agreement.settled_discrepancy =
            worse(agreement.settled_discrepancy, std::optional{norm(apart->distance)});
        if (!body.can_turn) continue;
        agreement.settled_turned_apart =
            worse(agreement.settled_turned_apart, std::optional{apart->angle_rad});
    }
    return agreement;
}

base::Duration::rep running_moments(const std::vector<Moment>& moments)
{
    return std::ranges::count_if(
        moments, [](const Moment& moment) { return moment.both_in(Phase::running); });
}

TouchShares touch_shares_of(const std::vector<Moment>& moments)
{
    TouchShares touched;
    double scored = 0.0;
    for (const Moment& moment : moments) {
        if (!moment.both_in(Phase::running)) continue;
        const bool a = moment.a->touching, b = moment.before->touching;
        scored += 1.0;
        touched.a += a ? 1.0 : 0.0;
        touched.b += b ? 1.0 : 0.0;
        touched.either += a || b ? 1.0 : 0.0;
        touched.both += a && b ? 1.0 : 0.0;
    }
    if (scored == 0.0) return {};
    return {touched.a / scored, touched.b / scored, touched.either / scored, touched.both / scored};
}

double overlap_of(const Session& session, const std::vector<Moment>& moments)
{
    const base::TimePoint start = session.a.terms.start;
    const base::Duration length = session.a.terms.length;
    if (length <= 0s) return 0.0;
    const auto shared = std::ranges::count_if(moments, [&](const Moment& moment) {
        const bool within = moment.a->due >= start && moment.a->due - start < length;
        const auto takes_part = [](const TickRow* row) {
            return row->phase == Phase::running || row->phase == Phase::hands_off;
        };
        return within && takes_part(moment.a) && takes_part(moment.before) &&
               takes_part(moment.after);
    });
    return std::min(1.0, base::to_seconds(shared * session.tick) / base::to_seconds(length));
}

} // namespace

Agreement agreement_of(const Session& session)
{
    const auto moments = moments_of(session);
    Agreement agreement{.bodies{},
                        .discrepancy_x{},
                        .force_discrepancy = force_discrepancy_of(moments, &TickRow::device),
                        .contact_force_discrepancy =
                            force_discrepancy_of(moments, &TickRow::contact),
                        .settled_discrepancy{},
                        .settled_turned_apart{},
                        .touching = touch_shares_of(moments),
                        .scored = running_moments(moments) * session.tick,
                        .overlap = overlap_of(session, moments)};
    for (const RecordedBody& body : session.bodies) {
        const BodyAgreement& one =
            agreement.bodies.emplace_back(agreement_of(session, body, moments));
        agreement.discrepancy_x = worse(agreement.discrepancy_x, one.discrepancy_x);
        agreement.settled_discrepancy =
            worse(agreement.settled_discrepancy, one.settled_discrepancy);
        agreement.settled_turned_apart =
            worse(agreement.settled_turned_apart, one.settled_turned_apart);
    }
    return agreement;
}

base::Entries<BodyAgreement> numbered(const std::vector<BodyAgreement>& bodies)
{
    base::Entries<BodyAgreement> entries;
    for (const BodyAgreement& one : bodies) {
        if (one.body.number) entries.emplace_back(std::to_string(*one.body.number), one);
    }
    return entries;
}

} // namespace hapnet::lab::records

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/replay.hpp"

#include "device/governor.hpp"
#include "lab/metrics/angle.hpp"
#include "lab/records/recorded_settings.hpp"
#include "peer/core/side.hpp"
#include "peer/core/sync/text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <spdlog/fmt/fmt.h>
#include <tuple>
#include <utility>
#include <vector>

namespace hapnet::lab::records {

namespace {

/// The device and governor of a record. The device reports the values in the row of each tick.
class RecordedRig {
public:
    explicit RecordedRig(const RecordedSettings& settings)
        : mount_{settings.mount}, governor_{settings.limits}
    {}

    void show(const record::TickRow& row)
    {
        sample_ = peer::sample_of(row);
        const auto state = static_cast<device::GovernorState>(row.governor);
        was_at_fault_ = state == device::GovernorState::fault;
        was_withheld_ = state == device::GovernorState::withheld;
    }

    [[nodiscard]] const device::Sample& read(base::TimePoint /*now*/) const { return sample_; }
    base::Force apply(const base::Force& wanted, bool permitted, base::TimePoint now)
    {
        device::Sample own = sample_; // the hand in the device's frame
        own.hip = mount_.to_device(sample_.hip);
        own.velocity = mount_.to_device(sample_.velocity);
        if (was_withheld_) { // a person's decision, which no row explains
            std::ignore = governor_.govern({{}, false}, own, now);
            return {};
        }
        const device::ForceRequest request{mount_.to_device(wanted), permitted};
        if (was_at_fault_ && governor_.state() != device::GovernorState::fault) {
            // A fault that nothing in the row explains was latched by the watchdog.
            device::Governor by_itself = governor_;
            std::ignore = by_itself.govern(request, own, now);
            if (by_itself.state() != device::GovernorState::fault) {
                governor_.latch({device::Fault::timeout, device::Trip::loop});
            }
        }
        return governor_.govern(request, own, now).force();
    }
    [[nodiscard]] device::GovernorState governor_state() const { return governor_.state(); }
    void on_cue(const device::Cue& /*cue*/) {}

private:
    device::Mount mount_;
    device::Governor governor_;
    device::Sample sample_; // the hand in the scene's frame
    bool was_at_fault_ = false;
    bool was_withheld_ = false;
};

/// Returns the index of this id among the others; where there is only one other, its index. Returns
/// the number of the others when none of them has the id.
std::size_t index_of(const std::vector<std::uint16_t>& others, std::uint16_t id)
{
    if (others.size() == 1) return 0;
    return static_cast<std::size_t>(std::ranges::find(others, id) - others.begin());
}

/// Returns the difference of two values; infinite where one is NaN and the other is not.
double difference(const auto& a, const auto& b)
{
    double most = 0.0;
    for (const int axis : {0, 1, 2}) {
        const double x = a.value[axis];
        const double y = b.value[axis];
        const bool same = x == y || (std::isnan(x) && std::isnan(y));
        const double gap = same ? 0.0 : std::abs(x - y);
        most = std::max(most, std::isnan(gap) ? std::numeric_limits<double>::infinity() : gap);
    }
    return most;
}

/// One peer, replayed.
class Replayer {
public:
    Replayer(const record::Record& record, const RecordedSettings& settings)
        : record_{record},
          others_{settings.peer.roster.others},
          rig_{settings},
          side_{settings.peer}
    {}

    ReplayedTick step(const record::TickRow& row)
    {
        const auto& messages = record_.messages;
        for (; message_ < messages.size() && messages[message_].tick <= row.tick; ++message_) {
            const record::MessageRow& message = messages[message_];
            side_.on_datagram(message.bytes, message.received_at, index_of(others_, message.from));
        }
        // A session's own end follows from the clock. Any other end was a person's decision.
        if (row.phase == record::Phase::ended) side_.peer().leave(wire::ByeReason::interrupted);
        rig_.show(row);
        side_.step(row.at(), rig_);
        for (std::size_t other = 0; other < others_.size(); ++other) {
            while (side_.poll(other)) {}
        }
        while (side_.notice()) {}
        return {row.tick, row.at(), row.contact, side_.tick().force, row.device, side_.told()};
    }

    /// The largest differences between the bodies in a tick's rows and those of the replay.
    struct BodyDifference {
        double place_m = 0.0;
        double turn_rad = 0.0;
        bool is_owner_said = false;
        bool is_other_owner = false;
    };
    [[nodiscard]] BodyDifference body_difference(std::uint64_t tick)
    {
        BodyDifference most;
        const auto& rows = record_.bodies;
        while (body_ < rows.size() && rows[body_].tick < tick) ++body_;
        for (; body_ < rows.size() && rows[body_].tick == tick; ++body_) {
            const record::BodyRow& row = rows[body_];
            const auto& shared = side_.peer().shared();
            const auto body = std::ranges::find(shared, row.body, &peer::SharedBody::id);
            if (body == shared.end()) {
                most.place_m = std::numeric_limits<double>::infinity();
                continue;
            }
            const record::BodyRow now = side_.body_row(tick, *body);
            most.place_m = std::max(most.place_m, difference(now.position, row.position));
            const double turn = metrics::angle_between(now.orientation, row.orientation);
            most.turn_rad = std::max(
                most.turn_rad, std::isnan(turn) ? std::numeric_limits<double>::infinity() : turn);
            if (row.owner == 0) continue;
            most.is_owner_said = true;
            most.is_other_owner |= now.owner != row.owner;
        }
        return most;
    }

    [[nodiscard]] std::size_t messages() const { return message_; }

private:
    const record::Record& record_;
    std::vector<std::uint16_t> others_; // ids of the other peers, ascending
    RecordedRig rig_;
    peer::Side side_;
    std::size_t message_ = 0;
    std::size_t body_ = 0; // index of the next row of bodies
};

std::optional<std::string> gap_in(const record::Record& record)
{
    if (record.ticks.empty()) return "it has no ticks";
    std::uint64_t expected = 0;
    std::optional<base::TimePoint> before;
    for (const record::TickRow& row : record.ticks) {
        if (row.tick < expected) {
            return fmt::format("tick {} follows where tick {} is expected: the file is damaged",
                               row.tick, expected);
        }
        if (row.tick > expected) {
            return fmt::format(
                "ticks {} to {} are missing: they were damaged, or the recorder could "
                "not write them in time; the ticks after them cannot be replayed",
                expected, row.tick - 1);
        }
        if (before && row.at() <= *before) {
            return fmt::format("tick {} is not later than the tick before it: the file is damaged",
                               row.tick);
        }
        before = row.at();
        ++expected;
    }
    return std::nullopt;
}

} // namespace

base::Result<Replayed> replay(const record::Record& record,
                              const std::optional<peer::Algorithm>& instead)
{
    auto settings = settings_of(record.config);
    if (!settings) return tl::unexpected{settings.error()};
    if (const auto gap = gap_in(record)) return base::fail(*gap);
    const auto& others = settings->peer.roster.others;
    for (const record::MessageRow& message : record.messages) {
        if (index_of(others, message.from) < others.size()) continue;
        return base::fail(fmt::format("a message of peer {}, which is not of the session: the file "
                                      "is damaged",
                                      message.from));
    }
    const std::string recorded = print_algorithm(settings->peer.algorithm);
    if (instead) settings->peer.algorithm = *instead;
    if (!is_loaded(settings->peer.algorithm)) {
        const auto& own = std::get<peer::SharedObject>(settings->peer.algorithm).options();
        return base::fail(fmt::format("it was played with the algorithm of a shared object: name "
                                      "the file, as in --algorithm {}",
                                      own.file));
    }
    if (others.size() > 1 && !peer::plays_with_many(settings->peer.algorithm))
        return base::fail("--algorithm: more than two peers play with base or remote-proxy");

    Replayed replayed;
    replayed.algorithm = peer::name_of(settings->peer.algorithm);
    // A shared object always has to be named explicitly.
    replayed.is_the_recorded_one =
        !instead || (std::holds_alternative<peer::SharedObject>(*instead) &&
                     print_algorithm(*instead) == recorded);
    replayed.ticks.reserve(record.ticks.size());
    Replayer replayer{record, *settings};
    for (const record::TickRow& row : record.ticks) {
        const ReplayedTick& tick = replayed.ticks.emplace_back(replayer.step(row));
        const double contact = difference(tick.contact, tick.recorded_contact);
        const double device = difference(tick.device, tick.recorded_device);
        replayed.contact_difference_max_n = std::max(replayed.contact_difference_max_n, contact);
        replayed.device_difference_max_n = std::max(replayed.device_difference_max_n, device);
        bool differs = contact > tolerance_n || device > tolerance_n;
        if (!record.bodies.empty()) {
            const auto of_bodies = replayer.body_difference(row.tick);
            auto& most_m = replayed.body_difference_max_m;
            auto& most_rad = replayed.turn_difference_max_rad;
            most_m = std::max(most_m.value_or(0.0), of_bodies.place_m);
            most_rad = std::max(most_rad.value_or(0.0), of_bodies.turn_rad);
            differs = differs || of_bodies.place_m > tolerance_m ||
                      of_bodies.turn_rad > tolerance_rad || of_bodies.is_other_owner;
            if (of_bodies.is_owner_said) {
                auto& ticks = replayed.other_owner_ticks;
                ticks = ticks.value_or(0) + (of_bodies.is_other_owner ? 1U : 0U);
            }
        }
        if (differs && !replayed.differs_from) replayed.differs_from = row.tick;
    }
    replayed.messages = replayer.messages();
    replayed.is_complete = record.ticks.back().phase == record::Phase::ended;
    return replayed;
}

std::string to_table(const Replayed& replayed)
{
    std::string text =
        fmt::format("replayed    {} ticks with {} messages, algorithm {}\n"
                    "difference  contact force {:.3g} N, device force {:.3g} N at most\n",
                    replayed.ticks.size(), replayed.messages, replayed.algorithm,
                    replayed.contact_difference_max_n, replayed.device_difference_max_n);
    if (replayed.body_difference_max_m) {
        text += fmt::format("bodies      {:.3g} mm and {:.3g} deg apart at most\n",
                            mm_per_m * *replayed.body_difference_max_m,
                            deg_per_rad * *replayed.turn_difference_max_rad);
    }
    if (replayed.other_owner_ticks) {
        text += fmt::format("owners      other ones than recorded in {} ticks\n",
                            *replayed.other_owner_ticks);
    }
    if (!replayed.is_complete) {
        text += "incomplete  the record stops before the session's end: its writer was killed, its "
                "disk was full, or it was cut off\n";
    }
    if (!replayed.differs_from) return text + "verdict     the forces are those of the record\n";
    return text + fmt::format("verdict     {} from tick {} on\n",
                              replayed.is_the_recorded_one
                                  ? "the forces are NOT those of the record"
                                  : "the forces differ from those of the recorded algorithm",
                              *replayed.differs_from);
}

std::string replay_csv_header()
{
    std::string line = "time_s,tick";
    for (const char* name : {"recorded_contact", "contact", "recorded_device", "device"}) {
        for (const char axis : {'x', 'y', 'z'}) line += fmt::format(",{}_{}_n", name, axis);
    }
    return line;
}

std::string csv_line(const ReplayedTick& tick, base::TimePoint zero)
{
    std::string line = fmt::format("{:.6f},{}", base::to_seconds(tick.at - zero), tick.tick);
    for (const base::Force& force :
         {tick.recorded_contact, tick.contact, tick.recorded_device, tick.device}) {
        for (const int axis : {0, 1, 2}) {
            const double part = force.value[axis];
            line += std::isfinite(part) ? fmt::format(",{:.9f}", part) : ",";
        }
    }
    return line;
}

} // namespace hapnet::lab::records

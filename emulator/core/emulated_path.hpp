// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/change_log.hpp"
#include "emulator/core/director.hpp"
#include "emulator/core/due_times.hpp"
#include "emulator/core/fates/fates.hpp"
#include "emulator/core/flow/branches.hpp"
#include "emulator/core/link.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace hapnet::emulator {

/// Both directions of an emulated path: two links, and the director that decides which conditions
/// are in effect on them. Does no I/O and reads no clock: feed it with on_packet(), drain it with
/// poll(), and call advance() by next_deadline(). Conditions that change in between affect the
/// first datagram that arrives after the time of the change, and all later ones.
class EmulatedPath {
public:
    struct Setup {
        base::Seed seed{1};
        base::TimePoint start{};               // time 0 of everything that depends on time
        QueueLimits limits{};                  // limits that each direction has
        std::shared_ptr<Slab> slab{};          // null: the path makes one for both directions
        std::shared_ptr<const Fates> replay{}; // null: fates are drawn
        StreamDetail stream_detail = StreamDetail::totals;
        std::string name{}; // its name if a run has several paths; see path_name.hpp
        std::size_t changes_max = ChangeLog::entries_max; // changes that changes() keeps
        DueTimes::Place place{};                          // marked when next_due() may have changed
    };

    EmulatedPath(const Profile& profile, const Setup& setup)
        : EmulatedPath{Director{profile, setup.start}, setup}
    {}
    /// Makes a path that continues from the state of the director.
    EmulatedPath(Director director, const Setup& setup);

    /// Follows the timeline up to `now`. Cheap when nothing changes. Returns true if something has
    /// changed.
    bool advance(base::TimePoint now)
    {
        const bool has_changed = director_.advance(now);
        if (has_changed) enact_timeline(now);
        return has_changed;
    }

    /// Takes the next datagram of a direction, which arrived at `arrival`; see Link::on_packet().
    Admission on_packet(Direction direction, std::span<const std::byte> bytes,
                        base::TimePoint arrival, bool has_destination = true,
                        const Headers& headers = {})
    {
        advance(arrival);
        place_.mark();
        return link_of(direction).on_packet(bytes, arrival, has_destination, headers);
    }

    /// Returns the earliest datagram of a direction that is due at `now`.
    [[nodiscard]] std::optional<Datagram> poll(Direction direction, base::TimePoint now)
    {
        place_.mark();
        return link_of(direction).poll(now);
    }

    /// Notes that the datagram left at `at`.
    void on_sent(Direction direction, const Datagram& datagram, base::TimePoint at)
    {
        link_of(direction).on_sent(datagram, at);
    }

    /// Notes that the datagram could not be sent.
    void on_failed(Direction direction, const Datagram& datagram, DropCause cause)
    {
        link_of(direction).on_failed(datagram, cause);
    }

    /// Returns the time when the next datagram is due; nullopt when none is in flight.
    [[nodiscard]] std::optional<base::TimePoint> next_due() const
    {
        return base::earlier(up_.next_deadline(), down_.next_deadline());
    }

    /// Returns the time when a datagram is due or the conditions may change.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const
    {
        return base::earlier(next_due(), director_.next_change());
    }

    /// Carries out the command at once; see Director::apply().
    base::Result<void> apply(const Command& command, base::TimePoint now,
                             ChangeCause by = ChangeCause::hand);

    /// Makes the conditions follow `director` from now on. `director` is a copy of this path's own
    /// director that has been advanced elsewhere.
    void follow(const Director& director, base::TimePoint now, ChangeCause by);
    /// Does the same for a director that has only followed its timeline.
    void follow(const Director& director, base::TimePoint now);

    /// Sends the datagrams of this path through the bottlenecks of another path; see
    /// Link::share_bottleneck_of().
    void share_bottlenecks_of(EmulatedPath& other)
    {
        up_.share_bottleneck_of(other.up_);
        down_.share_bottleneck_of(other.down_);
    }

    /// Sets the flows of this path. From now on, each packet of a flow takes the path of that flow.
    void branch(std::unique_ptr<Branches> branches) { branches_ = std::move(branches); }
    /// Returns the flows beside this path; null: there are none.
    [[nodiscard]] Branches* branches() const { return branches_.get(); }

    /// See Link::take_pulse().
    [[nodiscard]] Pulse take_pulse(Direction direction) { return link_of(direction).take_pulse(); }

    [[nodiscard]] const Director& director() const { return director_; }
    /// Returns the number of this path among several; see Paths::each_due().
    [[nodiscard]] std::size_t number() const { return place_.number(); }
    /// Returns the changes of the conditions since the start.
    [[nodiscard]] const ChangeLog& changes() const { return changes_; }
    [[nodiscard]] const Link& link(Direction direction) const
    {
        return direction == Direction::up ? up_ : down_;
    }

private:
    EmulatedPath(Director director, const Setup& setup, const std::shared_ptr<Slab>& slab);

    [[nodiscard]] Link& link_of(Direction direction)
    {
        return direction == Direction::up ? up_ : down_;
    }
    void enact_timeline(base::TimePoint now);
    /// Hands the director's conditions to the links, and logs the change.
    void enact(base::TimePoint now, ChangeCause by);

    Director director_;
    DueTimes::Place place_;
    ChangeLog changes_;
    std::shared_ptr<const Path> enacted_; // conditions that the links apply now
    Link up_;
    Link down_;
    std::unique_ptr<Branches> branches_; // the paths of the flows; null: no flows
};

} // namespace hapnet::emulator

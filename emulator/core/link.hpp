// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/bottleneck.hpp"
#include "emulator/core/conditions.hpp"
#include "emulator/core/datagram.hpp"
#include "emulator/core/delay_line.hpp"
#include "emulator/core/due_times.hpp"
#include "emulator/core/fate.hpp"
#include "emulator/core/fates/replay.hpp"
#include "emulator/core/pipeline.hpp"
#include "emulator/core/pulse.hpp"
#include "emulator/core/queue_limits.hpp"
#include "emulator/core/regime_chain.hpp"
#include "emulator/core/slab.hpp"
#include "emulator/core/statistics.hpp"
#include "emulator/core/stream_statistics.hpp"
#include "proto/base/figures/arrivals.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::emulator {

/// The outcome of a datagram's arrival.
struct Admission {
    std::uint64_t number = 0;
    Fate fate;                     // the fate as it was drawn, or replayed
    std::optional<DropCause> drop; // the cause in `fate`, or why a queue refused it
    /// The datagram itself when nothing holds it: no delay, no queue. Send it before any datagram
    /// that is polled later.
    std::optional<Datagram> departure;
};

/// One direction of an emulated path. Does no I/O and reads no clock: feed it with on_packet(),
/// drain it with poll(), and call poll() again by next_deadline(). All memory is taken at
/// construction. Datagrams that are still in flight at the end stay in the slab.
class Link {
public:
    struct Setup {
        base::Seed seed{1};
        Direction direction = Direction::up;
        base::TimePoint start{}; // time 0 of windows and periods
        QueueLimits limits{};
        std::shared_ptr<Slab> slab{};   // for the bytes in flight; null: the link makes one
        std::optional<Replay> replay{}; // source of the fates; nullopt: they are drawn
        StreamDetail stream_detail = StreamDetail::totals;
        std::string name{};      // the path's name, "1-2"; empty if there is only one
        DueTimes::Place place{}; // marked when another link changes this link's deadline
    };

    explicit Link(const Conditions& conditions, const Setup& setup);
    /// Makes a link as above. Several links may share `conditions`.
    Link(std::shared_ptr<const Conditions> conditions, const Setup& setup);
    Link(Link&&) noexcept;
    Link& operator=(Link&&) noexcept;
    Link(const Link&) = delete; // a copy would share the slots of the original
    Link& operator=(const Link&) = delete;
    ~Link();

    /// Takes the next datagram of this direction, which arrived at `arrival`, and returns its
    /// outcome. A queue or Order::keep may make it leave later than its fate says. Without a
    /// destination it is dropped, after the laws have judged it.
    Admission on_packet(std::span<const std::byte> bytes, base::TimePoint arrival,
                        bool has_destination = true, const Headers& headers = {});

    /// Returns the earliest datagram that is due at `now`; nullopt when there is none. Report each
    /// one exactly once through on_sent() or on_failed(). Until then it counts as in flight.
    [[nodiscard]] std::optional<Datagram> poll(base::TimePoint now);

    /// Returns the time at which to call poll() again; nullopt when nothing is in flight.
    [[nodiscard]] std::optional<base::TimePoint> next_deadline() const;

    /// Notes that the datagram left at `at`.
    void on_sent(const Datagram& datagram, base::TimePoint at);

    /// Notes that the datagram could not be sent.
    void on_failed(const Datagram& datagram, DropCause cause);

    /// Changes the conditions for datagrams that arrive from now on. Scheduled datagrams keep their
    /// times. A datagram that is being sent at the old rate continues at the new one from `now`.
    void change(const Conditions& conditions, base::TimePoint now)
    {
        share(std::make_shared<const Conditions>(conditions), now);
    }
    /// Does the same as change(), with conditions that other links also have. Not null.
    void share(std::shared_ptr<const Conditions> conditions, base::TimePoint now);

    /// Sends the datagrams of this link from now on through the bottleneck and the queue of another
    /// link of the same direction, and then on through this one. Among all links that share them,
    /// the earliest arrival comes first. Ensures that this link has no rate of its own. The other
    /// link must not move, and must outlive what is in flight here.
    void share_bottleneck_of(Link& other);

    [[nodiscard]] const Conditions& conditions() const { return *conditions_; }
    [[nodiscard]] const Statistics& statistics() const { return statistics_; }
    [[nodiscard]] const StreamStatistics& stream_statistics() const { return stream_statistics_; }
    /// Returns the time and the stays of each regime until this time since the start; empty: there
    /// are none.
    [[nodiscard]] std::vector<RegimeCourse> regime_course(base::Duration until) const
    {
        return pipeline_.regime_course(until);
    }
    /// Returns the departures since the last call. Counting begins with the first call, so that a
    /// link has no extra cost while there is no viewer.
    [[nodiscard]] Pulse take_pulse() { return std::exchange(pulse_, Pulse{}).value_or(Pulse{}); }

private:
    [[nodiscard]] Fate fate_of(const Packet& packet);
    void refuse_or_pass(Datagram& datagram, std::uint32_t flow, Admission& admission);
    void queue_up(const Datagram& datagram, std::uint32_t flow, const Fate& fate);
    void empty_bottleneck(base::TimePoint now);
    void on_passed(const Queued& passed);
    [[nodiscard]] bool passes_untouched(const Fate& fate) const;
    [[nodiscard]] bool hold(Datagram& datagram, std::uint32_t flow, const Fate& fate);
    [[nodiscard]] std::optional<std::span<std::byte>> store(Datagram& datagram);
    void release(const Datagram& datagram);
    void note_drop(DropCause cause, base::TimePoint at);
    void schedule(Datagram& datagram, const Fate& fate);
    void schedule_copy(Datagram copy, base::Duration after, Order order);
    void put(const Datagram& datagram, Order order);
    [[nodiscard]] Order order_of(const Fate& fate) const
    {
        return fate.regime == 0 ? conditions_->order : order_in_regime(fate.regime);
    }
    [[nodiscard]] Order order_in_regime(std::uint8_t regime) const;
    [[nodiscard]] const Rate& rate_now() const;
    void follow_rates();
    void switch_rates(base::TimePoint now);
    void release_displaced(std::uint64_t scheduled, base::TimePoint due);
    void advance(base::TimePoint now)
    {
        const bool is_plain = bottleneck_->rests() && displaced_.empty();
        if (!is_plain) move_on(now);
    }
    void move_on(base::TimePoint now);
    void pass_on(base::TimePoint now);

    std::shared_ptr<const Conditions> conditions_; // never null
    Setup setup_;
    Pipeline pipeline_;
    std::shared_ptr<Slab> slab_;
    std::size_t held_datagrams_ = 0; // datagrams in the slab
    std::size_t held_bytes_ = 0;     // bytes of the slab that they take
    DelayLine line_;
    std::shared_ptr<Bottleneck> bottleneck_; // never null
    Link* through_ = nullptr;                // link that owns the bottleneck; null: this one
    std::unique_ptr<RegimeChain> rates_;     // regimes of the bottleneck; null: none sets a rate
    std::vector<Queued> displaced_;          // wait for later datagrams (Reordering by places)
    base::TimePoint last_arrival_;
    base::TimePoint last_due_ = base::TimePoint::min();
    base::NextExpected expected_; // number of the next datagram in order; copies count, too
    Statistics statistics_;
    StreamStatistics stream_statistics_;
    std::optional<Pulse> pulse_; // nullopt: not asked for
};

} // namespace hapnet::emulator

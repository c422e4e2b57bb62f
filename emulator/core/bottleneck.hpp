// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/datagram.hpp"
#include "emulator/core/queue/fair_queue.hpp"
#include "emulator/core/queue/manager.hpp"
#include "emulator/core/ring.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/time.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>

namespace hapnet::emulator {

/// A line that sends one datagram after another, at a rate or as a trace allows it, with one queue
/// before it, or with one queue for each flow. With a burst it is a token bucket: a datagram of L
/// bytes that arrives at A leaves at max(A, F), where F = max(F of the previous datagram, A - burst
/// / rate) + L / rate. The times are exact: n datagrams of b bits that follow each other take
/// ceil(n b / rate), to the nanosecond, and when the rate changes while a datagram is being sent,
/// the bits that were already sent count.
class Bottleneck {
public:
    Bottleneck(const Rate& rate, std::size_t datagrams_max, base::TimePoint start = {},
               const QueueManager& manager = {})
        : rate_{rate},
          is_on_{rate.is_on()},
          manager_{manager},
          is_managed_{manager.is_on()},
          queue_{datagrams_max},
          start_{start}
    {
        fill_bucket(start);
        make_fair(manager.control());
    }

    [[nodiscard]] bool is_on() const { return is_on_; }
    [[nodiscard]] bool is_idle() const { return queue_.empty() && evicted_.empty(); }
    /// True if the state of the line does not change as long as nothing arrives.
    [[nodiscard]] bool rests() const { return is_idle() && !has_regimes_; }
    /// Sets whether the rate changes by itself from now on. If it does, rests() is false, so that
    /// the link that changes the rate is asked first.
    void have_regimes(bool do_so) { has_regimes_ = do_so; }
    /// True if the line needs to know to which flow a datagram belongs.
    [[nodiscard]] bool is_fair() const { return fair_ != nullptr; }

    /// True if a payload of this number of bytes would find room at the end of the queue. The
    /// datagram that is being sent does not count. If each flow has a queue, the longest queue
    /// makes room for it.
    [[nodiscard]] bool has_room(std::size_t payload_bytes) const
    {
        if (queue_.empty()) return true;
        const std::size_t others = is_fair() ? 0 : waiting_bytes_;
        return !queue_.is_full_with(queue_.size() + waiting_turns()) &&
               others + payload_bytes + rate_.overhead_bytes <= rate_.queue_bytes_max;
    }

    /// Returns why the queue drops a datagram that arrives; nullopt: the queue accepts it, and may
    /// have marked it.
    [[nodiscard]] std::optional<DropCause> refuses(Datagram& datagram)
    {
        if (!has_room(datagram.size())) return DropCause::rate_queue_full;
        if (!is_managed_) return std::nullopt;
        const QueueControl& control = manager_.control();
        const bool are_too_many =
            !is_fair() && control.packets_max > 0 && queue_.size() > control.packets_max;
        const bool is_too_long = control.time_max > base::Duration{0} &&
                                 is_busy_beyond(datagram.arrival + control.time_max);
        if (are_too_many || is_too_long) return DropCause::rate_queue_full;
        const auto verdict = manager_.judge_arrival(datagram, waiting_bytes_);
        if (verdict == QueueVerdict::drop) return DropCause::rate_queue_law;
        if (verdict == QueueVerdict::mark) datagram.marks = datagram.marks.with_congestion();
        return std::nullopt;
    }

    /// Takes a datagram that arrives now, which must not be earlier than the previous arrival.
    /// Ensures that there is room. `flow`: a hash of its flow, if is_fair(). `owner`: see Queued.
    void push(const Datagram& datagram, const Fate& fate, std::uint32_t flow = 0,
              Link* owner = nullptr)
    {
        base::ensure(!queue_.is_full_with(queue_.size() + waiting_turns()));
        const Queued entry{.datagram = datagram,
                           .fate = fate,
                           .line_bytes = datagram.size() + rate_.overhead_bytes,
                           .owner = owner};
        const bool was_idle = queue_.empty();
        if (was_idle && rate_.trace && !trace_start_) {
            trace_start_ = begin_of_trace(datagram.arrival);
        }
        waiting_bytes_ += entry.line_bytes;
        if (is_fair() && is_on_) {
            fair_->push(entry, flow);
        } else {
            queue_.push(entry);
        }
        if (was_idle) {
            next_head(datagram.arrival, credit_at(datagram.arrival), true);
        } else if (is_fair()) {
            make_room(datagram.arrival);
        }
    }

    /// Returns the time when the datagram that is being sent will have left; nullopt when the line
    /// is idle or will never finish sending it.
    [[nodiscard]] std::optional<base::TimePoint> next_sent() const
    {
        return evicted_.empty() ? next_sent_ : std::optional{evicted_.front().datagram.due};
    }

    /// Takes the next datagram that has left by `now`. Its `due` is the time when its last bit had
    /// left. When the rate is removed, the datagrams that still wait leave at once, even if `now`
    /// is the time of an arrival just before the removal. Datagrams that the law of the queue drops
    /// also come here, at the time when the line was free for them. Datagrams that were dropped to
    /// make room come at once.
    [[nodiscard]] std::optional<Queued> pop(base::TimePoint now)
    {
        if (!evicted_.empty()) {
            const Queued evicted = evicted_.front();
            evicted_.pop_front();
            return evicted;
        }
        if (!next_sent_ || (is_on_ && *next_sent_ > now)) return std::nullopt;
        const auto at = *next_sent_;
        Queued sent = queue_.pop();
        sent.datagram.due = at;
        sent.begun = begun_;
        next_sent_.reset();
        credit_ = {at, spare_};
        if (!queue_.empty() || waiting_turns() > 0) {
            next_head(at, spare_, !sent.dropped);
        } else if (is_fair()) {
            fair_->on_empty(at);
        } else if (sent.dropped) {
            manager_.on_empty(at);
        }
        return sent;
    }

    /// Changes the rate from `now` on, for waiting datagrams and for the rest of the one that is
    /// being sent. Call pop() until nothing is left that has left by `now` first.
    void change(const Rate& rate, base::TimePoint now, const QueueControl& control = {})
    {
        manager_.change(control);
        is_managed_ = manager_.is_on();

        if (!queue_.empty() && is_on_ && now > since_) work_ -= std::min(work_, sent_until(now));
        since_ = std::max(since_, now);
        credit_ = {since_, credit_at(since_)};
        const bool was_on = is_on_;
        if (rate.trace != rate_.trace) trace_start_.reset();
        rate_ = rate;
        is_on_ = rate.is_on();
        if (!was_on) fill_bucket(since_);
        make_fair(control);
        if (queue_.empty()) return;
        if (rate_.trace && !trace_start_) trace_start_ = begin_of_trace(since_);
        if (!queue_.front().dropped) plan(0);
    }

private:
    /// The capacity that the line has accumulated unused up to a time.
    struct Credit {
        base::TimePoint at{};
        Work work = 0;
    };

    void fill_bucket(base::TimePoint now) { credit_ = {now, rate_.burst_bytes * work_per_byte}; }

    /// Returns the unused capacity of an idle line, at most the burst.
    [[nodiscard]] Work credit_at(base::TimePoint now) const
    {
        const Work most = rate_.burst_bytes * work_per_byte;
        if (most <= credit_.work || !is_on_) return most;
        const auto passed =
            static_cast<std::uint64_t>(std::max(now - credit_.at, base::Duration{0}).count());
        const Work lacking = most - credit_.work;
        const bool is_full = passed > lacking / rate_.bits_per_second;
        return is_full ? most : credit_.work + passed * rate_.bits_per_second;
    }

    [[nodiscard]] std::size_t waiting_turns() const { return is_fair() ? fair_->size() : 0; }

    /// Gives each flow a queue of its own, or gives all flows one. Datagrams that wait in existing
    /// queues are served first.
    void make_fair(const QueueControl& control)
    {
        const bool is_to_be = control.law == QueueLaw::fq_codel;
        const bool stays =
            is_fair() && is_to_be && control.flow_count() == fair_->flows() && is_on_;
        if (stays) return fair_->change(control);
        if (is_fair()) {
            for (const Queued& entry : fair_->take_all()) queue_.push(entry);
            fair_.reset();
        }
        if (is_to_be) fair_ = std::make_unique<FairQueue>(control);
    }

    /// Drops datagrams from the longest queues until all queues together are within their limits
    /// (RFC 8290, section 4.1).
    void make_room(base::TimePoint now)
    {
        const std::uint32_t most = manager_.control().packets_max;
        const auto is_too_much = [&] {
            return waiting_bytes_ > rate_.queue_bytes_max ||
                   (most > 0 && queue_.size() - 1 + waiting_turns() > most);
        };
        while (is_too_much() && waiting_turns() > 0) {
            for (Queued& entry : fair_->take_from_longest()) {
                waiting_bytes_ -= entry.line_bytes;
                entry.dropped = DropCause::rate_queue_full;
                entry.datagram.due = now;
                evicted_.push_back(entry);
            }
        }
    }

    /// Handles the next datagram when the line is free: the front, or one of the flow whose turn it
    /// is. The line sends it unless the law of the queue drops it.
    void next_head(base::TimePoint now, Work spare, bool is_first)
    {
        const bool is_judged = queue_.empty();
        if (is_judged) queue_.push(fair_->next(now));
        Queued& head = queue_.front();
        waiting_bytes_ -= head.line_bytes;
        if (!is_judged && is_managed_ && is_on_) {
            const auto verdict = manager_.judge_head(
                {now - head.datagram.arrival, waiting_bytes_, is_first}, head.datagram.marks, now);
            head.is_marked = verdict == QueueVerdict::mark;
            if (verdict == QueueVerdict::drop) head.dropped = DropCause::rate_queue_law;
        }
        if (!head.dropped) return begin(now, spare);
        begun_ = since_ = now;
        next_sent_ = now;
        spare_ = spare;
        work_ = 0;
    }

    /// True if the line would still be busy at `then` with what waits now.
    [[nodiscard]] bool is_busy_beyond(base::TimePoint then) const
    {
        constexpr std::size_t most = 1U << 30U; // more bytes count as beyond any time
        if (queue_.empty()) return false;
        if (waiting_bytes_ > most) return true;
        const Work work = work_ + waiting_bytes_ * work_per_byte;
        if (rate_.trace) {
            const auto& law = *rate_.trace;
            const auto done = law.trace->finish(in_trace(since_), work, law.timing.repeat);
            return !done || since_ + (done->at - in_trace(since_)) > then;
        }
        const auto nanoseconds = static_cast<base::Duration::rep>(work / rate_.bits_per_second);
        return since_ + base::Duration{nanoseconds} > then;
    }

    /// Starts to send the front. `spare`: the amount that the line could have sent in addition by
    /// the time the previous datagram had left.
    void begin(base::TimePoint now, Work spare)
    {
        const Work work = queue_.front().line_bytes * work_per_byte;
        const Work used = std::min(spare, work);
        work_ = work - used;
        begun_ = since_ = now;
        plan(spare - used);
    }

    /// Computes when the front will have left. `spare`: the amount left over if the front needs no
    /// more work.
    void plan(Work spare)
    {
        spare_ = spare;
        next_sent_ = since_; // without work or without a rate it leaves at once
        if (work_ == 0 || !is_on_) return;
        if (rate_.trace) return plan_by_trace();
        const Work rate = rate_.bits_per_second;
        const Work nanoseconds = work_ / rate + (work_ % rate != 0 ? 1 : 0);
        *next_sent_ += base::Duration{static_cast<base::Duration::rep>(nanoseconds)};
        spare_ = nanoseconds * rate - work_;
    }

    void plan_by_trace()
    {
        const auto& law = *rate_.trace;
        const auto done = law.trace->finish(in_trace(since_), work_, law.timing.repeat);
        next_sent_.reset();
        if (!done) return;
        next_sent_ = since_ + (done->at - in_trace(since_));
        spare_ = done->spare;
    }

    [[nodiscard]] Work sent_until(base::TimePoint now) const
    {
        if (!rate_.trace) {
            return static_cast<std::uint64_t>((now - since_).count()) * rate_.bits_per_second;
        }
        const auto& law = *rate_.trace;
        return law.trace->sent(in_trace(since_), in_trace(now), law.timing.repeat);
    }

    [[nodiscard]] base::TimePoint begin_of_trace(base::TimePoint now) const
    {
        return rate_.trace->timing.start == TraceStart::first ? now : start_;
    }
    [[nodiscard]] base::Duration in_trace(base::TimePoint at) const
    {
        return std::max(at - *trace_start_, base::Duration{0}) + rate_.trace->timing.offset;
    }

    Rate rate_;
    bool is_on_;
    bool has_regimes_ = false;
    QueueManager manager_;
    bool is_managed_;
    /// The front is being sent, or is the next to leave without being sent.
    Ring<Queued> queue_;
    std::unique_ptr<FairQueue> fair_; // datagrams behind queue_, if each flow has a queue
    std::deque<Queued> evicted_;      // datagrams dropped to make room, not handed on yet
    std::size_t waiting_bytes_ = 0;
    Work work_ = 0; // rest of the front's work at since_
    base::TimePoint since_{};
    base::TimePoint begun_{};                  // when the line began to send the front
    std::optional<base::TimePoint> next_sent_; // time when the front will have left
    Work spare_ = 0;                           // additional work possible by next_sent_
    Credit credit_{};                          // the line's credit when the last datagram had left
    base::TimePoint start_;                    // start of the run
    std::optional<base::TimePoint> trace_start_;
};

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/queue/control.hpp"
#include "proto/base/time.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace hapnet::emulator {

/// Controlled delay (RFC 8289, section 5.5). Once datagrams have waited longer than the target for
/// an interval, it drops them at the head of the queue, and then ever more often until the waits
/// are short again. Datagrams that can be marked are marked instead, and then sent, as in Linux
/// (codel_impl.h).
///
/// Each time the line is free, show it the datagram at the head. While it drops them, show it the
/// next.
class Codel {
public:
    /// While at most this number of bytes wait behind the head, nothing is dropped: one datagram of
    /// the usual largest size.
    static constexpr std::size_t bytes_min = 1514;

    Codel(base::Duration target, base::Duration interval) : target_{target}, interval_{interval} {}

    /// The facts that CoDel may use about the datagram at the head.
    struct Head {
        base::Duration waited{};
        std::size_t bytes_behind = 0; // bytes that wait behind it in the queue
        bool is_first = false;        // the first one that is shown at this moment
        bool is_markable = false;     // may be marked instead of dropped
    };

    [[nodiscard]] QueueVerdict judge(const Head& head, base::TimePoint now)
    {
        const bool may_drop = has_waited_long(head, now);
        if (!head.is_first) return judge_another(may_drop, head.is_markable, now);
        if (is_dropping_) {
            is_dropping_ = may_drop;
            return is_dropping_ ? act(head.is_markable, now) : QueueVerdict::pass;
        }
        begins_ = may_drop && !head.is_markable;
        if (!may_drop) return QueueVerdict::pass;
        if (begins_) return QueueVerdict::drop;
        begin(now);
        return QueueVerdict::mark;
    }

    /// Call this when the last datagram was dropped and the queue is empty.
    void on_empty(base::TimePoint now)
    {
        first_above_.reset();
        static_cast<void>(judge_another(false, false, now));
    }

    void change(base::Duration target, base::Duration interval)
    {
        target_ = target;
        interval_ = interval;
    }

private:
    [[nodiscard]] bool has_waited_long(const Head& head, base::TimePoint now)
    {
        if (head.waited < target_ || head.bytes_behind <= bytes_min) {
            first_above_.reset();
            return false;
        }
        if (!first_above_) {
            first_above_ = now + interval_;
            return false;
        }
        return now >= *first_above_;
    }

    [[nodiscard]] QueueVerdict judge_another(bool may_drop, bool is_markable, base::TimePoint now)
    {
        if (begins_) {
            begin(now);
            return QueueVerdict::pass;
        }
        is_dropping_ = may_drop;
        if (!may_drop) return QueueVerdict::pass;
        drop_next_ = after(drop_next_);
        return act(is_markable, now);
    }

    /// Decides whether the next drop is due. After a mark, no other drop or mark follows at this
    /// moment.
    [[nodiscard]] QueueVerdict act(bool is_markable, base::TimePoint now)
    {
        if (now < drop_next_) return QueueVerdict::pass;
        ++count_;
        if (!is_markable) return QueueVerdict::drop;
        drop_next_ = after(drop_next_);
        return QueueVerdict::mark;
    }

    /// Begins a series of drops. If the last series ended a short time ago, it continues with its
    /// drop rate.
    void begin(base::TimePoint now)
    {
        begins_ = false;
        is_dropping_ = true;
        const std::uint32_t delta = count_ - last_count_;
        count_ = delta > 1 && now - drop_next_ < 16 * interval_ ? delta : 1;
        drop_next_ = after(now);
        last_count_ = count_;
    }

    [[nodiscard]] base::TimePoint after(base::TimePoint time) const
    {
        const double part = static_cast<double>(interval_.count()) / std::sqrt(count_);
        return time + base::Duration{static_cast<base::Duration::rep>(part)};
    }

    base::Duration target_;
    base::Duration interval_;
    // Time at which waits will have been long for a whole interval
    std::optional<base::TimePoint> first_above_;
    base::TimePoint drop_next_{};
    std::uint32_t count_ = 0; // drops and marks that set the drop rate (`count` in RFC 8289)
    std::uint32_t last_count_ = 0;
    bool is_dropping_ = false;
    bool begins_ = false; // the last verdict was the first drop of a series
};

} // namespace hapnet::emulator

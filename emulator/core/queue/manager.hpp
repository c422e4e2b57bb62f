// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/datagram.hpp"
#include "emulator/core/queue/codel.hpp"
#include "emulator/core/queue/control.hpp"
#include "emulator/core/queue/pie.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

namespace hapnet::emulator {

/// The running law of a queue. Draws one number for each datagram that arrives, by the datagram's
/// number.
class QueueManager {
public:
    QueueManager() = default;
    QueueManager(const QueueControl& control, const base::RandomStream& stream);

    /// Changes the settings. The law continues if it stays the same; another one starts from its
    /// beginning.
    void change(const QueueControl& control);

    [[nodiscard]] const QueueControl& control() const { return control_; }

    /// True if any setting differs from the default. A law may then drop datagrams for which the
    /// queue has room.
    [[nodiscard]] bool is_on() const { return control_ != QueueControl{}; }

    /// Judges a datagram that arrives and for which there is room.
    [[nodiscard]] QueueVerdict judge_arrival(const Datagram& datagram, std::size_t bytes_waiting)
    {
        auto* pie = std::get_if<Pie>(&law_);
        const bool is_hit = pie != nullptr && pie->drops(datagram.arrival, bytes_waiting,
                                                         stream_->uniform(datagram.number));
        if (!is_hit) return QueueVerdict::pass;
        const bool is_marked = control_.marks() && datagram.marks.is_ecn_capable() &&
                               pie->probability() <= Pie::marked_up_to;
        return is_marked ? QueueVerdict::mark : QueueVerdict::drop;
    }

    /// Judges the datagram at the head of the queue when the line is free. The verdict is to send,
    /// mark or drop it.
    [[nodiscard]] QueueVerdict judge_head(Codel::Head head, base::IpMarks marks,
                                          base::TimePoint now)
    {
        head.is_markable = control_.marks() && marks.is_ecn_capable();
        if (auto* pie = std::get_if<Pie>(&law_)) pie->on_departure(now, head.waited);
        auto* codel = std::get_if<Codel>(&law_);
        const auto verdict = codel != nullptr ? codel->judge(head, now) : QueueVerdict::pass;
        return with_threshold(verdict, control_, head.waited, marks);
    }

    /// Tells the law that it has dropped the last datagram of the queue.
    void on_empty(base::TimePoint now)
    {
        if (auto* codel = std::get_if<Codel>(&law_)) codel->on_empty(now);
    }

private:
    QueueControl control_;
    std::optional<base::RandomStream> stream_;
    std::variant<std::monostate, Codel, Pie> law_;
};

} // namespace hapnet::emulator

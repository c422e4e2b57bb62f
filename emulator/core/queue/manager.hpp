// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

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

/// The law of a queue at work. Draws one number for each datagram that arrives, by its number.
class QueueManager {
public:
    QueueManager() = default;
    QueueManager(const QueueControl& control, const base::RandomStream& stream);

    /// Another law begins anew, the same one goes on.
    void change(const QueueControl& control);

    [[nodiscard]] const QueueControl& control() const { return control_; }

    /// Whether it may drop what a bound in bytes lets pass.
    [[nodiscard]] bool is_on() const { return control_ != QueueControl{}; }

    /// Whether the law drops a datagram that arrives and for which there is room.
    [[nodiscard]] bool drops_arrival(std::uint64_t number, base::TimePoint now,
                                     std::size_t bytes_waiting)
    {
        auto* pie = std::get_if<Pie>(&law_);
        return pie != nullptr && pie->drops(now, bytes_waiting, stream_->uniform(number));
    }

    /// Whether the law drops the datagram at the head of the queue, for which the line is free.
    [[nodiscard]] bool drops_head(const Codel::Head& head, base::TimePoint now)
    {
        if (auto* pie = std::get_if<Pie>(&law_)) pie->on_departure(now, head.waited);
        auto* codel = std::get_if<Codel>(&law_);
        return codel != nullptr && codel->drops(head, now);
    }

    /// It has dropped the last datagram of the queue.
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

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/law.hpp"
#include "emulator/core/delay/sampler.hpp"
#include "emulator/core/delay/trace.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <memory>
#include <optional>

namespace hapnet::emulator {

/// Draws the delay, or the jitter, of one datagram after the other: the quantile of the law at the
/// uniform number of the datagram. Without correlation a delay depends on nothing but the number
/// of its datagram, with it also on when the datagrams arrived.
class DelayProcess {
public:
    /// There is no objection() to `variation`, but for what a ramp loses by rounding.
    DelayProcess(const Variation& variation, const base::RandomStream& stream);

    /// The delay of the next datagram; that of a jitter may be negative. Every datagram of the
    /// direction is shown here once, in the order of their numbers. Does not allocate.
    [[nodiscard]] base::Duration on_packet(const Packet& packet);

    /// Holds from the next datagram on. A correlated process goes on from where it is, whatever
    /// the law becomes. Cheap, and does not allocate: a ramp changes the law every millisecond.
    void change(const Variation& variation);

private:
    /// A Gaussian process whose correlation decays as exp(-t / correlation_time).
    struct Gaussian {
        double value;
        base::Duration at;
    };

    [[nodiscard]] double uniform(const Packet& packet);

    Sampler sampler_;
    std::shared_ptr<const DelayTrace> trace_; // instead of the sampler, when not null
    base::Duration correlation_time_;
    std::optional<Gaussian> gaussian_; // nullopt: nothing was drawn yet
    base::RandomStream stream_;
};

} // namespace hapnet::emulator

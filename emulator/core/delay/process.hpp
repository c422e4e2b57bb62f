// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/delay/law.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

namespace hapnet::emulator {

/// Draws the delay, or the jitter, of one datagram after the other.
class DelayProcess {
public:
    DelayProcess(const Variation& variation, const base::RandomStream& stream);

    /// The delay of the next datagram; that of a jitter may be negative. Every datagram of the
    /// direction is shown here once, in the order of their numbers.
    [[nodiscard]] base::Duration on_packet(const Packet& packet);

    /// Holds from the next datagram on. A correlated process goes on from where it is.
    void change(const Variation& variation);

private:
    Variation variation_;
    base::RandomStream stream_;
};

} // namespace hapnet::emulator

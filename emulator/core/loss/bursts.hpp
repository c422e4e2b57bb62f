// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/judgement.hpp"
#include "emulator/core/loss/law.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"

#include <cstdint>

namespace hapnet::emulator {

/// Burst: has no state but where its period lies.
class BurstJudge {
public:
    BurstJudge(const Burst& law, const base::RandomStream& stream);

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream&) const;
    void change(const Burst& law, const base::RandomStream& stream);

private:
    Burst law_;
    std::uint64_t shift_ = 0; // datagram 0 is this far into its period
};

/// TimedBurst. The period that the run begins in has begun before it: of a burst in time its rest
/// is seen, of a burst in datagrams nothing. A law that sets in later takes the first datagrams
/// that it is shown.
class TimedBurstJudge {
public:
    TimedBurstJudge(const TimedBurst& law, const base::RandomStream& stream);

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream&);
    void change(const TimedBurst& law, const base::RandomStream& stream);

private:
    TimedBurst law_;
    base::Duration begin_{};   // of a period, in [0, every)
    std::int64_t period_ = -1; // in which the last datagram came; -1: before begin_
    std::uint32_t lost_ = 0;   // in that period
};

} // namespace hapnet::emulator

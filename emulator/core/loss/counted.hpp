// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/judgement.hpp"
#include "emulator/core/loss/law.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"

#include <cstdint>

namespace hapnet::emulator {

// A judge is a law at work. All judges have one shape: made from a law and a stream, shown every
// datagram, changed to another law of their kind. They differ by their state alone.

/// RandomLoss: has no state.
class RandomJudge {
public:
    RandomJudge(const RandomLoss& law, const base::RandomStream&) : law_{law} {}

    [[nodiscard]] LossJudgement on_packet(const Packet& packet,
                                          const base::RandomStream& stream) const;
    void change(const RandomLoss& law, const base::RandomStream&) { law_ = law; }

private:
    RandomLoss law_;
};

/// BlockLoss: blocks follow each other from the first datagram that it is shown. Within a block
/// datagrams are sampled one after the other (Knuth, The Art of Computer Programming 2, 3.4.2,
/// algorithm S): every choice of `lost` among `of` is equally likely.
class BlockJudge {
public:
    BlockJudge(const BlockLoss& law, const base::RandomStream&);

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream& stream);

    /// A block that has begun keeps what it has lost, and comes as close to the new law as it can.
    void change(const BlockLoss& law, const base::RandomStream&);

private:
    BlockLoss law_;
    std::uint32_t seen_ = 0; // of the present block
    std::uint32_t lost_ = 0; // of those
};

/// PeriodicLoss: has no state.
class PeriodicJudge {
public:
    PeriodicJudge(const PeriodicLoss& law, const base::RandomStream&);

    [[nodiscard]] LossJudgement on_packet(const Packet& packet, const base::RandomStream&) const;
    void change(const PeriodicLoss& law, const base::RandomStream&);

private:
    PeriodicLoss law_;
};

} // namespace hapnet::emulator

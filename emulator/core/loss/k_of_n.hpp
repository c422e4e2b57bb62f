// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/loss/theory.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"
#include "proto/base/result.hpp"

#include <cstdint>

namespace hapnet::emulator {

/// Loses exactly `lost` datagrams of every `of` in a row, at random places in each such block.
/// Blocks follow each other from the first datagram under this law. 0 < lost <= of.
struct BlockLoss {
    std::uint32_t lost = 0;
    std::uint32_t of = 0;

    static constexpr DropCause cause = DropCause::block_loss;
    static constexpr bool is_in_time = false;
    class Model;

    [[nodiscard]] base::Result<void> validate() const;
    [[nodiscard]] LossTheory theory(const Arrivals&) const;
    [[nodiscard]] std::vector<LossProperty> properties(const RunFacts&) const;

    friend bool operator==(const BlockLoss&, const BlockLoss&) = default;
};

constexpr auto fields_of(base::Tag<BlockLoss>)
{
    return base::fields(
        "k-of-n", base::field("lost", &BlockLoss::lost, "datagrams lost in each block").required(),
        base::field("of", &BlockLoss::of, "datagrams in a block").required());
}

/// Within a block datagrams are sampled one after the other (Knuth, The Art of Computer
/// Programming 2, 3.4.2, algorithm S): every choice of `lost` among `of` is equally likely.
class BlockLoss::Model {
public:
    Model(const BlockLoss& law, const base::RandomStream&);

    [[nodiscard]] bool on_packet(const Packet& packet, const base::RandomStream& stream);

    /// Changes the law. A block that has begun keeps its losses so far, and comes as close to the
    /// new law as it can.
    void change(const BlockLoss& law, const base::RandomStream&);

private:
    BlockLoss law_;
    std::uint32_t seen_ = 0; // datagrams of the present block so far
    std::uint32_t lost_ = 0; // losses among them
};

} // namespace hapnet::emulator

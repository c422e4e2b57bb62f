// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/conditions.hpp"
#include "emulator/core/delay/delay.hpp"
#include "emulator/core/fate.hpp"
#include "emulator/core/loss/loss.hpp"
#include "emulator/core/packet.hpp"
#include "proto/base/random.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hapnet::emulator {

/// Draws the fates of the datagrams of one direction. Every stage sees every datagram, also one
/// that another stage has dropped, so that no stage can shift the draws of another; the first
/// drop is final. Stage S of direction D draws from the stream "D/S" of the seed ("up/jitter",
/// "down/loss/random", ...) and from no other.
///
/// The stages, always in this order: mtu, loss (law after law), corrupt, duplicate, delay, jitter,
/// reorder. The rate and the order of departure are kept by Link.
class Pipeline {
public:
    /// The streams of a path with a name begin with it: "client/1/up/jitter"; see stream_name().
    Pipeline(const Conditions& conditions, base::Seed seed, Direction direction,
             std::string_view path = {});

    /// Packets are shown in the order of their numbers, none left out.
    [[nodiscard]] Fate on_packet(const Packet& packet);

    /// That of a further stage of this direction.
    [[nodiscard]] base::RandomStream stream(std::string_view stage) const;

    /// Holds from the next packet on; laws that stay go on from their states.
    void change(const Conditions& conditions);

private:
    /// A law by its kind: the first random loss, the second one, the first burst, ...
    struct LawIndex {
        std::size_t kind = 0;
        std::size_t occurrence = 1;

        friend bool operator==(const LawIndex&, const LawIndex&) = default;
    };
    struct LossStage {
        LawIndex position;
        LossProcess process;
    };

    static LawIndex index_of(const std::vector<LossLaw>& laws, std::size_t index);
    [[nodiscard]] LossStage loss_stage(const std::vector<LossLaw>& laws, std::size_t index) const;
    void change_losses(const std::vector<LossLaw>& laws);
    [[nodiscard]] bool is_above_mtu(const Packet& packet) const;
    [[nodiscard]] Flips draw_flips(std::uint64_t number) const;
    [[nodiscard]] base::Duration draw_copy(std::uint64_t number) const;

    base::Seed seed_;
    std::string way_; // what the names of its streams begin with
    Mtu mtu_;
    std::vector<LossStage> loss_;
    Corruption corrupt_;
    base::RandomStream corrupt_stream_;
    Duplication duplicate_;
    base::RandomStream duplicate_stream_;
    DelayProcess delay_;
    DelayProcess jitter_;
    Reordering reorder_;
    base::RandomStream reorder_stream_;
};

} // namespace hapnet::emulator
